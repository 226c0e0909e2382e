// SPDX-License-Identifier: MIT

// OBJ meshes.

#include "fuzz/mesh.h"

using namespace plumb;
using namespace plumb::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto path = write_file("mesh.obj", text_of(data, size));
    allow_our_errors([&] { expect_mesh(read_obj(path)); });
    return 0;
}
