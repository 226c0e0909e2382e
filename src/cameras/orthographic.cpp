// SPDX-License-Identifier: MIT

#include "cameras/clip_range.h"
#include "cameras/film_window.h"
#include "model/plugin.h"
#include "plumb/model/camera.h"

namespace plumb {

/// A camera whose rays are parallel. Camera space: +z looks forward, +y is up, +x is left. The image is `viewWidth` wide
/// around the z axis, before toWorld, whose scale counts.
///
///     width          integer     pixels across, from 1 to 65535   (default 1280)
///     height         integer     pixels down, from 1 to 65535   (default 720)
///     viewWidth      float       width of what is seen, greater than 0; its height follows from the pixels   (default 2)
///     toWorld        transform   camera space to world space   (default identity)
///     nearClip       float       nothing nearer to the camera's plane is seen, if given; in the world, whatever toWorld scales
///     farClip        float       nothing farther from it is seen, if given
///     mirrored       boolean     the image is flopped, left to right; the dialect eth sets it   (default false)
///     cropOffsetX    integer     only a part of the image is rendered: its first column   (default 0)
///     cropOffsetY    integer     its first row   (default 0)
///     cropWidth      integer     its width   (default: up to the right edge)
///     cropHeight     integer     its height   (default: down to the lower edge)
///     sampleBorder   boolean     filters reach beyond the edge of the image; else they are cut there   (default true)
///
///         <camera type="orthographic">
///             <float name="viewWidth" value="4"/>
///             <transform name="toWorld">
///                 <lookat origin="0,10,4" target="0,0,0" up="0,1,0"/>
///             </transform>
///         </camera>
class OrthographicCamera final : public Camera {
public:
    explicit OrthographicCamera(const Params& params)
        : film_(params), to_world_(params.transform("toWorld")), clip_(params)
    {
        const double width = params.number("viewWidth", 2.f, Range::positive());
        pixel_size_ = width / film_.full.x;
        half_width_ = 0.5 * width;
        half_height_ = 0.5 * pixel_size_ * film_.full.y;
        if (params.boolean("mirrored", false)) mirror_ = -1.0;
        const Vec3d forward = to_world_.vector(Vec3d(0.0, 0.0, 1.0));
        direction_ = Vec3f(normalize(forward));
    }

    CameraRay sample_ray(const Vec2f& raster, const Vec2f& /*u_lens*/) const override
    {
        // Row 0 is up, column 0 is left.
        const Vec2f place = raster + film_.offset;
        const Vec3d origin((half_width_ - place.x * pixel_size_) * mirror_,
                           half_height_ - place.y * pixel_size_, 0.0);
        return {{Vec3f(to_world_.point(origin)), direction_, clip_.near, clip_.far}, Color(1.f)};
    }

    Vec2i resolution() const override { return film_.resolution; }
    const Transform& to_world() const override { return to_world_; }
    bool sample_border() const override { return film_.sample_border; }

private:
    FilmWindow film_;
    Transform to_world_;
    ClipRange clip_;
    double pixel_size_ = 0.0;
    double half_width_ = 1.0; // of the full image
    double half_height_ = 1.0;
    double mirror_ = 1.0; // -1: the view is mirrored
    Vec3f direction_{0.f, 0.f, 1.f};
};

template std::unique_ptr<Camera> build<OrthographicCamera>(const Params&);

} // namespace plumb
