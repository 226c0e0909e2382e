// SPDX-License-Identifier: MIT

// report.html: the results as JSON and the images as base64, inside the page of report.html.

#include "reports/image_data.h"
#include "reports/json_document.h"
#include "reports/report_page.h"
#include "reports/suite_json.h"

#include "base/visible_text.h"
#include "plumb/base/error.h"

#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace plumb {

namespace {

// A browser should still like the page: about a hundred megabytes of images.
constexpr double most_pixels = 18e6;

std::string read_bytes(const std::string& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// By how much the images must shrink so that all of them are not too many pixels together.
int reduction_for(const Image& image, std::size_t images)
{
    const double pixels = static_cast<double>(image.data_window().width) * image.data_window().height;
    int reduction = 1;
    while (pixels / (reduction * reduction) * static_cast<double>(images) > most_pixels) ++reduction;
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
    PageWriter(const SuiteRun& run, const ShownImages& images, const std::vector<std::string>& history)
        : run_(run), shown_(images), history_(history)
    {}

    std::string write()
    {
        begin_document(json_, "batch");
        write_summary(json_, run_);
        json_.begin_array("history"); // lines of JSON, which the page reads one by one: a file may be damaged
        for (const std::string& line : history_) json_.text({}, line);
        json_.end_array();
        json_.begin_array("images");
        for (const SuiteResult& result : run_.results) {
            json_.begin_object();
            write_result(json_, result);
            write_images(result);
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
        put("{{images}}", images_);
        return page.append(rest);
    }

private:
    void write_images(const SuiteResult& result)
    {
        const ShownImages::Shown* shown = shown_.find(result.title);
        if (!shown) return;
        json_.begin_object("shown");
        json_.integer("width", static_cast<std::uint64_t>(shown->width));
        json_.integer("height", static_cast<std::uint64_t>(shown->height));
        json_.integer("reduction", static_cast<std::uint64_t>(shown->reduction));
        add("image", shown->image);
        if (!shown->reference.empty()) add("reference", shown->reference);
        if (!result.difference.empty()) add("difference", read_bytes(result.difference));
        if (!result.significant.empty()) add("significant", read_bytes(result.significant));
        json_.end_object();
    }

    // An element of its own, so that the page decodes what is looked at.
    void add(std::string_view key, const std::string& bytes)
    {
        json_.text(key, fmt::format("data-{}", number_));
        images_ +=
            fmt::format("<script type=\"text/plain\" id=\"data-{}\">{}</script>\n", number_++, base64(bytes));
    }

    const SuiteRun& run_;
    const ShownImages& shown_;
    const std::vector<std::string>& history_;
    JsonWriter json_;
    std::string images_;
    int number_ = 0;
};

} // namespace

ShownImages::ShownImages(std::size_t count) : count_(count) {}

void ShownImages::add(const SuiteResult& result, const SuiteImages& images)
{
    if (!images.image || result.image.empty()) return;
    const int reduction = reduction_for(*images.image, count_);
    const PixelRect& window = images.image->data_window();
    Shown& shown = shown_[result.title];
    shown = {reduced_size(window.width, reduction),
             reduced_size(window.height, reduction),
             reduction,
             shared_exponent_bytes(*images.image, reduction),
             {}};
    if (result.comparison && images.reference)
        shown.reference = shared_exponent_bytes(*images.reference, reduction);
}

const ShownImages::Shown* ShownImages::find(const std::string& title) const
{
    const auto found = shown_.find(title);
    return found == shown_.end() ? nullptr : &found->second;
}

std::string suite_html(const SuiteRun& run, const ShownImages& images,
                       const std::vector<std::string>& history)
{
    return PageWriter(run, images, history).write();
}

} // namespace plumb
