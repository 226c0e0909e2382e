// SPDX-License-Identifier: MIT

// `renderer merge` of one part or more. Most inputs have the right hashes (state_mutator.h).

#include "cli/commands.h"
#include "fuzz/fuzz.h"
#include "fuzz/picture_text.h"
#include "fuzz/state_mutator.h"

using namespace plumb;
using namespace plumb::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    MergeRequest request;
    for (const std::string_view part : split_pictures(text_of(data, size))) {
        if (request.parts.size() > 3) break;
        const std::string name = "part" + std::to_string(request.parts.size()) + ".exr";
        request.parts.push_back(write_file(name, part).string());
    }
    for (const char* output : {"merged.exr", "merged.png"})
        request.outputs.push_back((directory() / output).string());
    request.checkpoint = (directory() / "sum.exr").string();
    request.allow_missing = true;
    allow_our_errors([&] { merge_command(request); });
    for (const char* output : {"merged.exr", "merged.png", "sum.exr", "sum.previous.exr"})
        std::filesystem::remove(directory() / output);
    return 0;
}
