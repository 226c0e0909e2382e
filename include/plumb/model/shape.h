// SPDX-License-Identifier: MIT
#pragma once

// The interface of shapes.

#include "plumb/math/color.h"
#include "plumb/math/direction_cone.h"
#include "plumb/math/ray.h"
#include "plumb/model/light_receiver.h"
#include "plumb/model/surface.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// What the file of a mesh says about the materials of its faces.
struct FaceMaterials {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::string> names; // that faces use, in the order of the file
    std::vector<std::uint32_t>
        of_primitive; // an index into names, or none; empty: all are 0, or none without names
    std::vector<std::string> libraries;   // where the materials are described, as the file says it
    std::filesystem::path directory = {}; // that libraries are relative to
};

// Primitives that Embree does not know: it asks for their bounds once, and for intersections as it traces.
class Primitives {
public:
    virtual ~Primitives() = default;
    virtual std::size_t count() const = 0;
    // World space. Whatever rounding error is in it, the caller enlarges it by one float on each side.
    virtual Box3f bounds(std::uint32_t primitive) const = 0;
    // The smallest t with t_min < t < t_max at which the ray meets the primitive. Called by all threads.
    virtual std::optional<double> intersect(const Ray& ray, std::uint32_t primitive) const = 0;
};

// Receives what a shape is made of; implemented over Embree, which shapes never see. The spans must live as long
// as the shape, and so must primitives: they are not copied. Embree reads 16 bytes at a position, so that 4 bytes after the last one must be
// readable, too.
class AccelBuilder {
public:
    using Triangle = std::array<std::uint32_t, 3>;
    virtual ~AccelBuilder() = default;
    virtual void add_triangles(std::span<const Vec3f> positions, std::span<const Triangle> triangles) = 0;
    virtual void add_user(const Primitives& primitives) = 0;
};

// A point chosen on a shape. pdf is per unit area or per unit solid angle, as the function says.
struct alignas(16) ShapeSample {
    Vec3f position;
    float clearance; // as in SurfacePoint
    Vec3f normal;    // geometric, unit length, front side
    float pdf;
    Vec2f uv;
};

struct Ball {
    Vec3f center;
    float radius = 0.f;
};

// Conventions. World space: toWorld is applied when a shape is built. Of a shape in a group, world space is the space of the
// group, which each instance maps to the scene's (instance_map.h). The front side is the one that normals point
// to. u_select in [0, 1) has 53 random bits and chooses among parts; u places the point inside the part.
class Shape {
public:
    virtual ~Shape() = default;

    virtual void add_to(AccelBuilder& builder) const = 0;

    // The point where `ray`, which meets `primitive` according to Embree, meets it according to our own arithmetic.
    // Leaves bsdf and emitter null.
    virtual SurfacePoint surface_at(const RayD& ray, std::uint32_t primitive) const = 0;

    // The derivatives by uv at a point that surface_at returned. Where uv have none (at a pole of a sphere, or where the
    // uv of a triangle lie on a line): two directions in the surface. Parallel only on triangles without area.
    virtual Tangents tangents(const SurfacePoint& at) const = 0;

    // Must be called before sample_area; shapes whose surface is never sampled keep no table for it.
    virtual void prepare_sampling() {}
    // Uniform over the area; pdf = 1 / area().
    virtual ShapeSample sample_area(double u_select, const Vec2f& u) const = 0;

    // Uniform over the solid angle that the shape subtends at `from`; nothing where the shape cannot do that from
    // there, or where sample_area is as good (inside a sphere, behind a rectangle or far from it; of meshes, only those
    // that are rectangles can). pdf per unit solid angle.
    virtual std::optional<ShapeSample> sample_solid_angle(const Vec3f& from, const Vec2f& u) const;
    // The density of sample_solid_angle(from), constant over the visible part; nothing where that returns nothing.
    virtual std::optional<float> solid_angle_pdf(const Vec3f& from) const;
    // Whether sample_solid_angle ever returns something.
    virtual bool has_solid_angle() const { return false; }

    // Of parts that send the receiver different light those that send it more, more often; pdf per unit area. Nothing where
    // the parts that u_select leads to send it none. Only shapes that have parts can do that, after prepare_sampling.
    virtual std::optional<ShapeSample> sample_for(const LightReceiver& receiver, double u_select,
                                                  const Vec2f& u) const;
    // The density of sample_for() at the points of a primitive.
    virtual double pdf_for(const LightReceiver& receiver, std::uint32_t primitive) const;
    virtual bool has_parts() const { return false; }

    virtual float area() const = 0;
    virtual Box3f bounds() const = 0;
    // Of one primitive, or of more than that.
    virtual Box3f primitive_bounds(std::uint32_t /*primitive*/) const { return bounds(); }
    virtual DirectionCone normals() const = 0;                           // holds all geometric normals
    virtual std::optional<Ball> as_ball() const { return std::nullopt; } // if its surface is that of a ball
    virtual std::uint64_t triangle_count() const { return 0; }
    virtual std::uint64_t memory_bytes() const { return 0; } // of its mesh, if it has one

    // Gives away what a mesh file says about materials.
    virtual FaceMaterials take_face_materials() { return {}; }

    // Values that a mesh file gives its vertices or faces under a name, "vertex_color" say, as they are at a point that
    // surface_at returned; nothing if there is no such attribute. One channel is a grey.
    virtual std::vector<std::string> attribute_names() const { return {}; }
    virtual std::optional<Color> attribute(std::string_view /*name*/, const SurfacePoint& /*at*/) const
    {
        return std::nullopt;
    }
};

// The derivatives by uv in the scene's world space, at a point that Scene returned: also inside an instance.
Tangents tangents_at(const SurfacePoint& at);

} // namespace plumb
