// SPDX-License-Identifier: MIT
#include "plumb/denoise/denoise.h"

#include "denoise/oidn.h"
#include "plumb/base/error.h"
#include "plumb/image/development.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace plumb {

namespace {

// Of the error bars of the colours, and of what is said of them.
bool is_of_noise(const std::string& channel)
{
    return channel.starts_with("variance.") || channel == "contributing";
}
constexpr std::string_view noise_entries[] = {"plumb:rmse", "plumb:rmseInterval", "plumb:errorBars"};

// Three floats a pixel, by rows.
struct Plane {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<float> values;

    bool is_black() const
    {
        return std::ranges::all_of(values, [](float value) { return !(value != 0.f); });
    }
};

using Places = std::array<std::size_t, 3>;

std::optional<Places> find_channels(const Image& image, const std::array<std::string, 3>& names)
{
    Places places{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto found = std::ranges::find(image.channel_names(), names[i]);
        if (found == image.channel_names().end()) return {};
        places[i] = static_cast<std::size_t>(found - image.channel_names().begin());
    }
    return places;
}

Plane read_plane(const Image& image, const Places& places)
{
    const PixelRect& window = image.data_window();
    Plane plane{static_cast<std::size_t>(window.width), static_cast<std::size_t>(window.height), {}};
    plane.values.reserve(plane.width * plane.height * places.size());
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            for (const std::size_t place : places) plane.values.push_back(image.pixel(x, y)[place]);
    return plane;
}

// A layer that guides the filter.
struct Guide {
    std::string layer;
    Plane plane;
};

// The first of the layers that the image has; one that is black everywhere, as those of an integrator that does not follow mirrors
// are, tells nothing.
std::optional<Guide> find_guide(const Image& image, const std::string& name,
                                const std::array<const char*, 3>& parts)
{
    for (const std::string& layer : {name + "_behind", name}) {
        const auto places =
            find_channels(image, {layer + "." + parts[0], layer + "." + parts[1], layer + "." + parts[2]});
        if (!places) continue;
        Plane plane = read_plane(image, *places);
        if (!plane.is_black()) return Guide{layer, std::move(plane)};
    }
    return {};
}

// A processor that filters. Reports errors as exceptions.
class Denoiser {
public:
    explicit Denoiser(int threads) : device_(oidn().new_device(oidn::cpu), oidn().release_device)
    {
        if (!device_) throw Error("cannot denoise: Open Image Denoise does not support this processor");
        if (threads > 0) oidn().set_device_int(device_.get(), "numThreads", threads);
        oidn().set_device_bool(device_.get(), "setAffinity", false);
        oidn().commit_device(device_.get());
        check();
    }

    std::string version() const
    {
        const int number = oidn().get_device_int(device_.get(), "version"); // 20501
        return fmt::format("{}.{}.{}", number / 10000, number / 100 % 100, number % 100);
    }

    // Of noisy guides: the filter does better with clean ones ("Prefiltering" in the manual).
    void prefilter(const char* name, Plane& plane)
    {
        const FilterPointer filter = make_filter();
        set_image(filter, name, plane);
        set_image(filter, "output", plane);
        execute(filter);
    }

    void filter_colors(Plane& colors, std::optional<Guide>& albedo, std::optional<Guide>& normal)
    {
        const FilterPointer filter = make_filter();
        set_image(filter, "color", colors);
        if (albedo) set_image(filter, "albedo", albedo->plane);
        if (normal) set_image(filter, "normal", normal->plane);
        set_image(filter, "output", colors);
        oidn().set_filter_bool(filter.get(), "hdr", true);
        if (albedo || normal) oidn().set_filter_bool(filter.get(), "cleanAux", true);
        execute(filter);
    }

private:
    using DevicePointer = std::unique_ptr<oidn::DeviceImpl, void (*)(oidn::Device)>;
    using FilterPointer = std::unique_ptr<oidn::FilterImpl, void (*)(oidn::Filter)>;

    static const oidn::Library& oidn() { return oidn::library(); }

