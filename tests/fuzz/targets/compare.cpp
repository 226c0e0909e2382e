// SPDX-License-Identifier: MIT

// Images that are compared: what a codec made of two files.

#include "plumb/compare/compare.h"
#include "fuzz/fuzz.h"
#include "fuzz/image_text.h"

#include <cmath>

using namespace plumb;
using namespace plumb::fuzz;

namespace {

void check(const Comparison& comparison)
{
    const Significance& significance = comparison.significance;
    expect(significance.p >= 0.0 && significance.p <= 1.0, "a chance that is none");
    expect(significance.differing + significance.untested <= significance.pixels,
           "more pixels than there are");
    const Metrics& metrics = comparison.metrics;
    for (const double metric : {metrics.mse, metrics.rmse, metrics.relative_mse, metrics.mae, metrics.max})
        expect(!(metric < 0.0), "a negative error");
    if (metrics.flip) expect(*metrics.flip >= 0.0 && *metrics.flip <= 1.0, "FLIP is not from 0 to 1");
    for (const ScaleTest& test : significance.scales) {
        expect(test.rejected <= test.tested && test.tested <= test.units, "more squares than there are");
        if (test.largest) expect(test.largest->p >= 0.0, "a chance that is none");
    }
}

void compare_two(const Image& a, const Image& b, FlipMode flip)
{
    CompareSettings options;
    options.flip = flip;
    const Comparison comparison = compare(a, b, options);
    check(comparison);
    difference_image(a, b);
    if (flip != FlipMode::none) flip_image(comparison);
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::vector<std::string_view> images = split_images(text_of(data, size));
    const auto first = write_file("a.exr", images.front());
    const auto second = write_file("b.exr", images.back());
    allow_our_errors([&] {
        const Image a = read_image(first, true);
        const Image b = read_image(second, true);
        // FLIP looks at some thousand values for each pixel.
        const bool small = double(a.data_window().width) * double(a.data_window().height) <= 256.0;
        const FlipMode mode = size % 2 == 0 ? FlipMode::hdr : FlipMode::ldr;
        compare_two(a, b, small ? mode : FlipMode::none);
        const Comparison same = compare(a, a, {.flip = FlipMode::none});
        expect(same.verdict != Verdict::differs, "an image differs from itself");
    });
    return 0;
}
