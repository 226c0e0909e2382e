// SPDX-License-Identifier: MIT

// report.html: the results as JSON and the pictures as base64, inside the page of report.html.

#include "cli/batch/json_report.h"
#include "cli/batch/picture_data.h"
#include "cli/batch/report_page.h"

#include "base/visible_text.h"
#include "plumb/base/error.h"

#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace plumb {

namespace {

// A browser should still like the page: about a hundred megabytes of pictures.
constexpr double most_pixels = 18e6;

// What cannot be read any more is left out.
std::optional<Image> read_if_possible(const std::string& file)
{
    if (file.empty()) return {};
    try {
        return read_image(file, true);
    } catch (const Error&) {
        return {};
    }
}

std::string read_bytes(const std::string& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// By how much the pictures must shrink so that all of them are not too many pixels together.
int reduction_for(const Image& image, std::size_t pictures)
{
    const double pixels = static_cast<double>(image.data_window().width) * image.data_window().height;
    int reduction = 1;
    while (pixels / (reduction * reduction) * static_cast<double>(pictures) > most_pixels) ++reduction;
    return reduction;
}

// JSON and base64 inside a <script>: nothing there may look like a tag.
std::string script_text(std::string text)
{
    for (std::size_t i = text.find('<'); i != text.npos; i = text.find('<', i)) text.replace(i, 1, "\\u003c");
    return text;
}

std::string html_text(std::string_view text)
{
    std::string result;
    for (const char c : visible_text(text))
        result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return result;
}

class PageWriter {
public:
    explicit PageWriter(const BatchRun& run) : run_(run)
    {
        for (const BatchResult& result : run.results)
            pictures_shown_ += (result.picture.empty() ? 0u : 1u) + (result.comparison ? 1u : 0u);
    }

    std::string write()
    {
        json_.begin_object();
        write_summary(json_, run_);
        json_.begin_array("pictures");
        for (const BatchResult& result : run_.results) {
            json_.begin_object();
            write_result(json_, result);
            write_pictures(result);
            json_.end_object();
        }
        json_.end_array();
        json_.end_object();

        std::string page;
        std::string_view rest = report_page;
        const auto put = [&](std::string_view place, const std::string& text) {
            const std::size_t at = rest.find(place);
            page.append(rest.substr(0, at)).append(text);
            rest.remove_prefix(at + place.size());
        };
        put("{{title}}", html_text(run_.suite));
        put("{{data}}", script_text(std::move(json_).finish()));
        put("{{pictures}}", pictures_);
        return page.append(rest);
    }

private:
    void write_pictures(const BatchResult& result)
    {
        const std::optional<Image> picture = read_if_possible(result.picture);
        if (!picture) return;
        const int reduction = reduction_for(*picture, pictures_shown_);
        const PixelRect& window = picture->data_window();
        json_.begin_object("shown");
        json_.integer("width", static_cast<std::uint64_t>(reduced_size(window.width, reduction)));
        json_.integer("height", static_cast<std::uint64_t>(reduced_size(window.height, reduction)));
        json_.integer("reduction", static_cast<std::uint64_t>(reduction));
        add("picture", shared_exponent_bytes(*picture, reduction));
        if (result.comparison)
            if (const std::optional<Image> reference = read_if_possible(result.reference))
                add("reference", shared_exponent_bytes(*reference, reduction));
        if (!result.difference.empty()) add("difference", read_bytes(result.difference));
        json_.end_object();
    }

    // An element of its own, so that the page decodes what is looked at.
    void add(std::string_view key, const std::string& bytes)
    {
        json_.text(key, fmt::format("data-{}", number_));
        pictures_ +=
            fmt::format("<script type=\"text/plain\" id=\"data-{}\">{}</script>\n", number_++, base64(bytes));
    }

    const BatchRun& run_;
    std::size_t pictures_shown_ = 0;
    JsonWriter json_;
    std::string pictures_;
    int number_ = 0;
};

} // namespace

std::string batch_html(const BatchRun& run)
{
    return PageWriter(run).write();
}

} // namespace plumb
