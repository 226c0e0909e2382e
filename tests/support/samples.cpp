// SPDX-License-Identifier: MIT

#include "support/samples.h"

#include "plumb/image/image.h"
#include "support/mesh_files.h"

namespace plumb::test {

namespace {

Image small_image()
{
    Image image(5, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x)
            for (int channel = 0; channel < 3; ++channel)
                image.pixel(x, y)[channel] =
                    0.1f + 0.1f * static_cast<float>((x * 2 + y * 3 + channel * 5) % 7);
    return image;
}

void make_files(const Element& element, const TempDirectory& directory)
{
    for (const Element& child : element.children) {
        make_files(child, directory);
        if (child.tag != "string" || !child.value("name").starts_with("file")) continue;
        const std::filesystem::path name = child.value("value");
        const std::string mesh = pyramid_file(name);
        const std::filesystem::path file = directory.write(name, mesh);
        if (mesh.empty()) write_image(file, small_image());
    }
}

} // namespace

std::vector<std::string> samples_in(std::string_view manual)
{
    constexpr std::string_view indent = "        ";
    std::vector<std::string> samples;
    while (!manual.empty()) {
        const std::size_t end = std::min(manual.find('\n'), manual.size());
        const std::string_view line = manual.substr(0, end);
        manual.remove_prefix(std::min(end + 1, manual.size()));
        const bool is_code = line.starts_with(indent) && line.find('<') != line.npos;
        if (!is_code) continue;
        // Elements begin and end at this indentation; what is in them stands further right.
        const std::string_view code = line.substr(indent.size());
        if (code.starts_with("<") && !code.starts_with("</")) samples.emplace_back();
        samples.back().append(code).append("\n");
    }
    return samples;
}

Sample::Sample(const std::string& xml) : text_(xml)
{
    Diagnostics diagnostics;
    auto root = parse_document(directory_ / "sample.xml", "<scene>\n" + xml + "</scene>\n", diagnostics);
    if (!root || diagnostics.has_errors() || root->children.size() != 1)
        throw std::runtime_error(complaints(diagnostics));
    element_ = std::move(root->children.front());
    make_files(element_, directory_);
}

std::string Sample::complaints(const Diagnostics& diagnostics) const
{
    std::string all = text_;
    for (const Diagnostic& diagnostic : diagnostics.all()) all += diagnostic.message + "\n";
    return all;
}

} // namespace plumb::test
