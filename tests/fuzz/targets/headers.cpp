// SPDX-License-Identifier: MIT

// The header of an image, as `renderer info` prints it and `renderer rerun` obeys it.

#include "cli/verbs.h"
#include "fuzz/fuzz.h"
#include "fuzz/small_scene.h"

using namespace plumb;
using namespace plumb::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const auto scene = write_file(small_scene_name, small_scene); // what a header may name
    static_cast<void>(scene);
    const std::string image = write_file("image.exr", text_of(data, size)).string();
    const auto run = [](const std::vector<std::string>& words) {
        allow_our_errors([&] { verb_of(words).parse(words)(); });
    };
    run({"info", image});
    const std::string again = (directory() / "again.exr").string();
    run({"rerun", image, "-o", again, "--threads", "1"});
    std::filesystem::remove(again);
    return 0;
}
