// SPDX-License-Identifier: MIT

#include "cameras/clip_range.h"
#include "cameras/film_window.h"
#include "model/plugin.h"
#include "plumb/math/elementary.h"
#include "plumb/model/camera.h"

#include <algorithm>
#include <cmath>

namespace plumb {

/// A fisheye lens: a circle in the middle of the image sees up to a whole sphere from one point; outside the circle the image
/// is black. Camera space: +z looks forward, +y is up, +x is left. The circle touches the nearer edges of the image.
///
/// With the angle a from the axis and its largest value A = fov / 2, the distance from the middle is a / A of the circle's radius
/// (equidistant), or sin(a / 2) / sin(A / 2) (equisolid: equal areas of the image are equal solid angles).
///
///     width          integer     pixels across, from 1 to 65535   (default 1280)
///     height         integer     pixels down, from 1 to 65535   (default 720)
///     fov            float       angle across the circle in degrees, in (0, 360]   (default 180)
///     mapping        string      equidistant or equisolid   (default equidistant)
///     toWorld        transform   camera space to world space, without a scale that bends angles   (default identity)
///     nearClip       float       nothing within this distance is seen, if given
///     farClip        float       nothing beyond it is seen, if given
///     mirrored       boolean     the image is flopped, left to right; the dialect eth sets it   (default false)
///     cropOffsetX    integer     only a part of the image is rendered: its first column   (default 0)
///     cropOffsetY    integer     its first row   (default 0)
///     cropWidth      integer     its width   (default: up to the right edge)
///     cropHeight     integer     its height   (default: down to the lower edge)
///     sampleBorder   boolean     filters reach beyond the edge of the image; else they are cut there   (default true)
///
///         <camera type="fisheye">
///             <integer name="width" value="512"/>
///             <integer name="height" value="512"/>
///             <float name="fov" value="180"/>
///             <string name="mapping" value="equisolid"/>
///             <transform name="toWorld"> <lookat origin="0,0,0" target="0,1,0" up="0,0,1"/> </transform>
///         </camera>
class FisheyeCamera final : public Camera {
public:
    explicit FisheyeCamera(const Params& params)
        : film_(params), to_world_(params.transform("toWorld")), clip_(params)
    {
        largest_angle_ = params.number("fov", 180.f, Range::positive_to(360.0)) * pi / 360.f;
        is_equisolid_ = params.choice("mapping", "equidistant", {"equidistant", "equisolid"}) == "equisolid";
        radius_ = 0.5f * static_cast<float>(std::min(film_.full.x, film_.full.y));
        origin_ = Vec3f(to_world_.point(Vec3d(0.0)));
        if (params.boolean("mirrored", false)) mirror_ = -1.f;
    }

    CameraRay sample_ray(const Vec2f& raster, const Vec2f& /*u_lens*/) const override
    {
        const Vec2f place = raster + film_.offset;
        // Row 0 is up, column 0 is left.
        const float x = (0.5f * static_cast<float>(film_.full.x) - place.x) / radius_ * mirror_;
        const float y = (0.5f * static_cast<float>(film_.full.y) - place.y) / radius_;
        const float distance = std::sqrt(x * x + y * y);
        // A ray without a length meets nothing.
        if (!(distance <= 1.f)) return {{origin_, forward(), 0.f, 0.f}, Color(0.f)};
        const float angle = angle_at(distance);
        const float across = distance > 0.f ? plumb::sin(angle) / distance : 0.f;
        const Vec3f local(x * across, y * across, plumb::cos(angle));
        return {{origin_, Vec3f(normalize(to_world_.vector(Vec3d(local)))), clip_.near, clip_.far},
                Color(1.f)};
    }

    Vec2i resolution() const override { return film_.resolution; }
    const Transform& to_world() const override { return to_world_; }
    bool sample_border() const override { return film_.sample_border; }

private:
    Vec3f forward() const { return Vec3f(normalize(to_world_.vector(Vec3d(0.0, 0.0, 1.0)))); }

    // From the axis; distance: 1 at the edge of the circle.
    float angle_at(float distance) const
    {
        if (!is_equisolid_) return distance * largest_angle_;
        // 2 asin(s), as pi - 2 acos(s)
        return pi - 2.f * plumb::acos(distance * plumb::sin(0.5f * largest_angle_));
    }

    FilmWindow film_;
    Transform to_world_;
    ClipRange clip_;
    Vec3f origin_{0.f};
    float largest_angle_ = 0.f; // radians, at the edge of the circle
    float radius_ = 1.f;        // of the circle, in pixels
    bool is_equisolid_ = false;
    float mirror_ = 1.f; // -1: the view is mirrored
};

template std::unique_ptr<Camera> build<FisheyeCamera>(const Params&);

} // namespace plumb
