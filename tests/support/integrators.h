// SPDX-License-Identifier: MIT
#pragma once

// Integrators made in tests.

#include "plumb/model/camera.h"
#include "support/little_scene.h"

#include <string>
#include <vector>

namespace plumb::test {

// The integrator of that type name, ready for the scene. Throws what prepare() throws.
std::unique_ptr<Integrator> make_integrator(const ParamsBuilder& params, const Scene& scene);
// It has learnt with this camera, which sees all around from the middle of the scene.
std::unique_ptr<Camera> camera_within(const Scene& scene);
// What its constructor complains of ("error: ...", "warning: ...").
std::vector<std::string> integrator_complaints(const ParamsBuilder& params);

// An integrator with its parameters, and a name for messages.
struct NamedParams {
    std::string name;
    ParamsBuilder params;
};

// Every way to compute all light up to that many bounces (-1: any number), except that techniques which choose
// points by area are left out where `with_area` is false: between walls that touch their variance is infinite, and
// no t test holds.
std::vector<NamedParams> path_tracers(int max_depth, bool with_area = true);
// Every way to compute emission and direct light of lights that can be sampled by solid angle.
std::vector<NamedParams> direct_light_integrators();

// The configurable path tracer.
ParamsBuilder configured_path(bool is_explicit, const std::string& termination, double termination_param);

} // namespace plumb::test
