// SPDX-License-Identifier: MIT

#include "integrators/sky_window.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumb {
namespace {

constexpr std::size_t fewest_rays = 8;
constexpr std::size_t most_rays = 512; // that are looked at: more say nothing new
// The second moment of the estimates must fall to this part of what it is without a view.
constexpr double most_left = 0.5;
// Windows are this much larger on each side than what the rays show of them, in their distances from each other.
constexpr double margin = 2.0;

// Where a coordinate is on the circle from 0 to 1, counted from another.
double from(double begin, double x)
{
    const double way = x - begin;
    return way - std::floor(way);
}

// Where the largest part of a circle without points ends.
double end_of_largest_gap(std::vector<double> points)
{
    std::sort(points.begin(), points.end());
    double largest = points.front() + 1.0 - points.back();
    double end = points.front();
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (!(points[i] - points[i - 1] > largest)) continue;
        largest = points[i] - points[i - 1];
        end = points[i];
    }
    return end;
}

// A symmetric system of three linear equations, by Cramer's rule; zero where it has no one solution.
Vec3d solved(const double (&m)[3][3], const Vec3d& right)
{
    const Vec3d a(m[0][0], m[1][0], m[2][0]);
    const Vec3d b(m[0][1], m[1][1], m[2][1]);
    const Vec3d c(m[0][2], m[1][2], m[2][2]);
    const double determinant = dot(a, cross(b, c));
    if (!(std::abs(determinant) > 0.0)) return Vec3d(0.0);
    return Vec3d(dot(right, cross(b, c)), dot(a, cross(right, c)), dot(a, cross(b, right))) / determinant;
}

class Fit {
public:
    Fit(const SkyMap& map, std::span<const SkyRay> rays) : map_(map), rays_(rays)
    {
        std::vector<double> xs;
        for (const SkyRay& ray : rays) {
            xs.push_back(static_cast<double>(ray.place.x));
            center_ += Vec3d(ray.position);
            plain_ += ray.moment;
        }
        center_ /= static_cast<double>(rays.size());
        begin_ = end_of_largest_gap(std::move(xs));
    }

    // Whether the window moves, as its rays say.
    SkyGuide::Window window(bool moves)
    {
        SkyGuide::Window window;
        window.center = Vec3f(center_);
        if (moves) find_slopes(window);
        x_.clear();
        y_.clear();
        for (const SkyRay& ray : rays_) {
            const Vec3f way = ray.position - window.center;
            x_.push_back(from(begin_, static_cast<double>(ray.place.x)) -
                         static_cast<double>(dot(window.slope_x, way)));
            y_.push_back(static_cast<double>(ray.place.y) - static_cast<double>(dot(window.slope_y, way)));
        }
        std::sort(x_.begin(), x_.end());
        std::sort(y_.begin(), y_.end());
        shrink(window);
        return window;
    }

    // Of the estimates, over that without a view.
    double second_moment(const SkyGuide::Window& window) const
    {
        double sum = 0.0;
        for (const SkyRay& ray : rays_) sum += ray.moment * cost(window, ray);
        return sum / plain_;
    }

private:
    // Linear regression of places on positions, kept small where the positions do not tell.
    void find_slopes(SkyGuide::Window& window) const
    {
        const auto n = static_cast<double>(rays_.size());
        Vec2d mean(0.0);
        for (const SkyRay& ray : rays_)
            mean += Vec2d(from(begin_, static_cast<double>(ray.place.x)), ray.place.y);
        mean /= n;
        double m[3][3] = {};
        Vec3d x(0.0);
        Vec3d y(0.0);
        for (const SkyRay& ray : rays_) {
            const Vec3d way = Vec3d(ray.position) - center_;
            for (int i = 0; i < 3; ++i)
                for (int k = 0; k < 3; ++k) m[i][k] += way[i] * way[k];
            x += way * (from(begin_, static_cast<double>(ray.place.x)) - mean.x);
            y += way * (static_cast<double>(ray.place.y) - mean.y);
        }
        const double ridge = 0.01 * (m[0][0] + m[1][1] + m[2][2]);
        for (int i = 0; i < 3; ++i) m[i][i] += ridge;
        window.slope_x = Vec3f(solved(m, x));
        window.slope_y = Vec3f(solved(m, y));
    }

