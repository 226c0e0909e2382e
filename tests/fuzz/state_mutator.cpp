// SPDX-License-Identifier: MIT
#include "fuzz/state_mutator.h"

#include "fuzz/fuzz.h"
#include "fuzz/image_text.h"
#include "plumb/render/state_file.h"
#include "render/state_hash.h"

#include <algorithm>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace plumb::fuzz {
namespace {

// What read_state() makes of the file before it finds the hash wrong says which hash is right.
std::string right_hash(const TextImage& image)
{
    forget_words_read();
    try {
        read_state(write_file("hashed.exr", image_text(image)));
    } catch (const Error&) {
    } catch (const std::bad_alloc&) {
    }
    WordsRead read = words_read();
    std::erase_if(read.channels,
                  [](const std::string& name) { return name == "R" || name == "G" || name == "B"; });
    StateHash hash(state_header(image.metadata), read.channels);
    for (const std::vector<std::uint32_t>& row : read.rows) hash.add(hash_of_row(row));
    return hash.hex();
}

std::string with_right_hash(std::string_view text)
{
    TextImage image = parse_image(text);
    std::erase_if(image.metadata, [](const auto& entry) { return entry.first == state_hash_name; });
    image.metadata.emplace_back(state_hash_name, std::string("none"));
    image.metadata.back().second = right_hash(image);
    return image_text(image);
}

} // namespace

std::string with_right_hashes(std::string_view images)
{
    std::string result;
    for (const std::string_view image : split_images(images)) {
        if (!result.empty()) result += image_separator;
        result += with_right_hash(image);
    }
    return result;
}

} // namespace plumb::fuzz

// libFuzzer calls it instead of its own, which is LLVMFuzzerMutate().
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed)
{
    constexpr unsigned int one_stays_wrong_in = 16;
    const std::size_t mutated = LLVMFuzzerMutate(data, size, max_size);
    if (seed % one_stays_wrong_in == 0) return mutated;
    const std::string right = plumb::fuzz::with_right_hashes(plumb::fuzz::text_of(data, mutated));
    if (right.size() > max_size) return mutated;
    std::copy(right.begin(), right.end(), data);
    return right.size();
}
