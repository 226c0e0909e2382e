// SPDX-License-Identifier: MIT

// Materials of OBJ meshes.

#include "plumb/shapes/mtl.h"
#include "fuzz/fuzz.h"

#include <cmath>

using namespace plumb;
using namespace plumb::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto path = write_file("materials.mtl", text_of(data, size));
    allow_our_errors([&] {
        for (const MtlMaterial& m : read_mtl(path)) {
            expect(!m.name.empty(), "a material without a name");
            for (const float x : {m.diffuse.r, m.specular.g, m.transmittance.b, m.emission.r, m.exponent,
                                  m.index, m.dissolve, m.roughness, m.metallic, m.sheen, m.clearcoat})
                expect(std::isfinite(x) && x >= 0.f, "a number that is not finite or is negative");
        }
    });
    return 0;
}
