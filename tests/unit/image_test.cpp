// SPDX-License-Identifier: MIT

#include "build_paths.h"
#include "plumb/base/error.h"
#include "plumb/image/image.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <chrono>
#include <csignal>
#include <future>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using namespace plumb;

namespace {

// An image whose values name their place, some of them outside [0, 1].
Image numbered(PixelRect data, int full_width, int full_height)
{
    Image image(data, full_width, full_height);
    for (int y = data.y; y < data.y + data.height; ++y)
        for (int x = data.x; x < data.x + data.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] =
                    static_cast<float>(100 * y + x) * 0.37f + static_cast<float>(c) * 1e-4f - 1.f;
    return image;
}

void check_same_pixels(const Image& a, const Image& b, float tolerance)
{
    REQUIRE(a.data_window() == b.data_window());
    float worst = 0.f;
    const PixelRect& w = a.data_window();
    for (int y = w.y; y < w.y + w.height; ++y)
        for (int x = w.x; x < w.x + w.width; ++x)
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]));
    CHECK(worst <= tolerance);
}

template <class T>
const T* find(const Metadata& metadata, const std::string& name)
{
    for (const auto& [key, value] : metadata)
        if (key == name) return std::get_if<T>(&value);
    return nullptr;
}

// The lean image module has no TIFF: a test says so.
constexpr bool has_tiff = std::string_view(PLUMB_IMAGES) == "oiio";

std::vector<std::string> written_formats(std::vector<std::string> names)
{
    const auto is_missing = [](const std::string& name) {
        return !has_tiff && name.find(".tif") != std::string::npos;
    };
    names.erase(std::remove_if(names.begin(), names.end(), is_missing), names.end());
    return names;
}

Image grey_ramp(int width)
{
    Image image(width, 1);
    for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
            image.pixel(x, 0)[c] = static_cast<float>(x) / static_cast<float>(width - 1);
    return image;
}

} // namespace

TEST_CASE("EXR files keep every float, the windows and the metadata", "[unit][image]")
{
    const TempDirectory directory;
    Image image = numbered({7, 3, 20, 11}, 64, 48);
    image.pixel(8, 4)[0] = 1e30f;
    image.pixel(8, 4)[1] = 1e-40f;
    const std::vector<float> matrix = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16.5f};
    image.metadata = {{"Software", std::string("Plumb")},
                      {"plumb:spp", 7},
                      {"plumb:exposure", 0.5f},
                      {"plumb:scene", std::string("cbox.xml")},
                      {"worldToCamera", matrix}};
    write_image(directory / "a.exr", image);
    const Image back = read_image(directory / "a.exr", true);
    check_same_pixels(image, back, 0.f);
    CHECK(back.full_width() == 64);
    CHECK(back.full_height() == 48);
    CHECK(back.channel_names() == std::vector<std::string>{"R", "G", "B"});
    REQUIRE(find<int>(back.metadata, "plumb:spp"));
    CHECK(*find<int>(back.metadata, "plumb:spp") == 7);
    REQUIRE(find<float>(back.metadata, "plumb:exposure"));
    CHECK(*find<float>(back.metadata, "plumb:exposure") == 0.5f);
    REQUIRE(find<std::string>(back.metadata, "plumb:scene"));
    CHECK(*find<std::string>(back.metadata, "plumb:scene") == "cbox.xml");
    REQUIRE(find<std::vector<float>>(back.metadata, "worldToCamera"));
    CHECK(*find<std::vector<float>>(back.metadata, "worldToCamera") == matrix);
    REQUIRE(find<std::string>(back.metadata, "compression"));
    CHECK(*find<std::string>(back.metadata, "compression") == "zip");
    CHECK(directory.files() == std::vector<std::string>{"a.exr"}); // nothing temporary is left
}

TEST_CASE("images that are packed fast have the same pixels", "[unit][image]")
{
    const TempDirectory directory;
    const Image image = numbered({7, 3, 20, 11}, 64, 48);
    write_image(directory / "a.exr", image, {}, Packing::fast);
    const Image back = read_image(directory / "a.exr", true);
    check_same_pixels(image, back, 0.f);
    CHECK(*find<std::string>(back.metadata, "compression") == "rle");
}

