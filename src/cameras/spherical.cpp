// SPDX-License-Identifier: MIT

#include "cameras/clip_range.h"
#include "cameras/film_window.h"
#include "model/plugin.h"
#include "plumb/math/elementary.h"
#include "plumb/model/camera.h"

namespace plumb {

/// A camera that sees all directions from one point: columns are longitudes, rows latitudes (an equirectangular image). Camera
/// space: +z is the middle of the image, +y its upper edge, +x a quarter of the width to the left.
///
/// Such an image is an environment: with a toWorld that turns it by -90 degrees about y, the emitter `environment` shows
/// each direction where the camera saw it.
///
///     width          integer     pixels across, from 1 to 65535   (default 1280)
///     height         integer     pixels down, from 1 to 65535; usually half the width   (default 720)
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
///         <camera type="spherical">
///             <integer name="width" value="1024"/>
///             <integer name="height" value="512"/>
///             <transform name="toWorld"> <translate value="0,1.6,0"/> </transform>
///         </camera>
class SphericalCamera final : public Camera {
public:
    explicit SphericalCamera(const Params& params)
        : film_(params), to_world_(params.transform("toWorld")), clip_(params)
    {
        origin_ = Vec3f(to_world_.point(Vec3d(0.0)));
        if (params.boolean("mirrored", false)) mirror_ = -1.f;
    }

    CameraRay sample_ray(const Vec2f& raster, const Vec2f& /*u_lens*/) const override
    {
        const Vec2f place = raster + film_.offset;
        const float longitude = (1.f - 2.f * place.x / static_cast<float>(film_.full.x)) * pi * mirror_;
        // Filters may reach beyond the poles: there the view goes on on the other side.
        const float latitude = (0.5f - place.y / static_cast<float>(film_.full.y)) * pi;
        const Vec3f local(plumb::cos(latitude) * plumb::sin(longitude), plumb::sin(latitude),
                          plumb::cos(latitude) * plumb::cos(longitude));
        const Vec3f direction(normalize(to_world_.vector(Vec3d(local))));
        return {{origin_, direction, clip_.near, clip_.far}, Color(1.f)};
    }

    Vec2i resolution() const override { return film_.resolution; }
    const Transform& to_world() const override { return to_world_; }
    bool sample_border() const override { return film_.sample_border; }

private:
    FilmWindow film_;
    Transform to_world_;
    ClipRange clip_;
    Vec3f origin_{0.f};
    float mirror_ = 1.f; // -1: the view is mirrored
};

template std::unique_ptr<Camera> build<SphericalCamera>(const Params&);

} // namespace plumb