    void check() const
    {
        const char* message = nullptr;
        if (oidn().get_device_error(device_.get(), &message) != 0)
            throw Error(fmt::format("cannot denoise: {}", message ? message : "unknown error"));
    }
    FilterPointer make_filter() const
    {
        FilterPointer filter(oidn().new_filter(device_.get(), "RT"), oidn().release_filter);
        check();
        return filter;
    }
    static void set_image(const FilterPointer& filter, const char* name, Plane& plane)
    {
        oidn().set_shared_filter_image(filter.get(), name, plane.values.data(), oidn::float3, plane.width,
                                       plane.height, 0, 0, 0);
    }
    void execute(const FilterPointer& filter) const
    {
        oidn().commit_filter(filter.get());
        oidn().execute_filter(filter.get());
        check();
    }

    DevicePointer device_;
};

Metadata header_of(const Metadata& before, const std::string& how)
{
    Metadata header;
    std::string biases;
    for (const auto& entry : before) {
        const auto& [name, value] = entry;
        if (const auto* const text = std::get_if<std::string>(&value); text && name == "plumb:biases")
            biases = *text + ", ";
        if (name != "plumb:biases" && name != "plumb:biased" && name != denoised_entry &&
            std::ranges::find(noise_entries, name) == std::end(noise_entries))
            header.push_back(entry);
    }
    header.emplace_back("plumb:biased", 1);
    header.emplace_back("plumb:biases", biases + "it was denoised");
    header.emplace_back(std::string(denoised_entry), how);
    return header;
}

} // namespace

void check_denoiser()
{
    oidn::library();
}

Image denoised(const Image& image, int threads)
{
    if (std::ranges::any_of(image.metadata, [](const auto& entry) { return entry.first == "plumb:state"; }))
        throw Error(
            "cannot denoise a checkpoint or a partial render, whose layers are sums; 'renderer merge FILE "
            "-o IMAGE.exr', with --allow-missing if it is not over, makes an image of it");
    const auto places = find_channels(image, {"R", "G", "B"});
    if (!places) throw Error("cannot denoise an image without the channels R, G and B");
    if (const std::string before = denoised_text(image.metadata); !before.empty())
        throw Error(fmt::format("the image is denoised already: {}", before));
    Plane colors = read_plane(image, *places);
    std::optional<Guide> albedo = find_guide(image, "albedo", {"R", "G", "B"});
    std::optional<Guide> normal = find_guide(image, "normal", {"X", "Y", "Z"});

    Denoiser denoiser(threads);
    if (albedo) denoiser.prefilter("albedo", albedo->plane);
    if (normal) denoiser.prefilter("normal", normal->plane);
    denoiser.filter_colors(colors, albedo, normal);

    std::vector<std::string> names;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < image.channel_names().size(); ++i) {
        if (is_of_noise(image.channel_names()[i])) continue;
        names.push_back(image.channel_names()[i]);
        kept.push_back(i);
    }
    const PixelRect& window = image.data_window();
    Image result(window, image.full_width(), image.full_height(), names);
    const float* color = colors.values.data();
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x, color += 3) {
            for (std::size_t i = 0; i < kept.size(); ++i) {
                const auto of_color = std::ranges::find(*places, kept[i]);
                result.pixel(x, y)[i] = of_color == places->end() ? image.pixel(x, y)[kept[i]]
                                                                  : color[of_color - places->begin()];
            }
        }
    }
    std::string how = "Open Image Denoise " + denoiser.version();
    if (albedo || normal)
        how += fmt::format(" with {}{}{}", albedo ? albedo->layer : "", albedo && normal ? " and " : "",
                           normal ? normal->layer : "");
    result.metadata = header_of(image.metadata, how);
    return result;
}

std::string denoised_text(const Metadata& header)
{
    for (const auto& [name, value] : header)
        if (const auto* const text = std::get_if<std::string>(&value); text && name == denoised_entry)
            return *text;
    const std::string display = display_text(header); // all that a JPEG file says
    return display.starts_with("denoised") ? display : std::string();
}

} // namespace plumb