TEST_CASE("images may be written and read at the same time", "[unit][image]")
{
    const TempDirectory directory;
    const Image image = numbered({0, 0, 64, 48}, 64, 48);
    write_image(directory / "alone.exr", image);
    struct stat before {};
    REQUIRE(fstat(STDERR_FILENO, &before) == 0);
    std::vector<std::future<std::string>> files;
    for (const std::string name : {"a.exr", "b.exr", "c.exr", "d.exr"})
        files.push_back(std::async(std::launch::async, [&directory, &image, name] {
            write_image(directory / name, image);
            read_image(directory / name, false);
            return read_bytes(directory / name);
        }));
    for (std::future<std::string>& file : files) CHECK(file.get() == read_bytes(directory / "alone.exr"));
    struct stat after {}; // standard error is where it was
    REQUIRE(fstat(STDERR_FILENO, &after) == 0);
    CHECK(after.st_ino == before.st_ino);
}

TEST_CASE("the same image written twice gives the same bytes", "[unit][image]")
{
    const std::string extension =
        GENERATE(from_range(written_formats({".exr", ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".hdr"})));
    const TempDirectory directory;
    Image image = numbered({0, 0, 40, 30}, 40, 30);
    image.metadata = {{"Software", std::string("Plumb")}, {"worldToCamera", std::vector<float>(16, 1.f)}};
    write_image(directory / ("a" + extension), image);
    const auto begin = std::chrono::system_clock::now(); // time stamps in files have whole seconds
    while (std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now()) ==
           std::chrono::time_point_cast<std::chrono::seconds>(begin))
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    write_image(directory / ("b" + extension), image);
    CHECK(read_bytes(directory / ("a" + extension)) == read_bytes(directory / ("b" + extension)));
}

TEST_CASE("TIFF files keep every float, or there are none", "[unit][image]")
{
    const TempDirectory directory;
    if (!has_tiff) {
        const std::string reason = "': this build of Plumb has no TIFF; one with OpenImageIO has it "
                                   "(configured with PLUMB_IMAGES=oiio)";
        const std::string file = (directory / "a.tif").string();
        CHECK_THROWS_WITH(check_image_path(file), "cannot write '" + file + reason);
        CHECK_THROWS_WITH(write_image(file, Image(2, 2)), "cannot write '" + file + reason);
        CHECK(directory.files().empty());
        directory.write("a.tif", std::string("II*\0\10\0\0\0", 8));
        CHECK_THROWS_WITH(read_image(file, true), "cannot read '" + file + reason);
        return;
    }
    const Image image = numbered({0, 0, 20, 11}, 20, 11);
    write_image(directory / "a.tif", image);
    check_same_pixels(image, read_image(directory / "a.tif", true), 0.f);
}

TEST_CASE("HDR files keep 8 bits of the largest channel", "[unit][image]")
{
    const TempDirectory directory;
    Image image = grey_ramp(200);
    image.pixel(3, 0)[1] = 1000.f;
    write_image(directory / "a.hdr", image);
    const Image back = read_image(directory / "a.hdr", true);
    for (int x = 0; x < 200; ++x)
        for (int c = 0; c < 3; ++c) {
            const float largest =
                std::max({image.pixel(x, 0)[0], image.pixel(x, 0)[1], image.pixel(x, 0)[2]});
            CHECK(std::abs(back.pixel(x, 0)[c] - image.pixel(x, 0)[c]) <= largest / 128.f);
        }
}

TEST_CASE("HDR files hold no negative values, and no infinite ones", "[unit][image]")
{
    const TempDirectory directory;
    Image image(8, 1);
    image.pixel(0, 0)[0] = -3.f;
    image.pixel(1, 0)[1] = infinity;
    image.pixel(2, 0)[2] = std::numeric_limits<float>::quiet_NaN();
    image.pixel(3, 0)[0] = 3e38f;
    image.pixel(3, 0)[1] = -1.f;
    write_image(directory / "a.hdr", image);
    const Image back = read_image(directory / "a.hdr", true);
    constexpr float largest = 0x1.fep126f;
    const Color expected[] = {Color(0.f), Color(0.f, largest, 0.f), Color(0.f), Color(largest, 0.f, 0.f)};
    for (int x = 0; x < 4; ++x) CHECK(back.color(x, 0) == expected[x]);
}

