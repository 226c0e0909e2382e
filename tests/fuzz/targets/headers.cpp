// SPDX-License-Identifier: MIT

// The header of a picture, as `renderer info` prints it and `renderer rerun` obeys it.

#include "cli/commands.h"
#include "fuzz/fuzz.h"
#include "fuzz/small_scene.h"

using namespace plumb;
using namespace plumb::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const auto scene = write_file(small_scene_name, small_scene); // what a header may name
    static_cast<void>(scene);
    const std::string picture = write_file("picture.exr", text_of(data, size)).string();
    allow_our_errors([&] { info_command(picture); });
    RerunRequest again;
    again.image = picture;
    again.outputs = {(directory() / "again.exr").string()};
    again.threads = 1;
    allow_our_errors([&] { rerun_command(again); });
    std::filesystem::remove(again.outputs.front());
    return 0;
}
