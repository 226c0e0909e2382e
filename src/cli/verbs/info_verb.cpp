// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/outputs.h"
#include "cli/verb_file.h"
#include "rendering/output_files.h"
#include "reports/exit_codes.h"
#include "reports/facts_json.h"

#include "base/text_file.h"
#include "base/visible_text.h"
#include "image/npy.h"
#include "render/sample_text.h"

#include "plumb/image/image.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t name_width = 22;

void print_row(std::string_view name, std::string_view value)
{
    print_output(fmt::format("  {:<{}} {}\n", visible_text(name), name_width, value));
}

void print_value(const std::string& name, int value)
{
    print_row(name, std::to_string(value));
}

void print_value(const std::string& name, float value)
{
    print_row(name, fmt::format("{}", value));
}

// A row for each line.
void print_value(const std::string& name, const std::string& value)
{
    for (std::size_t begin = 0; begin <= value.size();) {
        const std::size_t end = std::min(value.find('\n', begin), value.size());
        print_row(begin == 0 ? name : "", visible_text(value.substr(begin, end - begin)));
        begin = end + 1;
    }
}

// A matrix in rows of four; other lists in one line.
void print_value(const std::string& name, const std::vector<float>& values)
{
    const std::size_t columns = values.size() == 16 ? 4 : std::max<std::size_t>(values.size(), 1);
    std::string line;
    for (std::size_t i = 0; i < values.size(); ++i) {
        line += fmt::format("{}{}", line.empty() ? "" : " ", values[i]);
        if ((i + 1) % columns != 0) continue;
        print_row(i < columns ? name : "", line);
        line.clear();
    }
}

struct Options : VerbOptions {
    std::string json;
    std::string pixels; // .npy; empty: none
};

void settle(Options& options)
{
    check_output_names({}, {{"--json", options.json}, {"--pixels", options.pixels}});
}

// What the command writes, and whether it can.
void check_files(const Options& options)
{
    check_outputs({}, options.json);
    std::vector<std::string> written = with_json({}, options.json);
    if (!options.pixels.empty()) {
        check_text_path(options.pixels);
        written.push_back(options.pixels);
    }
    if (const auto twice = listed_twice(written))
        throw UsageError(fmt::format("'{}' is listed as an output twice", *twice));
    KeptFiles({options.subject()}).refuse(written, "it is the image to read");
}

int run(const Options& options)
{
    const std::string& file = options.subject();
    check_files(options);
    const Image image = read_image(file, !options.pixels.empty());
    if (!options.pixels.empty()) write_npy(options.pixels, image);
    write_json(options.json, info_json(file, image));
    if (options.json == "-") return exit_code::done;
    print_output(visible_text(file) + "\n");
    print_row("size", fmt::format("{} x {}", image.full_width(), image.full_height()));
    const PixelRect& window = image.data_window();
    if (window != PixelRect{0, 0, image.full_width(), image.full_height()})
        print_row("crop", rectangle_text(window));
    std::string channels;
    for (const std::string& name : image.channel_names()) channels += (channels.empty() ? "" : " ") + name;
    print_value("channels", channels);
    for (const auto& [name, value] : image.metadata)
        std::visit([&, &key = name](const auto& v) { print_value(key, v); }, value);
    return exit_code::done;
}

} // namespace

struct InfoVerb {
    static Verb make()
    {
        return make_verb<Options>(
            {"info", "IMAGE", "print the header of an image", "image", 1, 1},
            join<Options>({json_option<Options>(),
                           text_option<Options>(Topic::output, "--pixels", "FILE",
                                                "write all channels as 32-bit floats to this\n"
                                                ".npy file, for numpy: [row, column, channel],\n"
                                                "linear",
                                                &Options::pixels),
                           help_option<Options>()}),
            run, settle);
    }
};
template const Verb& verb<InfoVerb>();

} // namespace plumb
