// SPDX-License-Identifier: MIT

#include "cameras/clip_range.h"
#include "cameras/field_of_view.h"
#include "cameras/film_window.h"
#include "model/plugin.h"
#include "plumb/model/camera.h"
#include "plumb/sampling/sampling.h"

#include <array>

namespace plumb {
/// A pinhole or thin-lens camera. Camera space: +z looks forward, +y is up, +x is left. With a lens, points at the
/// focal distance along +z are sharp.
///
///     width           integer     pixels across, from 1 to 65535   (default 1280)
///     height          integer     pixels down, from 1 to 65535   (default 720)
///     fov             float       field of view in degrees, in (0, 180)   (default 30)
///     fovAxis         string      that of fov: x, y, diagonal, or that of the smaller or larger of width and height, written
///                                 smaller or larger   (default x)
///     focalLengthMm   float       instead of fov: of a lens before a film of 36 mm x 24 mm, whose diagonal becomes that of
///                                 the image, in mm, greater than 0
///     principalPointOffsetX  float  the axis of the camera is seen this part of the width left of the middle   (default 0)
///     principalPointOffsetY  float  and this part of the height above it   (default 0)
///     toWorld         transform   camera space to world space   (default identity)
///     nearClip        float       nothing nearer along +z is seen, if given
///     farClip         float       nothing farther along +z is seen, if given
///     lensRadius      float       radius of the lens, at least 0; 0 is a pinhole   (default 0)
///     focalDistance   float       distance of sharp focus along +z, greater than 0   (default 1)
///     cropOffsetX     integer     only a part of the image is rendered: its first column   (default 0)
///     cropOffsetY     integer     its first row   (default 0)
///     cropWidth       integer     its width   (default: up to the right edge)
///     cropHeight      integer     its height   (default: down to the lower edge)
///     sampleBorder    boolean     filters reach beyond the edge of the image; else they are cut there   (default true)
///     mirrored        boolean     the image is flopped, left to right; the dialect eth sets it   (default false)
///
///         <camera type="perspective">
///             <float name="fov" value="40"/>
///             <float name="lensRadius" value="0.05"/>
///             <float name="focalDistance" value="4"/>
///             <transform name="toWorld">
///                 <lookat origin="0,1,4" target="0,1,0" up="0,1,0"/>
///             </transform>
///         </camera>
class PerspectiveCamera final : public Camera {
public:
    explicit PerspectiveCamera(const Params& params)
        : film_(params), to_world_(params.transform("toWorld")), clip_(params)
    {
        const FieldOfView view = read_field_of_view(params, film_.full);
        half_width_ = view.half_width;
        half_height_ = view.half_height;
        if (params.boolean("mirrored", false)) half_width_ = -half_width_;
        pixel_width_ = 2.0 * half_width_ / film_.full.x;
        pixel_height_ = 2.0 * half_height_ / film_.full.y;
        // A principal point is a shift of all pixels, like a crop.
        const Vec2f principal(params.number("principalPointOffsetX", 0.f, Range::closed(-1e3, 1e3)),
                              params.number("principalPointOffsetY", 0.f, Range::closed(-1e3, 1e3)));
        shift_ = film_.offset + Vec2f(principal.x * static_cast<float>(film_.full.x),
                                      principal.y * static_cast<float>(film_.full.y));
        position_ = to_world_.point(Vec3d(0.0, 0.0, 0.0));
        clips_ = clip_.near > 0.f || clip_.far < infinity;
        read_lens(params);
    }

    CameraRay sample_ray(const Vec2f& raster, const Vec2f& u_lens) const override
    {
        // The point of the plane z = 1 seen through this place of the image; row 0 is up, column 0 is left.
        const Vec2f place = raster + shift_;
        const Vec3d towards(half_width_ - place.x * pixel_width_, half_height_ - place.y * pixel_height_,
                            1.0);
        Vec3d origin(0.0, 0.0, 0.0);
        Vec3d direction = towards;
        if (lens_radius_ > 0.0) {
            const Vec2f lens = square_to_concentric_disk(u_lens);
            origin = Vec3d(lens.x * lens_radius_, lens.y * lens_radius_, 0.0);
            direction = towards * focal_distance_ - origin;
        }
        const Vec3d world = to_world_.vector(direction);
        const double scale = 1.0 / length(world);
        Ray ray{Vec3f(lens_radius_ > 0.0 ? to_world_.point(origin) : position_), Vec3f(world * scale)};
        if (clips_) {
            // One step along the unit direction is direction.z * scale along camera +z.
            ray.t_min = static_cast<float>(clip_.near / (direction.z * scale));
            ray.t_max = static_cast<float>(clip_.far / (direction.z * scale));
        }
        return {ray, Color(1.f)};
    }

    Vec2i resolution() const override { return film_.resolution; }
    const Transform& to_world() const override { return to_world_; }
    bool sample_border() const override { return film_.sample_border; }

    // Of the part beyond a plane close before the pinhole: its corners are those of the box that lie there, and where the box's
    // edges cross the plane.
    std::optional<RasterBounds> bounds_of(const Box3f& world) const override
    {
        if (lens_radius_ > 0.0) return std::nullopt;
        constexpr double nearest = 1e-3; // of the distance to the box's farthest corner
        const Transform to_camera = to_world_.inverse();
        std::array<Vec3d, 8> corners;
        double farthest = 0.0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            corners[i] = to_camera.point(Vec3d(corner(world, i)));
            farthest = std::max(farthest, length(corners[i]));
        }
        const double plane = nearest * farthest;
        RasterBounds bounds;
        const auto see = [&](const Vec3d& p) {
            bounds.add(Vec2f(static_cast<float>((half_width_ - p.x / p.z) / pixel_width_),
                             static_cast<float>((half_height_ - p.y / p.z) / pixel_height_)) -
                       shift_);
        };
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vec3d& p = corners[i];
            if (p.z >= plane) see(p);
            for (std::size_t axis = 1; axis < corners.size(); axis *= 2) {
                const Vec3d& q = corners[i ^ axis];
                if (p.z >= plane && q.z < plane) see(p + (q - p) * ((p.z - plane) / (p.z - q.z)));
            }
        }
        return bounds;
    }

private:
    // Bit k of its number: whether it is at the box's upper end along axis k.
    static Vec3f corner(const Box3f& box, std::size_t number)
    {
        return {number & 1 ? box.max.x : box.min.x, number & 2 ? box.max.y : box.min.y,
                number & 4 ? box.max.z : box.min.z};
    }

    void read_lens(const Params& params)
    {
        lens_radius_ = params.number("lensRadius", 0.f, Range::at_least(0.0));
        focal_distance_ = params.number("focalDistance", 1.f, Range::at_least(0.0));
        if (!(focal_distance_ > 0.0) && lens_radius_ > 0.0)
            params.fail("focalDistance", "must be greater than 0 where the lens has a radius");
    }

    FilmWindow film_;
    Transform to_world_;
    ClipRange clip_;
    Vec2f shift_{0.f};        // of a raster place in the window to the full image about the axis, in pixels
    double half_width_ = 1.0; // of the image in the plane z = 1; negative where the view is mirrored
    double half_height_ = 1.0;
    double pixel_width_ = 0.0; // of one pixel in that plane
    double pixel_height_ = 0.0;
    Vec3d position_{0.0, 0.0, 0.0}; // of the pinhole, in the world
    bool clips_ = false;
    double lens_radius_ = 0.0;
    double focal_distance_ = 1.0;
};

template std::unique_ptr<Camera> build<PerspectiveCamera>(const Params&);

} // namespace plumb
