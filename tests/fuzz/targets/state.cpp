// SPDX-License-Identifier: MIT

// Checkpoints and parts. Most inputs have the right hash (state_mutator.h), for else nothing behind it would be tried.

#include "fuzz/fuzz.h"
#include "fuzz/state_mutator.h"
#include "plumb/render/state_file.h"

using namespace plumb;
using namespace plumb::fuzz;

namespace {

std::string encoded(const StateFile& file)
{
    const std::vector<unsigned char> bytes = encode_state(file.state, file.resolution, file.header);
    return {bytes.begin(), bytes.end()};
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto path = write_file("state.exr", text_of(data, size));
    allow_our_errors([&] {
        const StateFile file = read_state(path);
        file.state.film.develop(Channels::color_and_evidence);
        // What is written is what is read.
        const std::string once = encoded(file);
        const std::string twice = encoded(read_state(write_file("again.exr", once)));
        expect(once == twice, "a state that was written and read is another one");
    });
    return 0;
}
