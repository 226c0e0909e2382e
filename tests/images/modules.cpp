// SPDX-License-Identifier: MIT
#include "images/modules.h"

#include "image_paths.h"
#include "plumb/base/error.h"
#include "support/random.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <dlfcn.h>

namespace plumb::test {

namespace {

const ImageModule& load(const char* path)
{
    void* const library = dlopen(path, RTLD_LAZY | RTLD_LOCAL);
    if (!library) throw std::runtime_error(dlerror());
    using Entry = const ImageModule*(const char*);
    auto* const entry = reinterpret_cast<Entry*>(dlsym(library, "plumb_image_module"));
    const ImageModule* const module = entry ? entry(PLUMB_VERSION) : nullptr;
    if (!module) throw std::runtime_error(std::string("no module of this version: ") + path);
    return *module;
}

std::string text_of(const MetadataValue& value)
{
    if (const int* const integer = std::get_if<int>(&value)) return fmt::format("int {}", *integer);
    if (const float* const number = std::get_if<float>(&value)) return fmt::format("float {}", *number);
    if (const std::string* const text = std::get_if<std::string>(&value))
        return fmt::format("text {}", *text);
    return fmt::format("floats {}", fmt::join(std::get<std::vector<float>>(value), " "));
}

std::size_t count_of(const Decoded& image)
{
    return static_cast<std::size_t>(image.data.width) * static_cast<std::size_t>(image.data.height) *
           image.channels.size();
}

} // namespace

const ImageModule& with_openimageio()
{
    static const ImageModule& module = load(PLUMB_OIIO_MODULE);
    return module;
}

const ImageModule& lean()
{
    static const ImageModule& module = load(PLUMB_LEAN_MODULE);
    return module;
}

const std::string* Decoded::find(const std::string& name) const
{
    const auto found = std::find_if(metadata.begin(), metadata.end(),
                                    [&](const std::string& entry) { return entry.starts_with(name + ": "); });
    return found == metadata.end() ? nullptr : &*found;
}

Decoded decode(const ImageModule& module, const std::filesystem::path& file)
{
    Decoded result;
    try {
        DecodedImage image = module.read(file.string());
        result.data = image.data;
        result.full_width = image.full_width;
        result.full_height = image.full_height;
        result.channels = image.channels;
        result.integer_levels = image.integer_levels;
        result.alpha_channel = image.integer_levels > 0 ? image.alpha_channel : -1;
        const auto largest = static_cast<float>(std::max<std::size_t>(image.integer_levels, 2) - 1);
        for (std::size_t i = 0; i < count_of(result); ++i) {
            const float value = image.buffer->pixels()[i];
            result.values.push_back(image.integer_levels > 0
                                        ? static_cast<std::uint32_t>(std::lround(value * largest))
                                        : std::bit_cast<std::uint32_t>(value));
        }
        for (const auto& [name, value] : image.metadata)
            result.metadata.push_back(name + ": " + text_of(value));
        std::sort(result.metadata.begin(), result.metadata.end());
    } catch (const std::exception& error) { // ours, and what OpenImageIO lets through
        result.error = error.what();
    }
    return result;
}

Decoded check_same(const std::filesystem::path& file, Compare what)
{
    const Decoded a = decode(with_openimageio(), file);
    const Decoded b = decode(lean(), file);
    CAPTURE(file.filename());
    CHECK(a.error.empty());
    CHECK(b.error.empty());
    CHECK(a.data == b.data);
    CHECK(a.full_width == b.full_width);
    CHECK(a.full_height == b.full_height);
    CHECK(a.channels == b.channels);
    CHECK(a.integer_levels == b.integer_levels);
    CHECK(a.alpha_channel == b.alpha_channel);
    CHECK(a.values.size() == b.values.size());
    CHECK((a.values == b.values));
    if (what == Compare::all) CHECK(a.metadata == b.metadata);
    if (!a.error.empty() || !b.error.empty()) return b;

    const auto bytes_a = with_openimageio().read_bytes(file.string());
    const auto bytes_b = lean().read_bytes(file.string());
    REQUIRE(bytes_a.has_value() == bytes_b.has_value());
    if (bytes_a) {
        CHECK(bytes_a->width == bytes_b->width);
        CHECK(bytes_a->height == bytes_b->height);
        CHECK(bytes_a->channels == bytes_b->channels);
        CHECK((bytes_a->values == bytes_b->values));
    }
    return b;
}

std::uint32_t random_bits()
{
    static TestRandom random(20261101);
    return static_cast<std::uint32_t>(random.next_bits());
}

} // namespace plumb::test
