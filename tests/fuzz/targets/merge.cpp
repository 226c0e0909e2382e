// SPDX-License-Identifier: MIT

// `renderer merge` of one part or more. Most inputs have the right hashes (state_mutator.h).

#include "cli/verbs.h"
#include "fuzz/fuzz.h"
#include "fuzz/image_text.h"
#include "fuzz/state_mutator.h"

using namespace plumb;
using namespace plumb::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::vector<std::string> words = {"merge"};
    for (const std::string_view part : split_images(text_of(data, size))) {
        if (words.size() > 4) break;
        const std::string name = "part" + std::to_string(words.size()) + ".exr";
        words.push_back(write_file(name, part).string());
    }
    for (const char* output : {"merged.exr", "merged.png"})
        words.insert(words.end(), {"-o", (directory() / output).string()});
    words.insert(words.end(), {"--checkpoint", (directory() / "sum.exr").string(), "--allow-missing"});
    allow_our_errors([&] { verb_of(words).parse(words)(); });
    for (const char* output : {"merged.exr", "merged.png", "sum.exr", "sum.previous.exr"})
        std::filesystem::remove(directory() / output);
    return 0;
}
