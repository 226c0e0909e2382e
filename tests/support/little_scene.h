// SPDX-License-Identifier: MIT
#pragma once

// Scenes of a few spheres and rectangles built through the library, and estimates of the light along rays in them.

#include "plumb/model/integrator.h"
#include "plumb/model/sampler.h"
#include "plumb/scene/tracer.h"
#include "support/params.h"
#include "support/statistics.h"

#include <functional>
#include <memory>

namespace plumb::test {

// Makes a BSDF; a room needs six of one kind.
using MakeBsdf = std::function<std::unique_ptr<Bsdf>()>;
MakeBsdf diffuse(float albedo);
MakeBsdf diffuse(const Color& albedo);
MakeBsdf mirror();
MakeBsdf glass(); // smooth, index 1.5 in 1

class LittleScene {
public:
    LittleScene& sphere(const Vec3f& center, float radius, const MakeBsdf& bsdf,
                        std::optional<Color> radiance = {});
    // Its front is where `normal` points.
    LittleScene& rectangle(const Vec3f& center, float width, float height, const Vec3f& normal,
                           const MakeBsdf& bsdf, std::optional<Color> radiance = {});
    LittleScene& add_shape(std::unique_ptr<Shape> shape, const MakeBsdf& bsdf,
                           std::optional<Color> radiance = {});
    // The only shape of a group, which `map` puts into the scene.
    LittleScene& instance(std::unique_ptr<Shape> shape, const MakeBsdf& bsdf, const Transform& map);
    // The cube [-1, 1]^3 seen from inside.
    LittleScene& room(const MakeBsdf& bsdf, std::optional<Color> radiance = {});
    LittleScene& point_light(const Vec3f& position, const Color& intensity);
    LittleScene& directional_light(const Vec3f& towards_light, const Color& radiance);
    LittleScene& environment(const Color& radiance);
    LittleScene& add_light(std::unique_ptr<Emitter> light);
    LittleScene& absorbing_emitters();

    Scene build(); // once

private:
    std::vector<SceneObject> objects_;
    std::vector<Instance> instances_;
    std::vector<std::unique_ptr<Emitter>> lights_;
    SceneOptions options_;
};

ParamsBuilder integrator_params(const std::string& type);

// A ray, from random numbers.
using ChooseRay = std::function<Ray(Sampler&)>;
ChooseRay ray_to(const Vec3f& origin, const Vec3f& target);
// Rays to the points within `spread` of target, along each axis.
ChooseRay rays_around(const Vec3f& origin, const Vec3f& target, float spread);

std::unique_ptr<Sampler> independent_sampler();

// The luminance that `samples` samples of the integrator give.
MeanAndVariance estimate(const Scene& scene, const Integrator& integrator, const ChooseRay& choose_ray,
                         std::uint64_t samples, std::uint64_t seed);

} // namespace plumb::test