TEST_CASE("PNG files hold the nearest 8-bit sRGB value, clamped", "[unit][image]")
{
    const TempDirectory directory;
    // The curve, solved for the linear value at the border of two 8-bit values, in double precision.
    const auto linear = [](double srgb) {
        return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
    };
    Image image(256, 2);
    for (int i = 0; i < 256; ++i) {
        const float above = static_cast<float>(linear((i - 0.49) / 255.0));
        const float below = static_cast<float>(linear((i + 0.49) / 255.0));
        for (int c = 0; c < 3; ++c) {
            image.pixel(i, 0)[c] = above;
            image.pixel(i, 1)[c] = below;
        }
    }
    image.pixel(0, 0)[0] = -5.f;
    image.pixel(0, 0)[1] = std::numeric_limits<float>::quiet_NaN();
    image.pixel(255, 1)[0] = infinity;
    const int stops = GENERATE(0, 3, -2);
    Image scaled(256, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 256; ++x)
            for (int c = 0; c < 3; ++c) scaled.pixel(x, y)[c] = std::ldexp(image.pixel(x, y)[c], -stops);
    write_image(directory / "a.png", scaled, {static_cast<float>(stops)});

    const Image raw = read_image(directory / "a.png", false);
    const Image decoded = read_image(directory / "a.png", true);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 256; ++x)
            for (int c = 0; c < 3; ++c) {
                CAPTURE(x, y, c, stops);
                REQUIRE(raw.pixel(x, y)[c] == static_cast<float>(x) / 255.f);
                REQUIRE(decoded.pixel(x, y)[c] == Approx(linear(x / 255.0)).epsilon(1e-6));
            }
}

TEST_CASE("JPEG files are near what was written", "[unit][image]")
{
    const TempDirectory directory;
    const Image image = grey_ramp(64);
    const std::string name = GENERATE(as<std::string>{}, "a.jpg", "a.JPEG");
    write_image(directory / name, image);
    check_same_pixels(image, read_image(directory / name, true), 0.02f);
}

TEST_CASE("formats without windows hold the pixels that exist", "[unit][image]")
{
    const TempDirectory directory;
    const std::string name = GENERATE(from_range(written_formats({"a.png", "a.tif", "a.hdr", "a.jpg"})));
    write_image(directory / name, numbered({7, 3, 20, 11}, 64, 48));
    const Image back = read_image(directory / name, false);
    CHECK(back.data_window() == PixelRect{0, 0, 20, 11});
    CHECK(back.full_width() == 20);
    CHECK(back.full_height() == 11);
}

TEST_CASE("grey images have one channel, and alpha does not touch the colours", "[unit][image]")
{
    const TempDirectory directory;
    Image grey({0, 0, 3, 1}, 3, 1, {"Y"});
    *grey.pixel(1, 0) = 0.25f;
    write_image(directory / "grey.exr", grey);
    const Image back = read_image(directory / "grey.exr", false);
    CHECK(back.channel_count() == 1);
    CHECK(back.color(1, 0) == Color(0.25f));

    Image clear({0, 0, 2, 1}, 2, 1, {"R", "G", "B", "A"});
    for (int c = 0; c < 3; ++c) clear.pixel(1, 0)[c] = 1.f;
    const std::string name = GENERATE(as<std::string>{}, "clear.png", "clear.exr");
    write_image(directory / name, clear); // alpha is 0 everywhere
    const Image read = read_image(directory / name, true);
    REQUIRE(read.channel_count() == 4);
    CHECK(read.pixel(1, 0)[3] == 0.f);
    CHECK(read.color(1, 0) == Color(1.f));

    for (int c = 0; c < 4; ++c) clear.pixel(0, 0)[c] = 0.2f;
    write_image(directory / name, clear);
    const Image back_again = read_image(directory / name, true);
    for (int c = 0; c < 3; ++c) CHECK(back_again.pixel(0, 0)[c] == Approx(0.2f).margin(0.003));
}

TEST_CASE("images with many channels are read whole", "[unit][image]")
{
    const TempDirectory directory;
    Image image({0, 0, 2, 2}, 2, 2, {"R", "G", "B", "A", "Z", "depth.x"});
    for (int c = 0; c < 6; ++c) image.pixel(1, 1)[c] = static_cast<float>(c);
    write_image(directory / "many.exr", image);
    const Image back = read_image(directory / "many.exr", true);
    CHECK(back.channel_count() == 6);
    CHECK(back.color(1, 1) == Color(0.f, 1.f, 2.f));
}

