// SPDX-License-Identifier: MIT

// Image files of all formats, as the lean image module reads them.

#include "fuzz/fuzz.h"
#include "image/image_words.h"
#include "plumb/image/image.h"

using namespace plumb;
using namespace plumb::fuzz;

namespace {

void read_every_word(const std::filesystem::path& path)
{
    std::size_t row_size = 0;
    read_words(
        path,
        [&](const WordImage& image) {
            std::vector<std::string> names = image.word_channels;
            names.insert(names.end(), image.float_channels.begin(), image.float_channels.end());
            row_size = static_cast<std::size_t>(image.data.width) * names.size();
            return names;
        },
        [&](int, std::span<const std::uint32_t> row) {
            expect(row.size() == row_size, "a row is not whole");
        });
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto path =
        write_file("image.tga", text_of(data, size)); // other formats say themselves what they are
    allow_our_errors([&] {
        const Image image = read_image(path, true);
        const PixelRect& window = image.data_window();
        expect(window.width > 0 && window.height > 0 && image.channel_count() > 0, "there is nothing in it");
        float sum = 0.f;
        for (int y = window.y; y < window.y + window.height; ++y)
            for (int i = 0; i < window.width * image.channel_count(); ++i) sum += image.pixel(window.x, y)[i];
        static_cast<void>(sum);
        for (const char* const name : {"written.exr", "written.png", "written.hdr", "written.jpg"})
            allow_our_errors([&] { write_image(directory() / name, image); });
    });
    allow_our_errors([&] {
        const auto bytes = read_byte_image(path);
        if (!bytes) return;
        const std::size_t count = static_cast<std::size_t>(bytes->width) *
                                  static_cast<std::size_t>(bytes->height) *
                                  static_cast<std::size_t>(bytes->channels);
        expect(bytes->values.size() == count && count > 0, "there are not as many bytes as it says");
    });
    allow_our_errors([&] { read_every_word(path); });
    return 0;
}
