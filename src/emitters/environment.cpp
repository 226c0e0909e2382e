// SPDX-License-Identifier: MIT

// Importance sampling of an image of the sky follows pbrt, 4th ed., section 12.5.2, but for the shape of the cells:
// here a cell's density is constant per unit solid angle, and its weight is the exact mean of what lookups in it give
// (sky_texels.h).

#include "emitters/sky_cells.h"
#include "emitters/sky_texels.h"
#include "model/plugin.h"
#include "plumb/model/emitter.h"
#include "plumb/sampling/sampling.h"
#include "textures/bitmap.h"

#include <memory>
#include <vector>

namespace plumb {

/// Light from infinitely far away, all around: an image of the surroundings, or one colour.
///
/// The y axis points up. With phi = atan2(z, x) in [0, 2 pi) and theta = acos(y), a direction sees column
/// phi / (2 pi) width and row theta / pi height of the image, whose first row is around +y; pixels are squares with
/// their value in the middle, interpolated bilinearly; columns repeat, and beyond the first and last row, at the poles,
/// those rows repeat. If `flipped`, both run the other way: column (1 - phi / (2 pi)) width and row
/// (1 - theta / pi) height, values in the pixels' upper left corners, and rows repeat. The parameter `rotate` is
/// accepted and ignored, as in the course.
///
/// Directions are chosen in proportion to the luminance that they show.
///
///     filename       string      the image: EXR, HDR, PNG, JPEG, BMP, TGA; with OpenImageIO any that it reads   (default: none, one colour)
///     radiance       color       multiplies the image; without one, the radiance, in W / (m^2 sr)   (default 1)
///     scale          float       multiplies radiance, at least 0   (default 1)
///     toWorld        transform   turns or mirrors the image about the scene: it maps the directions above to those of the
///                                world   (default: the identity)
///     columnOffset   float       in turns: column (phi / (2 pi) + columnOffset) width. 0.25 puts +z into the middle and the
///                                seam at -z, as Mitsuba does   (default 0)
///     rowsAtPoles    boolean     row theta / pi (height - 1): the first and the last row are the poles, as Mitsuba has
///                                it   (default false)
///     zUp            boolean     +z stands for +y and y for z in all of the above, before toWorld: phi = atan2(y, x) and
///                                theta = acos(z), as in most forks of Nori   (default false)
///     imageScale   float     multiplies the image alone; the dialect zaragoza and --envmap-scale set it   (default 1)
///     flipped      boolean   see above; the dialect zaragoza sets it   (default false)
///
/// For example:
///
///         <emitter type="environment">
///             <string name="filename" value="textures/dusk.hdr"/>
///             <color name="radiance" value="2 2 2"/>
///         </emitter>
class EnvironmentEmitter final : public Emitter, public SkyMap {
public:
    explicit EnvironmentEmitter(const Params& p)
        : flipped_(p.boolean("flipped", false)),
          rows_at_poles_(p.boolean("rowsAtPoles", false)),
          constant_(p.color("radiance", Color(1.f)) * p.number("scale", 1.f, Range::at_least(0.0)))
    {
        if (flipped_ && rows_at_poles_) p.fail("rowsAtPoles", "cannot be true together with flipped");
        const double offset = p.number("columnOffset", 0.f);
        column_offset_ = offset - std::floor(offset);
        to_world_ = p.transform("toWorld");
        if (p.boolean("zUp", false)) to_world_ = to_world_ * y_and_z_exchanged();
        is_turned_ = !to_world_.is_identity();
        to_image_ = to_world_.inverse();
        if (!to_world_.uniform_scale())
            p.fail("toWorld",
                   "stretches the directions of the environment unevenly; it may turn and mirror them");
        const float image_scale = p.number("imageScale", 1.f);
        p.ignore(
            "rotate",
            "'rotate' of an environment is ignored, as in the course's renderer: the image is not rotated");
        if (!p.has("filename")) {
            integral_ = 2.0 * two_pi_ * luminance(constant_);
            tabulate_constant();
            return;
        }
        bitmap_ = std::make_unique<Bitmap>(p.file("filename"), true, constant_ * image_scale);
        if (bitmap_->min_value() < 0.f) {
            p.warn("filename", "the image has negative values, which are clamped to 0");
            bitmap_->clamp_negative();
        }
        tabulate();
    }

    void prepare(const SceneSphere& sphere) override { radius_ = sphere.radius > 0.f ? sphere.radius : 1.f; }