TEST_CASE("what is neither colour nor alpha is left out of formats that name no channels", "[unit][image]")
{
    struct Case {
        std::vector<std::string> channels;
        int colors;
        bool has_alpha;
    };
    const Case one = GENERATE(Case{{"R", "G", "B", "count"}, 3, false},
                              Case{{"R", "G", "B", "Z", "id", "normal.X"}, 3, false},
                              Case{{"R", "G", "B", "A", "Z"}, 3, true}, Case{{"Y", "Z"}, 1, false},
                              Case{{"Y", "A", "depth.Z"}, 1, true});
    const TempDirectory directory;
    Image image({0, 0, 16, 16}, 16, 16, one.channels);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < image.channel_count(); ++c)
                image.pixel(x, y)[c] = c < one.colors ? 0.25f : 0.f;
    for (const std::string& name : written_formats({"a.png", "a.jpg", "a.hdr", "a.tif"})) {
        CAPTURE(name, one.channels);
        const bool holds_alpha = name == "a.png" || name == "a.tif";
        if (one.colors == 1 && name == "a.hdr") continue; // it has no grey
        write_image(directory / name, image);
        const Image back = read_image(directory / name, true);
        if (holds_alpha) CHECK(back.channel_count() == one.colors + (one.has_alpha ? 1 : 0));
        CHECK(back.color(8, 8).g == Approx(0.25f).margin(0.004));
        if (one.has_alpha && holds_alpha) CHECK(back.pixel(8, 8)[one.colors] == 0.f);
    }
}

TEST_CASE("a path that cannot be written is found out", "[unit][image]")
{
    const TempDirectory directory;
    const auto check = [&](const std::string& name, const std::string& reason) {
        CHECK_THROWS_WITH(check_image_path(directory / name),
                          ContainsSubstring(name) && ContainsSubstring(reason));
        CHECK_THROWS_WITH(write_image(directory / name, Image(2, 2)), ContainsSubstring(reason));
    };
    check("a.bmp", "unknown extension '.bmp'; known are .exr, .hdr, .tif, .tiff, .png, .jpg, .jpeg");
    check("a", "the name has no extension; known are .exr");
    check("none/a.exr", "the directory '" + (directory / "none").string() + "' does not exist");
    std::filesystem::create_directory(directory / "b.exr");
    check("b.exr", "a directory of that name exists");
    directory.write("file", "");
    check("file/a.exr", "is not a directory");
    check("", "no file name");
    CHECK(directory.files() == std::vector<std::string>{"b.exr", "file"});
    CHECK_NOTHROW(check_image_path(directory / "good.EXR"));
    CHECK(directory.files() == std::vector<std::string>{"b.exr", "file"}); // checking leaves nothing behind
}

TEST_CASE("writing that fails keeps the file that was there", "[unit][image]")
{
    const TempDirectory directory;
    directory.write("a.hdr", "precious");
    const Image image({0, 0, 2, 2}, 2, 2, {"Y"}); // the format has no grey
    std::string message;
    try {
        write_image(directory / "a.hdr", image);
    } catch (const Error& error) {
        message = error.what();
    }
    CHECK_THAT(message, ContainsSubstring("cannot write '" + (directory / "a.hdr").string() + "': "));
    CHECK(message.find('\n') == std::string::npos);
    CHECK(read_bytes(directory / "a.hdr") == "precious");
    CHECK(directory.files() == std::vector<std::string>{"a.hdr"});
}

TEST_CASE("a disk that is full is an error, and nothing is left of the file", "[unit][image]")
{
    // Files of more than 100 bytes fail as on a full disk, by another name.
    struct SmallFiles {
        rlimit before{};
        void (*handler)(int);
        SmallFiles() : handler(std::signal(SIGXFSZ, SIG_IGN))
        {
            getrlimit(RLIMIT_FSIZE, &before);
            const rlimit small{100, before.rlim_max};
            setrlimit(RLIMIT_FSIZE, &small);
        }
        ~SmallFiles()
        {
            setrlimit(RLIMIT_FSIZE, &before);
            std::signal(SIGXFSZ, handler);
        }
    };
    const std::string extension =
        GENERATE(from_range(written_formats({".exr", ".png", ".jpg", ".tif", ".hdr"})));
    const TempDirectory directory;
    const Image image = numbered({0, 0, 64, 64}, 64, 64);
    std::string message;
    {
        const SmallFiles small;
        try {
            write_image(directory / ("a" + extension), image);
        } catch (const Error& error) {
            message = error.what();
        }
    }
    CHECK(message == "cannot write '" + (directory / ("a" + extension)).string() + "': File too large");
    CHECK(directory.files().empty());
}

