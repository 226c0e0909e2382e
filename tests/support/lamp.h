// SPDX-License-Identifier: MIT
#pragma once

// Area lights for tests: one shape that shines, alone in a scene.

#include "plumb/scene/scene.h"
#include "support/params.h"
#include "support/temp_directory.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plumb {
class AreaEmitter;
class Diffuse;
class Rectangle;
class Sphere;
class ObjMesh;
} // namespace plumb

namespace plumb::test {

// One shape that shines, alone in a scene.
class Lamp {
public:
    Lamp(std::unique_ptr<Shape> shape, const std::function<void(ParamsBuilder&)>& parameters)
    {
        ParamsBuilder area("emitter", "area");
        area.parent_shape(shape.get());
        parameters(area);
        std::vector<SceneObject> objects;
        objects.push_back({std::move(shape), ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(),
                           area.build<AreaEmitter, Emitter>(), "lamp"});
        scene_ = std::make_unique<Scene>(std::move(objects), std::vector<std::unique_ptr<Emitter>>());
    }

    const Scene& scene() const { return *scene_; }
    const Emitter& emitter() const { return *scene_->emitters()[0]; }

    // What a ray sees of the lamp.
    EmitterValue look(const Vec3f& from, const Vec3f& wi, Measure measure) const
    {
        const auto hit = scene_->intersect({from, wi});
        return hit ? emitter().evaluate({from}, wi, &*hit, measure) : EmitterValue();
    }

private:
    std::unique_ptr<Scene> scene_;
};

inline Lamp white(std::unique_ptr<Shape> shape, float radiance = 2.f)
{
    return Lamp(std::move(shape), [radiance](ParamsBuilder& p) { p.color("radiance", Color(radiance)); });
}

inline std::unique_ptr<Shape> ball(const Vec3f& center, double radius)
{
    return ParamsBuilder("shape", "sphere")
        .point("center", center)
        .number("radius", radius)
        .build<Sphere, Shape>();
}

inline std::unique_ptr<Shape> panel(const Vec3f& center, double width, double height, const Vec3f& normal)
{
    return ParamsBuilder("shape", "rectangle")
        .point("center", center)
        .number("width", width)
        .number("height", height)
        .vector("normal", normal)
        .build<Rectangle, Shape>();
}

inline std::unique_ptr<Shape> mesh(const std::string& text)
{
    const TempDirectory directory;
    return ParamsBuilder("mesh", "obj")
        .string("filename", directory.write("mesh.obj", text).string())
        .build<ObjMesh, Shape>();
}

// A bent sheet above the origin that faces down: two triangles of different sizes, and one without area.
inline const std::string bent_sheet =
    "v -1 2 -1\nv 1 2 -1\nv 1 2.5 1\nv -0.5 1.5 1.5\nf 1 2 3\nf 1 1 2\nf 1 3 4\n";
// The rectangle [-1, 1] x [-0.5, 1.5] at y = 2, facing down, of four triangles of very different sizes.
inline const std::string uneven_sheet = "v -1 2 -0.5\nv 1 2 -0.5\nv 1 2 1.5\nv -1 2 1.5\nv -0.9 2 1\n"
                                        "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

// The rectangle [-1, 1] x [-1, 1] at y = 2, facing down, of two triangles.
inline const std::string even_sheet = "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\nf 1 2 3\nf 1 3 4\n";

inline void two_tone(ParamsBuilder& params)
{
    params.texture("radiance", two_tone_texture(Color(1.f), Color(5.f))).number("scale", 3);
}

} // namespace plumb::test
