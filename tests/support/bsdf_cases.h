// SPDX-License-Identifier: MIT
#pragma once

// Every BSDF of the catalog, in the configurations that the tests look at.

#include "plumb/bsdf.h"
#include "support/params.h"
#include "support/samples.h"
#include "support/statistics.h"

namespace plumb::test {

struct BsdfCase {
    ParamsBuilder params;
    double narrowness = 1.0;   // roughness of its narrowest lobe: cells of grids follow it
    bool gains_energy = false; // its formula reflects more than it receives
    std::shared_ptr<const Sample> sample = nullptr; // instead of params

    std::string name() const; // the type and its parameters
    std::unique_ptr<Bsdf> build() const;
};

// At least one of each type of the catalog: the samples of its doc block where none are listed.
const std::vector<BsdfCase>& bsdf_cases();

// A direction at `degrees` from the normal (above 90: behind the surface).
Vec3f direction_at(double degrees, double azimuth = 0.7);

// A grid, and which sides of the surface it looks at.
struct LobeGrid {
    SphereGrid grid;
    bool front = true;
    bool back = true;

    bool covers(const Vec3f& wo) const { return wo.z > 0.f ? front : back; }
};

// Grids whose cells are fine about the directions where a case may have a narrow lobe, seen from wi.
std::vector<LobeGrid> lobe_grids(const BsdfCase& test, const Bsdf& bsdf, const Vec3f& wi);

} // namespace plumb::test
