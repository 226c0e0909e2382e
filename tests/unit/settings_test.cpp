// SPDX-License-Identifier: MIT

// Settings as values and as text: tables, headers, and what is wrong with them.

#include "plumb/base/error.h"
#include "plumb/settings/compare_settings.h"
#include "plumb/settings/settings_header.h"
#include "support/catch.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <ranges>

using namespace plumb;

namespace {

using Texts = std::vector<std::string>;
using Examples = std::map<std::string, Texts, std::less<>>;

const Examples render_examples = {
    {"exposure", {"-1.5", "0.1", "3.4e-05"}},
    {"tonemap", {"filmic", "aces", "agx"}},
    {"denoise", {"true"}},
    {"no-variance", {"true"}},
    {"spp", {"1", "67108864"}},
    {"adaptive", {"0.02", "0.0001"}},
    {"seed", {"7", "18446744073709551615"}},
    {"size", {"65535x1", "640x480"}},
    {"crop", {"1,2,3,4"}},
    {"aov", {"normal", "depth,albedo"}},
    {"split", {"light", "depth:3,technique"}},
    {"integrator", {"path_mis"}},
    {"sampler", {"sobol"}},
    {"time", {"90", "0.1", "5400"}},
    {"target-error", {"0.01", "1e-09"}},
    {"define", {"a=", "a=b c", "a=x=\\'\n\r\\n", "a=\xc3\xa9"}},
    {"dialect", {"plumb", "mcgill"}},
    {"emitters", {"absorb", "scatter"}},
    {"mirror", {"on", "off"}},
    {"envmap-scale", {"0", "0.3", "1e+30"}},
    {"lenient", {"true"}},
    {"isa", {}}, // depends on the processor: below
};
const Examples compare_examples = {
    {"significance", {"0.05", "1e-09"}},
    {"layer", {"normal"}},
    {"exact", {"A", "B"}},
    {"variance-of", {"sample", "mean"}},
    {"no-verdict", {"true"}},
    {"fail-percent", {"0.1", "100"}},
    {"max", {"rmse=0.1,flip=1,psnr=-30"}},
    {"flip", {"ldr", "hdr", "none"}},
};

template <class Settings>
void check_table(const Examples& examples)
{
    const Settings usual;
    CHECK(setting_rows<Settings>().size() == examples.size());
    for (const SettingRow<Settings>& row : setting_rows<Settings>()) {
        INFO(row.name);
        CHECK(find_setting<Settings>(row.name) == &row);
        CHECK_FALSE(row.help.empty());
        CHECK_FALSE(row.phrase.empty());
        CHECK(row.get(usual).empty());
        const auto found = examples.find(row.name);
        REQUIRE(found != examples.end());
        for (const std::string& text : found->second) {
            INFO(text);
            Settings settings;
            row.set(settings, row.name, text);
            CHECK(settings != usual);
            CHECK(row.get(settings) == Texts{text});
            // No other row sees it.
            for (const SettingRow<Settings>& other : setting_rows<Settings>())
                CHECK((&other == &row) != other.get(settings).empty());
            CHECK(differences(usual, settings, row.effect) ==
                  Texts{std::string(row.phrase) + " was the default and is " + text});
            CHECK(differences(settings, settings, row.effect).empty());
            if (!row.is_switch()) continue;
            row.set(settings, row.name, "false");
            CHECK(settings == usual);
        }
    }
    CHECK(find_setting<Settings>("output") == nullptr);
}

std::string problem(const Metadata& header)
{
    try {
        settings_of_header(header);
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

std::string problem_of_setting(const std::string& name, const std::string& text)
{
    return problem({{"plumb:settings", 2}, {"plumb:set." + name, text}});
}

RenderSettings of_arguments(const std::string& line)
{
    return settings_of_header({{"plumb:arguments", line}});
}

std::string problem_of_arguments(const std::string& line)
{
    return problem({{"plumb:arguments", line}});
}

} // namespace

TEST_CASE("every setting reads back from its text", "[unit][settings]")
{
    check_table<RenderSettings>(render_examples);
    check_table<CompareSettings>(compare_examples);
    for (const std::string_view name : instruction_set_names()) {
        RenderSettings settings;
        find_setting<RenderSettings>("isa")->set(settings, "isa", name);
        CHECK(settings.method.instruction_set == name);
        CHECK((settings == RenderSettings()) == (name == default_instruction_set().name));
        CHECK(settings_of_header(settings_header(settings)) == settings);
    }
}

TEST_CASE("settings read back from a header", "[unit][settings]")
{
    CHECK(settings_header({}) == Metadata{{"plumb:settings", settings_schema}});
    CHECK(settings_of_header({}) == RenderSettings()); // of schema 1, which wrote nothing then
    RenderSettings all;
    for (const auto& [name, texts] : render_examples) {
        const SettingRow<RenderSettings>& row = *find_setting<RenderSettings>(name);
        for (const std::string& text : texts) {
            RenderSettings one;
            row.set(one, name, text);
            const Metadata header = settings_header(one);
            REQUIRE(header.size() == 2);
            CHECK(header[1].first == "plumb:set." + name);
            CHECK(std::get<std::string>(header[1].second).find_first_of("\r\n") == std::string::npos);
            CHECK(settings_of_header(header) == one);
        }
        if (!texts.empty()) row.set(all, name, texts.front());
    }
    all.scene.definitions = {{"a", "1\n2"}, {"b", ""}, {"c", "\\"}};
    const Metadata header = settings_header(all);
    CHECK(std::find(header.begin(), header.end(),
                    Metadata::value_type("plumb:set.define", "a=1\\n2\nb=\nc=\\\\")) != header.end());
    CHECK(settings_of_header(header) == all);
    for (const auto& entry : header) CHECK(is_settings_entry(entry.first));
    CHECK(is_settings_entry("plumb:arguments"));
    CHECK_FALSE(is_settings_entry("plumb:seed"));
}

TEST_CASE("the options in a header of Plumb 0.1 are read", "[unit][settings]")
{
    CHECK(of_arguments("") == RenderSettings());
    const RenderSettings settings =
        of_arguments("--exposure -1 --no-variance --spp 4 --seed 7 --crop 1,2,3,4 --time 2h "
                     "--define 'a=b c' --define 'x='\\''' --define $'y=1\\x0a2' --lenient");
    CHECK(settings.output.development.exposure == -1.f);
    CHECK_FALSE(settings.output.error_bars);
    CHECK(settings.samples.per_pixel == 4u);
    CHECK(settings.samples.seed == 7);
    CHECK(settings.view.crop == PixelRect{1, 2, 3, 4});
    CHECK(settings.stop.seconds == 7200.0);
    CHECK(settings.scene.definitions ==
          std::map<std::string, std::string>{{"a", "b c"}, {"x", "'"}, {"y", "1\n2"}});
    CHECK(settings.scene.lenient);

    const std::string unknown = "' is not an option that changes the image";
    for (const char* word :
         {"other.xml", "-o", "--output", "--checkpoint", "--help", "--threads", "--spp=4", "--"})
        CHECK(problem_of_arguments(word + std::string(" 1")) ==
              "plumb:arguments: '" + std::string(word) + unknown);
    CHECK(problem_of_arguments("''") == "plumb:arguments: '" + unknown);
    CHECK(problem_of_arguments("--seed") == "plumb:arguments: option '--seed' needs a value");
    CHECK(problem_of_arguments("--spp 4 --spp 5") == "plumb:arguments: option '--spp' is given twice");
    CHECK(problem_of_arguments("--spp 0") ==
          "plumb:arguments: --spp must be an integer from 1 to 67108864, not '0'");
    CHECK(problem_of_arguments("--define a=1 --define a=2") == "plumb:arguments: --define a is given twice");
}

TEST_CASE("what is wrong with settings in a header is named", "[unit][settings]")
{
    CHECK(problem({{"plumb:settings", settings_schema + 1}}) ==
          fmt::format("plumb:settings is {}, and this program reads versions up to {}", settings_schema + 1,
                      settings_schema));
    for (const MetadataValue& value :
         Metadata{{"", 1}, {"", -1}, {"", 2.f}, {"", std::string("2")}} | std::views::values)
        CHECK(problem({{"plumb:settings", value}}) == "plumb:settings must be an integer from 2");
    CHECK(problem({{"plumb:set.seed", std::string("7")}}) == "plumb:set.seed needs plumb:settings");
    CHECK(problem({{"plumb:settings", 2}, {"plumb:arguments", std::string("--seed 7")}}) ==
          "plumb:settings and plumb:arguments cannot be used together");
    CHECK(problem({{"plumb:arguments", 7}}) == "plumb:arguments must be a text");
    CHECK(problem({{"plumb:settings", 2}, {"plumb:set.seed", 7}}) == "plumb:set.seed must be a text");
    for (const char* name : {"output", "sede", "", "threads", "max"})
        CHECK(problem_of_setting(name, "1") ==
              "plumb:set." + std::string(name) + " is not a setting of an image");
    CHECK(problem_of_setting("spp", "0") == "plumb:set.spp must be an integer from 1 to 67108864, not '0'");
    CHECK(problem_of_setting("seed", "1\n2") ==
          "plumb:set.seed must be an integer from 0 to 18446744073709551615, not '1\n2'");
    CHECK(problem_of_setting("lenient", "yes") == "plumb:set.lenient must be true or false, not 'yes'");
    CHECK(problem_of_setting("define", "a=1\na=2") == "plumb:set.define a is given twice");
    CHECK(problem_of_setting("define", "a=1\n") == "plumb:set.define must be name=value, not ''");
    CHECK(problem_of_setting("define", "") == "plumb:set.define must be name=value, not ''");
    for (const char* value : {"a=\\", "a=\\t", "a=\\ "})
        CHECK(problem_of_setting("define", value) ==
              "plumb:set.define has a backslash that is not in \\n, \\r or \\\\");
}

TEST_CASE("what is wrong with a setting names it as it was called", "[unit][settings]")
{
    CompareSettings how;
    const auto& max = *find_setting<CompareSettings>("max");
    max.set(how, "--max", "rmse=1");
    CHECK_THROWS_WITH(max.set(how, "--max", "rmse=2"), "--max rmse is given twice");
    CHECK_THROWS_WITH(max.set(how, "max", "rms=2"), "max cannot be 'rms'; did you mean 'rmse'?");
    CHECK_THROWS_WITH(find_setting<CompareSettings>("fail-percent")->set(how, "fail-percent", "101"),
                      "fail-percent must be a number from 0 to 100, not '101'");
    RenderSettings settings;
    CHECK_THROWS_WITH(find_setting<RenderSettings>("spp")->set(settings, "reference-spp", "many"),
                      "reference-spp must be an integer from 1 to 67108864, not 'many'");
}