    std::optional<EmitterSample> sample(const LightReceiver& receiver, double u_select, const Vec2f& u,
                                        Measure) const override
    {
        EmitterSample light;
        light.distance = infinity;
        if (!bitmap_ && receiver.sky.is_whole()) {
            light.wi = square_to_uniform_sphere(u);
            light.radiance = constant_;
            light.pdf = constant_.is_black() ? 0.f : uniform_sphere_pdf();
        } else if (cells_.can_sample()) {
            const SkyCells::Choice choice = choose(receiver.sky, u_select, u);
            const Direction direction = direction_of(choice);
            light.wi = direction.world;
            if (!receiver.counts_light_from(light.wi)) return std::nullopt;
            const EmitterValue value =
                value_at(receiver.sky, direction.coordinates, {choice.column, choice.row});
            light.radiance = value.radiance;
            light.pdf = value.pdf;
        }
        if (!(light.pdf > 0.f) || !receiver.counts_light_from(light.wi)) return std::nullopt;
        return light;
    }

    EmitterValue evaluate(const LightReceiver& receiver, const Vec3f& wi, const SurfacePoint* at,
                          Measure) const override
    {
        if (at) return {};
        if (!bitmap_ && receiver.sky.is_whole())
            return {constant_, constant_.is_black() ? 0.f : uniform_sphere_pdf()};
        const Vec2f coordinates = cell_coordinates(wi);
        return value_at(receiver.sky, coordinates, cell_at(coordinates));
    }

    float power() const override { return static_cast<float>(integral_ * pi_d) * radius_ * radius_; }

    bool is_infinite() const override { return true; }
    const SkyMap* sky_map() const override { return cells_.can_sample() ? this : nullptr; }

    Vec2f place_of(const Vec3f& wi) const override
    {
        const Vec2f cell = cell_coordinates(wi);
        return {cell.x / static_cast<float>(cells_.columns()), cell.y / static_cast<float>(cells_.rows())};
    }
    SkyView view(const SkyRectangle& rectangle) const override { return cells_.view(rectangle); }
    bool shows(const SkyView& view, const Vec2f& place) const override
    {
        const Cell cell = cell_at(
            {place.x * static_cast<float>(cells_.columns()), place.y * static_cast<float>(cells_.rows())});
        return cells_.shows(view, cell.column, cell.row);
    }
    std::uint64_t memory_bytes() const override { return bitmap_ ? bitmap_->memory_bytes() : 0; }

private:
    static constexpr double two_pi_ = 2.0 * pi_d;

    static Transform y_and_z_exchanged()
    {
        return *Transform::from_rows({{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}});
    }

    // Directions in units of cells: x from 0 to width with phi, y from 0 to height with theta.
    Vec2f cell_coordinates(const Vec3f& wi) const
    {
        const Vec3f d = is_turned_ ? to_image_.vector(wi) : wi;
        const float phi = atan2(d.z, d.x);
        const float theta = atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y); // acos(d.y) is inexact at the poles
        float turns = phi < 0.f ? 1.f + phi * inv_two_pi : phi * inv_two_pi;
        if (column_offset_ > 0.0) {
            turns += static_cast<float>(column_offset_);
            if (turns >= 1.f) turns -= 1.f;
        }
        return {turns * static_cast<float>(cells_.columns()),
                theta * inv_pi * static_cast<float>(cells_.rows())};
    }

    // Where the bitmap has the value for a direction.
    Vec2f texel_coordinates(const Vec2f& cell) const
    {
        if (rows_at_poles_) return {cell.x - 0.5f, cell.y};
        if (!flipped_) return cell - Vec2f(0.5f);
        return Vec2f(static_cast<float>(bitmap_->width()), static_cast<float>(bitmap_->height())) - cell;
    }

    struct Cell {
        std::size_t column;
        std::size_t row;
    };
    Cell cell_at(const Vec2f& coordinates) const
    {
        return {std::min(static_cast<std::size_t>(coordinates.x), cells_.columns() - 1),
                std::min(static_cast<std::size_t>(coordinates.y), cells_.rows() - 1)};
    }

    EmitterValue value_at(const SkyView& sky, const Vec2f& coordinates, const Cell& cell) const
    {
        const float density = cells_.can_sample() ? pdf(sky, cell) : 0.f;
        if (!bitmap_) return {constant_, density};
        const Vec2f texel = texel_coordinates(coordinates);
        const Bitmap::Rows rows = flipped_ ? Bitmap::Rows::repeat : Bitmap::Rows::clamp;
        return {bitmap_->bilinear(texel.x, texel.y, rows), density};
    }

