// SPDX-License-Identifier: MIT

#include "support/little_scene.h"

#include "plumb/model/emitter.h"
#include "plumb/model/shape.h"

namespace plumb {
class AreaEmitter;
class Dielectric;
class Diffuse;
class DirectionalEmitter;
class EnvironmentEmitter;
class IndependentSampler;
class Mirror;
class PointEmitter;
class Rectangle;
class Sphere;
} // namespace plumb

namespace plumb::test {

MakeBsdf diffuse(float albedo)
{
    return diffuse(Color(albedo));
}

MakeBsdf diffuse(const Color& albedo)
{
    return [=] { return ParamsBuilder("bsdf", "diffuse").color("albedo", albedo).build<Diffuse, Bsdf>(); };
}

MakeBsdf mirror()
{
    return [] { return ParamsBuilder("bsdf", "mirror").build<Mirror, Bsdf>(); };
}

MakeBsdf glass()
{
    return [] {
        return ParamsBuilder("bsdf", "dielectric")
            .number("intIOR", 1.5)
            .number("extIOR", 1.0)
            .build<Dielectric, Bsdf>();
    };
}

LittleScene& LittleScene::add_shape(std::unique_ptr<Shape> shape, const MakeBsdf& bsdf,
                                    std::optional<Color> radiance)
{
    SceneObject object;
    object.name = "object " + std::to_string(objects_.size());
    object.bsdf = bsdf();
    if (radiance)
        object.emitter = ParamsBuilder("emitter", "area")
                             .color("radiance", *radiance)
                             .parent_shape(shape.get())
                             .build<AreaEmitter, Emitter>();
    object.shape = std::move(shape);
    objects_.push_back(std::move(object));
    return *this;
}

LittleScene& LittleScene::instance(std::unique_ptr<Shape> shape, const MakeBsdf& bsdf, const Transform& map)
{
    const std::string name = "instance " + std::to_string(instances_.size());
    std::vector<SceneObject> objects;
    objects.push_back({std::move(shape), bsdf(), nullptr, "object of " + name});
    instances_.push_back({InstanceMap::from(map).value(),
                          std::make_shared<const Group>(std::move(objects), "group of " + name), name});
    return *this;
}

LittleScene& LittleScene::sphere(const Vec3f& center, float radius, const MakeBsdf& bsdf,
                                 std::optional<Color> radiance)
{
    return add_shape(ParamsBuilder("mesh", "sphere")
                         .point("center", center)
                         .number("radius", radius)
                         .build<Sphere, Shape>(),
                     bsdf, radiance);
}

LittleScene& LittleScene::rectangle(const Vec3f& center, float width, float height, const Vec3f& normal,
                                    const MakeBsdf& bsdf, std::optional<Color> radiance)
{
    return add_shape(ParamsBuilder("mesh", "rectangle")
                         .point("center", center)
                         .number("width", width)
                         .number("height", height)
                         .vector("normal", normal)
                         .build<Rectangle, Shape>(),
                     bsdf, radiance);
}

LittleScene& LittleScene::room(const MakeBsdf& bsdf, std::optional<Color> radiance)
{
    for (const Vec3f& n :
         {Vec3f(1, 0, 0), Vec3f(-1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, -1, 0), Vec3f(0, 0, 1), Vec3f(0, 0, -1)})
        rectangle(-n, 2.f, 2.f, n, bsdf, radiance);
    return *this;
}

LittleScene& LittleScene::point_light(const Vec3f& position, const Color& intensity)
{
    lights_.push_back(ParamsBuilder("emitter", "point")
                          .point("position", position)
                          .color("radiance", intensity)
                          .build<PointEmitter, Emitter>());
    return *this;
}

LittleScene& LittleScene::directional_light(const Vec3f& towards_light, const Color& radiance)
{
    lights_.push_back(ParamsBuilder("emitter", "directional")
                          .vector("direction", -towards_light)
                          .color("radiance", radiance)
                          .build<DirectionalEmitter, Emitter>());
    return *this;
}

LittleScene& LittleScene::environment(const Color& radiance)
{
    return add_light(ParamsBuilder("emitter", "environment")
                         .color("radiance", radiance)
                         .build<EnvironmentEmitter, Emitter>());
}

LittleScene& LittleScene::add_light(std::unique_ptr<Emitter> light)
{
    lights_.push_back(std::move(light));
    return *this;
}

LittleScene& LittleScene::absorbing_emitters()
{
    options_.emitters_absorb = true;
    return *this;
}

Scene LittleScene::build()
{
    return Scene(std::move(objects_), std::move(lights_), options_, std::move(instances_));
}

ParamsBuilder integrator_params(const std::string& type)
{
    return ParamsBuilder("integrator", type);
}

ChooseRay ray_to(const Vec3f& origin, const Vec3f& target)
{
    return [=](Sampler&) { return Ray{origin, normalize(target - origin)}; };
}

ChooseRay rays_around(const Vec3f& origin, const Vec3f& target, float spread)
{
    return [=](Sampler& sampler) {
        const Vec2f u = sampler.next_2d();
        const float w = sampler.next_1d();
        const Vec3f offset(2.f * u.x - 1.f, 2.f * u.y - 1.f, 2.f * w - 1.f);
        return Ray{origin, normalize(target + offset * spread - origin)};
    };
}

std::unique_ptr<Sampler> independent_sampler()
{
    return ParamsBuilder("sampler", "independent").build<IndependentSampler, Sampler>();
}

MeanAndVariance estimate(const Scene& scene, const Integrator& integrator, const ChooseRay& choose_ray,
                         std::uint64_t samples, std::uint64_t seed)
{
    MeanAndVariance result;
    Tracer tracer(scene);
    const auto sampler = independent_sampler();
    for (std::uint64_t i = 0; i < samples; ++i) {
        sampler->start(seed, {0, 0}, i);
        const Ray ray = choose_ray(*sampler);
        result.add(luminance(integrator.radiance(tracer, *sampler, ray)));
    }
    return result;
}

} // namespace plumb::test