TEST_CASE("broken images are errors on one line that name the file", "[unit][image]")
{
    const TempDirectory directory;
    const auto check = [&](const std::string& name) {
        try {
            read_image(directory / name, true);
            FAIL("read " << name);
        } catch (const Error& error) {
            const std::string text = error.what();
            CHECK(text.starts_with("cannot read '" + (directory / name).string() + "': "));
            CHECK(text.size() > ("cannot read '" + (directory / name).string() + "': ").size());
            CHECK(text.find('\n') == std::string::npos);
            CHECK(text.back() != '.');
        }
    };
    check("missing.png");
    std::filesystem::create_directory(directory / "directory.png");
    check("directory.png");
    check("/dev/zero"); // would never end
    for (const std::string extension : {".png", ".exr", ".hdr", ".tif", ".jpg"}) {
        directory.write("empty" + extension, "");
        check("empty" + extension);
        directory.write("text" + extension, "this is no image");
        check("text" + extension);
    }
    for (const std::string& extension : written_formats({".png", ".exr", ".tif", ".jpg", ".hdr"})) {
        write_image(directory / ("whole" + extension), numbered({0, 0, 64, 64}, 64, 64));
        const std::string bytes = read_bytes(directory / ("whole" + extension));
        directory.write("half" + extension, bytes.substr(0, bytes.size() / 2));
        check("half" + extension);
    }
}

TEST_CASE("images that cannot be are errors", "[unit][image]")
{
    CHECK_THROWS_WITH(Image(0, 5), ContainsSubstring("0 x 5 pixels"));
    CHECK_THROWS_WITH(Image(5, -1), ContainsSubstring("5 x -1 pixels"));
    CHECK_THROWS_WITH(Image(2000000000, 2000000000), ContainsSubstring("2000000000 x 2000000000 pixels"));
    CHECK_THROWS_WITH(Image({0, 0, 5, 5}, 5, 5, {}), ContainsSubstring("0 channels"));
}

namespace {

// A TIFF file of grey pixels, the first of which is at this column.
std::string tiff_at(std::uint32_t column, std::uint32_t width)
{
    std::string file("II*\0", 4);
    const auto add = [&file](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) file += static_cast<char>(value >> 8 * i & 0xff);
    };
    constexpr std::uint32_t short_number = 3;
    constexpr std::uint32_t number = 4;
    constexpr std::uint32_t fraction = 5;
    constexpr std::uint32_t entries = 11;
    constexpr std::uint32_t fractions_at = 8 + 2 + entries * 12 + 4;
    add(8, 4);
    add(entries, 2);
    const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t value) {
        add(tag, 2);
        add(type, 2);
        add(1, 4);
        add(value, 4);
    };
    entry(256, number, width);
    entry(257, number, 1);                  // height
    entry(258, short_number, 8);            // bits
    entry(259, short_number, 1);            // not compressed
    entry(262, short_number, 1);            // 0 is black
    entry(273, number, fractions_at + 16);  // where the pixels are
    entry(277, short_number, 1);            // channels
    entry(278, number, 1);                  // rows in a strip
    entry(279, number, width);              // bytes in a strip
    entry(282, fraction, fractions_at + 8); // pixels in a unit
    entry(286, fraction, fractions_at);     // column, in units
    add(0, 4);
    for (const std::uint32_t part : {column, 1u, 1u, 1u}) add(part, 4);
    return file + std::string(width, '\x64');
}

} // namespace

// OpenImageIO says of the last two that they were read, and they were not.
TEST_CASE("images far from any corner are read right or refused", "[unit][image]")
{
    if (!has_tiff) return; // tests/images has the same for EXR
    const TempDirectory directory;
    const auto read = [&](std::uint32_t column) {
        directory.write("far.tif", tiff_at(column, 200));
        return read_image(directory / "far.tif", false);
    };
    for (const std::uint32_t column : {0u, 5u, 1u << 29}) {
        const Image image = read(column);
        const PixelRect& window = image.data_window();
        CHECK(window.width == 200);
        CHECK(image.pixel(window.x + 199, window.y)[0] == Approx(100.0 / 255.0));
    }
    for (const std::uint32_t column : {1u << 30, 2147483000u, 2147483520u})
        CHECK_THROWS_WITH(read(column), ContainsSubstring("its pixels are too far from the image's corner"));
}

TEST_CASE("images can be moved", "[unit][image]")
{
    Image a = numbered({1, 2, 3, 4}, 10, 10);
    const float value = a.pixel(2, 3)[1];
    Image b(std::move(a));
    CHECK(b.pixel(2, 3)[1] == value);
    Image c(1, 1);
    c = std::move(b);
    CHECK(c.pixel(2, 3)[1] == value);
    CHECK(c.data_window() == PixelRect{1, 2, 3, 4});
}