    float pdf(const SkyView& sky, const Cell& cell) const
    {
        const float density =
            cells_.probability(cell.column, cell.row) / static_cast<float>(solid_angle(cell.row));
        if (sky.is_whole()) return density;
        const double of_view =
            cells_.shows(sky, cell.column, cell.row) ? (1.0 - SkyView::everywhere) / sky.share : 0.0;
        return density * static_cast<float>(SkyView::everywhere + of_view);
    }

    // Samples that are spread evenly over the square are spread evenly over the image's light: u.y chooses the row,
    // u.x the column. u_select gives each of them the digits that a float has not.
    SkyCells::Choice choose(const SkyView& sky, double u_select, const Vec2f& u) const
    {
        const double digits = u_select * 0x1p27;
        const double first_digits = std::floor(digits);
        const double down = u.y + first_digits * 0x1p-51;
        const double across = u.x + (digits - first_digits) * 0x1p-24;
        if (sky.is_whole()) return cells_.sample(across, down);
        if (down < SkyView::everywhere) return cells_.sample(across, down / SkyView::everywhere);
        return cells_.sample(sky, across, (down - SkyView::everywhere) / (1.0 - SkyView::everywhere));
    }

    // A point of a cell, uniform in phi and cos(theta).
    struct Direction {
        Vec3f world;
        Vec2f coordinates;
    };
    Direction direction_of(const SkyCells::Choice& choice) const
    {
        const double across = choice.column + choice.across;
        const double phi =
            two_pi_ * across / static_cast<double>(cells_.columns()) - two_pi_ * column_offset_;
        const double cos_theta =
            cos_theta_[choice.row] - choice.down * (cos_theta_[choice.row] - cos_theta_[choice.row + 1]);
        const double sin_theta = std::sqrt(std::max(0.0, (1.0 - cos_theta) * (1.0 + cos_theta)));
        const SinCosD angle = sin_cos(phi);
        const Vec3d d(sin_theta * angle.cos, cos_theta, sin_theta * angle.sin);
        const float theta = atan2(static_cast<float>(sin_theta), static_cast<float>(cos_theta));
        return {Vec3f(is_turned_ ? normalize(to_world_.vector(d)) : d),
                {static_cast<float>(across), theta * inv_pi * static_cast<float>(cells_.rows())}};
    }

    double solid_angle(std::size_t row) const
    {
        return two_pi_ / static_cast<double>(cells_.columns()) * (cos_theta_[row] - cos_theta_[row + 1]);
    }

    void tabulate()
    {
        const SkyTexels texels(*bitmap_, flipped_, rows_at_poles_);
        divide_rows(texels.rows());
        for (int row = 0; row < texels.rows(); ++row) {
            const auto j = static_cast<std::size_t>(row);
            cells_.add_row(texels.row(row), two_pi_ / bitmap_->width() * (cos_theta_[j] - cos_theta_[j + 1]));
        }
        cells_.complete();
        integral_ = cells_.sum();
    }

    // Cells of one colour, for those who look through openings.
    void tabulate_constant()
    {
        constexpr int height = 64;
        divide_rows(height);
        const std::vector<double> cells(2 * height, luminance(constant_));
        for (std::size_t j = 0; j < height; ++j)
            cells_.add_row(cells, pi_d / height * (cos_theta_[j] - cos_theta_[j + 1]));
        cells_.complete();
    }

    void divide_rows(int height)
    {
        for (int j = 0; j <= height; ++j) cos_theta_.push_back(sin_cos(pi_d * j / height).cos);
    }

    bool flipped_;
    bool rows_at_poles_;
    double column_offset_ = 0.0; // in turns, from 0 to 1
    Transform to_world_;         // of directions
    Transform to_image_;
    bool is_turned_ = false;
    Color constant_;
    std::unique_ptr<Bitmap> bitmap_; // null: constant_ everywhere
    std::vector<double> cos_theta_;  // at the borders of the rows of cells
    SkyCells cells_;
    double integral_ = 0.0; // of the luminance over the sphere
    float radius_ = 1.f;
};

template std::unique_ptr<Emitter> build<EnvironmentEmitter>(const Params&);

} // namespace plumb