    // By how much its view changes what the ray adds to the second moment.
    double cost(const SkyGuide::Window& window, const SkyRay& ray) const
    {
        const SkyView view = map_.view(window.seen_from(ray.position));
        if (view.is_whole()) return 1.0;
        const double of_view = map_.shows(view, ray.place) ? (1.0 - SkyView::everywhere) / view.share : 0.0;
        return 1.0 / (SkyView::everywhere + of_view);
    }

    // All rays count alike here: where the sun is behind the frame, some others see it, for whom it must be in the window.
    double cost(const SkyGuide::Window& window) const
    {
        double sum = 0.0;
        for (const SkyRay& ray : rays_) sum += cost(window, ray);
        return sum / static_cast<double>(rays_.size());
    }

    struct Cut {
        std::size_t left = 0, right = 0, top = 0,
                    bottom = 0; // how many of the sorted coordinates are outside
    };

    SkyRectangle view_of(const Cut& cut) const
    {
        const std::size_t n = rays_.size();
        const auto grown = [&](double low, double high) {
            const double by = margin * (high - low) / std::sqrt(static_cast<double>(n));
            return std::pair(low - by, high + by);
        };
        const auto [left, right] = grown(x_[cut.left], x_[n - 1 - cut.right]);
        const auto [top, bottom] = grown(y_[cut.top], y_[n - 1 - cut.bottom]);
        SkyRectangle view;
        view.width = std::min(static_cast<float>(right - left), 1.f);
        view.left = view.width < 1.f
                        ? std::min(static_cast<float>(from(0.0, begin_ + left)), one_minus_epsilon)
                        : 0.f;
        view.top = std::max(static_cast<float>(top), 0.f);
        view.bottom = std::min(static_cast<float>(bottom), 1.f);
        return view;
    }

    // The smallest rectangle around all rays, less what costs more than it brings.
    void shrink(SkyGuide::Window& window) const
    {
        constexpr double worth = 0.98;
        const std::size_t n = rays_.size();
        Cut best;
        window.view = view_of(best);
        double least = cost(window);
        double moment = second_moment(window);
        for (;;) {
            std::optional<Cut> next;
            for (std::size_t Cut::*side : {&Cut::left, &Cut::right, &Cut::top, &Cut::bottom}) {
                for (const std::size_t part : {std::size_t{1}, n / 50, n / 10, n / 4}) {
                    Cut cut = best;
                    cut.*side += std::max<std::size_t>(part, 1);
                    if (cut.left + cut.right + 1 >= n || cut.top + cut.bottom + 1 >= n) continue;
                    SkyGuide::Window tried = window;
                    tried.view = view_of(cut);
                    const double with_cut = cost(tried);
                    if (!(with_cut < (next ? least : worth * least)) || !(second_moment(tried) < moment))
                        continue;
                    least = with_cut;
                    next = cut;
                }
            }
            if (!next) return;
            best = *next;
            window.view = view_of(best);
            moment = second_moment(window);
        }
    }

    const SkyMap& map_;
    std::span<const SkyRay> rays_;
    Vec3d center_{0.0};
    double plain_ = 0.0;
    double begin_ = 0.0;        // of the map's x, where no ray is
    std::vector<double> x_, y_; // of the rays, as if all were seen from the center
};

} // namespace

std::optional<SkyGuide::Window> fit_window(const SkyMap& map, std::span<const SkyRay> rays)
{
    if (rays.size() < fewest_rays) return std::nullopt;
    const std::size_t step = (rays.size() + most_rays - 1) / most_rays;
    std::vector<SkyRay> some;
    for (std::size_t i = 0; i < rays.size(); i += step) some.push_back(rays[i]);
    Fit fit(map, some);
    const SkyGuide::Window still = fit.window(false);
    const SkyGuide::Window moving = fit.window(true);
    const double of_still = fit.second_moment(still);
    const double of_moving = fit.second_moment(moving);
    if (!(std::min(of_still, of_moving) < most_left)) return std::nullopt;
    return of_moving < of_still ? moving : still;
}

} // namespace plumb
