// SPDX-License-Identifier: MIT

// Suites and test files.

#include "plumb/suite_file/suite.h"
#include "fuzz/fuzz.h"
#include "plumb/test_file/test_file.h"

using namespace plumb;
using namespace plumb::fuzz;

namespace {

constexpr std::string_view settings[] = {"spp",          "seed",    "size", "crop",
                                         "integrator",   "sampler", "max",  "fail-percent",
                                         "significance", "exact",   "flip", "dialect"};

// What a pattern may find.
void make_scenes()
{
    static const bool once = [] {
        for (const char* name : {"a.scene.xml", "b.scene.xml"}) write_file(name, "<scene/>");
        return true;
    }();
    static_cast<void>(once);
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    make_scenes();
    const auto path = write_file("input.xml", text_of(data, size));
    allow_our_errors([&] {
        const Suite suite = load_suite(path, {}, settings);
        expect(!suite.entries.empty(), "a suite of nothing");
        for (const SuiteEntry& entry : suite.entries)
            expect(!entry.title().empty(), "an image without a name");
    });
    allow_our_errors([&] {
        RenderSettings options;
        options.view.crop = PixelRect{0, 0, 1, 1};
        const TestFile test = load_test(path, options);
        for (const Diagnostic& warning : test.warnings) expect_printable(warning.text());
        expect(test.test_count() > 0 && test.test_count() <= max_tests, "no tests, or too many");
    });
    return 0;
}
