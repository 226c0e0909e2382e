// SPDX-License-Identifier: MIT
#include "cli/verb_file.h"
#include "cli/verbs.h"
#include "settings/options_text.h"
#include "support/catch.h"

#include <algorithm>
#include <cctype>
#include <sstream>

using namespace plumb;

namespace {

// Words separated by spaces; none of these holds one.
std::vector<std::string> split(const std::string& line)
{
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

// A verb with everything that several verbs have.
struct Options : VerbOptions {
    RenderSettings settings;
    CompareSettings compare;
    std::vector<std::string> outputs;
    std::string json;
    std::string checkpoint;
    int threads = 0;
};

OptionTable<Options> table()
{
    OptionTable<Options> all =
        join<Options>({outputs_option<Options>(), json_option<Options>(), checkpoint_option<Options>(),
                       threads_option<Options>(), quiet_option<Options>(), verbose_option<Options>()});
    for (const auto& row : setting_rows<RenderSettings>())
        all.push_back(setting_options<Options>(Topic::image, &Options::settings, {row.name}).front());
    for (const auto& row : setting_rows<CompareSettings>())
        all.push_back(setting_options<Options>(Topic::verdict, &Options::compare, {row.name}).front());
    return all;
}

Options parse_words(const std::vector<std::string>& words)
{
    return parse_into<Options>({"", "SCENE", "", "scene file", 1, 1}, table(), nullptr, words);
}

Options parse(const std::string& line)
{
    return parse_words(split(line));
}

// The name of the verb; the words are right for it.
std::string_view verb_name(const std::string& line)
{
    const Verb& verb = verb_of(split(line));
    verb.parse(split(line));
    return verb.name;
}

std::string usage_error(const std::vector<std::string>& words)
{
    try {
        verb_of(words).parse(words);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "no error";
}

std::string usage_error(const std::string& line)
{
    return usage_error(split(line));
}

} // namespace

TEST_CASE("a scene alone leaves everything to the scene", "[unit][options]")
{
    const Options options = parse("cbox.xml");
    CHECK(verb_name("cbox.xml").empty());
    CHECK(options.subject() == "cbox.xml");
    CHECK(options.outputs.empty());
    CHECK(options.json.empty());
    CHECK_FALSE(options.quiet);
    CHECK_FALSE(options.verbose);
    CHECK(options.settings == RenderSettings());
    CHECK(options.threads == 0);
}

TEST_CASE("every option of a rendering is understood", "[unit][options]")
{
    const Options options = parse(
        "-o a.exr --output b.png -oc.jpg --spp 67108864 --integrator path_mis --sampler independent "
        "--seed 18446744073709551615 --threads 3 --size 65535x1 --crop 1,2,3,4 -D a=1 -Db=2=3 --define c= "
        "--dialect eth --emitters absorb --mirror off --envmap-scale 2.5 --isa sse4.2 --exposure -1.5 "
        "--lenient --quiet --json=out.json scene.xml");
    CHECK(options.subject() == "scene.xml");
    CHECK(options.outputs == std::vector<std::string>{"a.exr", "b.png", "c.jpg"});
    CHECK(options.settings.samples.per_pixel == 67108864u);
    CHECK(options.settings.method.integrator == "path_mis");
    CHECK(options.settings.method.sampler == "independent");
    CHECK(options.settings.samples.seed == 18446744073709551615u);
    CHECK(options.threads == 3);
    CHECK(options.settings.view.size == Vec2i(65535, 1));
    CHECK(options.settings.view.crop == PixelRect{1, 2, 3, 4});
    CHECK(options.settings.scene.definitions ==
          std::map<std::string, std::string>{{"a", "1"}, {"b", "2=3"}, {"c", ""}});
    CHECK(options.settings.scene.dialect == DialectName::eth);
    CHECK(options.settings.scene.emitters_absorb == true);
    CHECK(options.settings.scene.mirrored_view == false);
    CHECK(options.settings.scene.environment_scale == 2.5f);
    CHECK(options.settings.method.instruction_set == "sse4.2");
    CHECK(options.settings.output.development.exposure == -1.5f);
    CHECK(options.settings.scene.lenient);
    CHECK(options.quiet);
    CHECK(options.json == "out.json");
}

TEST_CASE("words with two meanings are read as one", "[unit][options]")
{
    CHECK(parse("s.xml --dialect auto").settings.scene.dialect == std::nullopt);
    CHECK(parse("s.xml --emitters scatter").settings.scene.emitters_absorb == false);
    CHECK(parse("s.xml --mirror on").settings.scene.mirrored_view == true);
    CHECK(parse("s.xml --json -").json == "-");
    CHECK(parse("s.xml --exposure +2").settings.output.development.exposure == 2.f);
    CHECK(parse("s.xml -t 5").threads == 5);
    CHECK(verb_name("./types").empty());
    CHECK(parse("./types").subject() == "./types");
    CHECK(parse("-- -s.xml").subject() == "-s.xml");
}

TEST_CASE("verbs come first and take their own options", "[unit][options]")
{
    CHECK(verb_name("types") == "types");
    CHECK(verb_name("types diffuse") == "types");
    CHECK(verb_name("info out.exr") == "info");
    CHECK(verb_name("replay s.xml --pixel 3,4 --sample 5 --seed 6 --mirror on") == "replay");

    CHECK(usage_error("s.xml types") == "the verb 'types' must come first");
    CHECK(usage_error("types a b") == "unexpected argument 'b' after 'a'");
    CHECK(usage_error("info") == "no image given; 'renderer --help' shows how");
    CHECK(usage_error("replay s.xml --sample 5") == "replay needs --pixel X,Y");
    CHECK(usage_error("replay s.xml --pixel 3,4") == "replay needs --sample I");
    CHECK(usage_error("replay s.xml --pixel 3,4 --sample 5 --crop 1,1,1,1") ==
          "option '--crop' cannot be used with replay");
    CHECK(usage_error("s.xml --pixel 1,1") == "option '--pixel' cannot be used with rendering");
    CHECK(usage_error("info a.exr --spp 4") == "option '--spp' cannot be used with info");

    CHECK(verb_name("test a.xml --seed 3 b.xml -t 2 --dialect epfl --json r.json --quiet c.xml") == "test");
    CHECK(verb_name("test ./test") == "test");
    CHECK(verb_name("test -- -a.xml b.xml") == "test");
    CHECK(usage_error("test") == "no test file given; 'renderer --help' shows how");
    CHECK(usage_error("test a.xml --spp 4") == "option '--spp' cannot be used with test");
    CHECK(usage_error("a.xml test") == "the verb 'test' must come first");

    CHECK(closest_verb("tpyes") == "types");
    CHECK(closest_verb("cbox.xml").empty());
}

TEST_CASE("compare takes two images", "[unit][options]")
{
    CHECK(verb_name("compare a.exr b.exr --diff d.png --diff-of flip") == "compare");
    const CompareSettings how = parse("a.exr --max rmse=0.25,flip=0.5 --max psnr=30 --significance 0.05 "
                                      "--exact B --fail-percent 2 --no-verdict --flip ldr")
                                    .compare;
    CHECK(how.significance == 0.05);
    CHECK(how.exact == Side::b);
    CHECK(how.fail_percent == 2.0);
    CHECK(how.flip == FlipMode::ldr);
    CHECK_FALSE(how.verdict);
    REQUIRE(how.thresholds.size() == 3);
    CHECK(how.thresholds[0].metric == "rmse");
    CHECK(how.thresholds[0].limit == 0.25);
    CHECK(how.thresholds[2].metric == "psnr");

    CHECK(usage_error("compare a.exr") == "compare needs two images; 'renderer compare --help' shows how");
    CHECK(usage_error("compare a.exr b.exr c.exr") ==
          "3 images are given; pass the reference with --against FILE, the others are then replicas of A");
    CHECK(usage_error("compare a.exr b.exr --max rmse") == "--max must be name=value, not 'rmse'");
    CHECK(usage_error("compare a.exr b.exr --max rmse=x") ==
          "--max rmse must be a number from -1e+30 to 1e+30, not 'x'");
    CHECK(usage_error("compare a.exr b.exr --max rmse=1,rmse=2") == "--max rmse is given twice");
    CHECK(usage_error("compare a.exr b.exr --max ssim=1") ==
          "--max cannot be 'ssim'; known are mse, rmse, relmse, mae, max, psnr and flip");
    CHECK(usage_error("compare a.exr b.exr --json d.png --diff d.png") ==
          "'d.png' is listed as an output twice");
    CHECK(usage_error("compare a.exr b.exr --exact C") == "--exact cannot be 'C'; known are A and B");
    CHECK(usage_error("compare a.exr b.exr --size 4x4") == "option '--size' cannot be used with compare");
}

TEST_CASE("what replay needs is kept, quoted for a shell", "[unit][options]")
{
    const Options options = parse_words({"s.xml", "-o", "a.exr", "-D", "n=a b'c", "--quiet", "--seed", "7",
                                         "--threads", "2", "--lenient", "--crop", "0,0,1,1", "--isa", "avx"});
    CHECK(replay_options_text(options.settings) == " --seed 7 --define 'n=a b'\\''c' --lenient --isa avx");
    CHECK(options_text(options.settings) ==
          " --seed 7 --crop 0,0,1,1 --define 'n=a b'\\''c' --lenient --isa avx");
    CHECK(options_text(parse("s.xml --no-variance --spp 4 -D a=1 -D b=2").settings) ==
          " --no-variance --spp 4 --define a=1 --define b=2");
}

TEST_CASE("help and version need no scene", "[unit][options]")
{
    for (const char* line : {"--help", "-h", "replay --help", "compare -h", "--version"})
        CHECK(usage_error(line) == "no error");
}

TEST_CASE("--help names every option of its verb", "[unit][options]")
{
    for (const Verb* verb : all_verbs()) {
        const std::string help = help_text(*verb);
        for (const OptionHelp& option : verb->options) {
            INFO(option.names);
            const std::string line =
                std::string(option.long_name()) +
                (option.value_is_optional ? "[=" + option.value + "]" : " " + option.value);
            CHECK((help.find(", " + line) != std::string::npos ||
                   help.find("\n      " + line) != std::string::npos));
        }
        std::istringstream lines(help);
        for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 100);
    }
}

TEST_CASE("unknown options are named with a way out", "[unit][options]")
{
    CHECK(usage_error("s.xml --sp 4") == "unknown option '--sp'; did you mean '--spp'?");
    CHECK(usage_error("--sp 4 s.xml") == "unknown option '--sp'; did you mean '--spp'?");
    CHECK(usage_error("s.xml --thread=4") == "unknown option '--thread'; did you mean '--threads'?");
    CHECK(usage_error("s.xml --samples 4") == "unknown option '--samples'; did you mean '--spp'?");
    CHECK(usage_error("s.xml --nonsense") ==
          "unknown option '--nonsense'; 'renderer --help' lists the options");
    CHECK(usage_error("s.xml --no-gui") == "Plumb has no window; omit '--no-gui'");
    CHECK(usage_error("a.xml b.xml") == "unexpected argument 'b.xml' after 'a.xml'");
    CHECK(usage_error("a.xml --tev host:1") == "unexpected argument 'host:1'; write '--tev=host:1'");
    CHECK(usage_error("") == "no scene file given; 'renderer --help' shows how");
    CHECK(usage_error("--spp 4") == "no scene file given; 'renderer --help' shows how");
}

TEST_CASE("values that are missing, doubled or unwanted are errors", "[unit][options]")
{
    CHECK(usage_error("s.xml --spp") == "option '--spp' needs a value");
    CHECK(usage_error("s.xml -o") == "option '--output' needs a value");
    CHECK(usage_error("--spp= s.xml") == "option '--spp' needs a value");
    CHECK(usage_error("s.xml --quiet=no") == "option '--quiet' takes no value");
    CHECK(usage_error("s.xml -o --spp 4") ==
          "option '--output' needs a value, and '--spp' looks like an option");
    CHECK(usage_error("s.xml --spp 4 --spp 5") == "option '--spp' is given twice");
    CHECK(usage_error("s.xml -D a=1 -D a=2") == "--define a is given twice");
    CHECK(usage_error("s.xml -o a.exr -o a.exr") == "'a.exr' is listed as an output twice");
    CHECK(usage_error("s.xml -o a.exr -o ./b/../a.exr") == "'a.exr' is listed as an output twice");
    CHECK(usage_error("s.xml -o a.exr --json a.exr") == "'a.exr' is listed as an output twice");
    CHECK(usage_error({"s.xml", "-o", ""}) == "--output needs a file name");
    CHECK(usage_error("s.xml --quiet --verbose") == "--quiet and --verbose cannot be used together");
}

TEST_CASE("numbers use up their word and lie in their range", "[unit][options]")
{
    const std::string spp = "--spp must be an integer from 1 to 67108864, not ";
    for (const std::string value :
         {"0", "-1", "1.5", "abc", "4x", "67108865", "1e3", "99999999999999999999", "+-4"})
        CHECK(usage_error("s.xml --spp " + value) == spp + "'" + value + "'");
    CHECK(usage_error({"s.xml", "--spp", ""}) == spp + "''");
    CHECK(usage_error({"s.xml", "--spp", " 4"}) == spp + "' 4'");

    CHECK(usage_error("s.xml --threads 0") == "--threads must be an integer from 1 to 1024, not '0'");
    CHECK(usage_error("s.xml --seed -1") ==
          "--seed must be an integer from 0 to 18446744073709551615, not '-1'");
    CHECK(usage_error("s.xml --seed 18446744073709551616") ==
          "--seed must be an integer from 0 to 18446744073709551615, not '18446744073709551616'");
    for (const std::string value : {"nan", "inf", "1e99", "101", "-101", "one", "1,5", "0x1"})
        CHECK(usage_error("s.xml --exposure " + value) ==
              "--exposure must be a number from -100 to 100, not '" + value + "'");
    CHECK_THAT(usage_error("s.xml --envmap-scale -1"),
               ContainsSubstring("--envmap-scale must be a number from 0"));
    for (const std::string value :
         {"640", "640x", "x480", "640x480x2", "0x480", "640x0", "65536x1", "640X480", "a", "-1x1"})
        CHECK(usage_error("s.xml --size " + value) ==
              "--size must be WIDTHxHEIGHT, integers from 1 to 65535 as in 640x480, not '" + value + "'");
    for (const std::string value :
         {"1,2,3", "1,2,3,4,5", "-1,2,3,4", "1,2,0,4", "1,2,3,0", "a,b,c,d", "1,2,3,"})
        CHECK(usage_error("s.xml --crop " + value) ==
              "--crop must be X,Y,WIDTH,HEIGHT, integers with X and Y from 0 and WIDTH and HEIGHT from 1 to "
              "65535, not '" +
                  value + "'");
    CHECK_THAT(usage_error("replay s.xml --sample 0 --pixel 1"), ContainsSubstring("--pixel must be X,Y"));
}

TEST_CASE("words of a choice are checked", "[unit][options]")
{
    CHECK(usage_error("s.xml --dialect zaragosa") ==
          "--dialect cannot be 'zaragosa'; did you mean 'zaragoza'?");
    CHECK_THAT(usage_error("s.xml --dialect x"),
               ContainsSubstring("auto, plumb, epfl, eth, zaragoza and mcgill"));
    CHECK_THAT(usage_error("s.xml --emitters reflect"),
               ContainsSubstring("--emitters cannot be 'reflect'; known are scatter and absorb"));
    CHECK_THAT(usage_error("s.xml --mirror yes"), ContainsSubstring("known are on and off"));
    CHECK(usage_error("s.xml --isa avx3") == "--isa cannot be 'avx3'; did you mean 'avx'?");
    CHECK(usage_error("s.xml -D name") == "--define must be name=value, not 'name'");
    CHECK(usage_error("s.xml -D =value") == "--define must be name=value, not '=value'");
}

TEST_CASE("every setting of an image is an option of a rendering", "[unit][options]")
{
    const auto has = [](std::string_view verb, std::string_view setting) {
        const auto& options = find_verb(verb)->options;
        return std::any_of(options.begin(), options.end(), [&](const OptionHelp& option) {
            return option.long_name() == "--" + std::string(setting);
        });
    };
    for (const SettingRow<RenderSettings>& setting : setting_rows<RenderSettings>()) {
        INFO(setting.name);
        CHECK(has("render", setting.name));
        // A sample is replayed with all that changes it.
        if (setting.effect == Effect::samples || setting.name == "spp") CHECK(has("replay", setting.name));
        // Only the command line names files.
        CHECK(setting.value.find("FILE") == setting.value.npos);
        CHECK(setting.value.find("DIR") == setting.value.npos);
    }
}
