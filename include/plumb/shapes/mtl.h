// SPDX-License-Identifier: MIT
#pragma once

// Materials as MTL files describe them. src/shapes/obj/mtl.cpp is tinyobjloader's only user.

#include "plumb/math/color.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

// An image, as the file names it, and how it lies: u' = scale u + offset.
struct MtlMap {
    std::string file; // empty: none
    Vec3f scale = Vec3f(1.f);
    Vec3f offset = Vec3f(0.f);
    float bump = 1.f;
};

// Numbers are finite; colours, exponents, indices and the fractions are at least 0. What the file leaves out has the value
// that tinyobjloader gives it: 0, but 1 for dissolve, index and exponent.
struct MtlMaterial {
    std::string name;
    Color diffuse;                   // Kd
    Color specular;                  // Ks
    Color transmittance;             // Tf
    Color emission;                  // Ke
    float exponent = 0.f;            // Ns
    float index = 1.f;               // Ni
    float dissolve = 1.f;            // d, or 1 - Tr
    int illumination = 0;            // illum
    float roughness = 0.f;           // Pr
    float metallic = 0.f;            // Pm
    float sheen = 0.f;               // Ps
    float clearcoat = 0.f;           // Pc
    float clearcoat_roughness = 0.f; // Pcr
    float anisotropy = 0.f;          // aniso
    MtlMap diffuse_map, dissolve_map, bump_map, normal_map, roughness_map, metallic_map;
};

// The materials of a file, in its order; of several with one name the first counts. Throws Error if the file cannot be
// read, or is larger than 64 MB.
std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path);

} // namespace plumb
