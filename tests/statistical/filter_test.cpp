// SPDX-License-Identifier: MIT

#include "plumb/model/filter.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/statistics.h"

#include <cmath>

namespace plumb {
class GaussianFilter;
class MitchellFilter;
class TentFilter;
class BoxFilter;
} // namespace plumb

using namespace plumb;
using test::ParamsBuilder;

namespace {

struct FilterCase {
    std::string name;
    std::unique_ptr<Filter> filter;
    std::function<double(double)> profile; // written again from the definitions, in double precision
    double radius;
};

std::vector<FilterCase> filter_cases()
{
    const auto gaussian = [](double r, double s) {
        return [=](double x) {
            return std::max(0.0, std::exp(-x * x / (2 * s * s)) - std::exp(-r * r / (2 * s * s)));
        };
    };
    const auto mitchell = [](double r, double b, double c) {
        return [=](double offset) {
            const double x = 2.0 * std::abs(offset) / r;
            if (x >= 2.0) return 0.0;
            if (x >= 1.0)
                return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + 8 * b +
                        24 * c) /
                       6;
            return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) / 6;
        };
    };
    std::vector<FilterCase> cases;
    cases.push_back({"gaussian", ParamsBuilder("rfilter", "gaussian").build<GaussianFilter, Filter>(),
                     gaussian(2.0, 0.5), 2.0});
    cases.push_back({"gaussian, other parameters",
                     ParamsBuilder("rfilter", "gaussian")
                         .number("radius", 1.5)
                         .number("stddev", 0.75)
                         .build<GaussianFilter, Filter>(),
                     gaussian(1.5, 0.75), 1.5});
    cases.push_back({"mitchell", ParamsBuilder("rfilter", "mitchell").build<MitchellFilter, Filter>(),
                     mitchell(2.0, 1.0 / 3.0, 1.0 / 3.0), 2.0});
    cases.push_back({"mitchell, other parameters",
                     ParamsBuilder("rfilter", "mitchell")
                         .number("radius", 3.0)
                         .number("B", 0.0)
                         .number("C", 0.5)
                         .build<MitchellFilter, Filter>(),
                     mitchell(3.0, 0.0, 0.5), 3.0});
    cases.push_back({"tent", ParamsBuilder("rfilter", "tent").build<TentFilter, Filter>(),
                     [](double x) { return std::max(0.0, 1.0 - std::abs(x)); }, 1.0});
    cases.push_back(
        {"box", ParamsBuilder("rfilter", "box").build<BoxFilter, Filter>(), [](double) { return 1.0; }, 0.5});
    cases.push_back({"tent, other radius",
                     ParamsBuilder("rfilter", "tent").number("radius", 2.5).build<TentFilter, Filter>(),
                     [](double x) { return std::max(0.0, 1.0 - std::abs(x) / 2.5); }, 2.5});
    cases.push_back({"box, other radius",
                     ParamsBuilder("rfilter", "box").number("radius", 1.25).build<BoxFilter, Filter>(),
                     [](double) { return 1.0; }, 1.25});
    return cases;
}

double integrate_axis(const std::function<double(double)>& f, double radius)
{
    const int steps = 200000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += f((i + 0.5) / steps * radius);
    return 2.0 * sum * radius / steps;
}

} // namespace

TEST_CASE("filters have the values of their definitions", "[statistical][filter]")
{
    for (const FilterCase& c : filter_cases()) {
        INFO(c.name);
        CHECK(c.filter->radius() == Approx(c.radius));
        for (const double x : {0.0, 0.1, 0.3, 0.49, 0.7, 1.1, 1.4, 1.9, 2.6}) {
            if (x >= c.radius) continue;
            const Vec2f offset(static_cast<float>(x), -0.2f);
            CHECK(c.filter->evaluate(offset) == Approx(c.profile(x) * c.profile(0.2)).margin(1e-6));
        }
        CHECK(c.filter->evaluate({static_cast<float>(c.radius) * 1.001f, 0.f}) == Approx(0.0).margin(1e-6));
    }
}

TEST_CASE("filters sample in proportion to their absolute value", "[statistical][filter]")
{
    const std::vector<FilterCase> cases = filter_cases();
    for (const FilterCase& c : cases) {
        const double absolute = integrate_axis([&](double x) { return std::abs(c.profile(x)); }, c.radius);
        const double integral = integrate_axis(c.profile, c.radius);
        test::Grid grid{-c.radius, c.radius, -c.radius, c.radius, 24, 24};
        const bool passed = test::check_distribution(
            c.name, grid,
            [&](test::TestRandom& random) -> std::optional<Imath::V2d> {
                const FilterSample sample = c.filter->sample(random.next_2d());
                return Imath::V2d(sample.offset.x, sample.offset.y);
            },
            [&](double x, double y) { return std::abs(c.profile(x) * c.profile(y)) / sqr(absolute); }, 200000,
            test::sidak_level(test::significance, cases.size()), 5);
        CHECK(passed);

        // The weight: |f| normalised, with f's sign. A filter without negative lobes weighs exactly 1.
        test::TestRandom random(9);
        for (int i = 0; i < 1000; ++i) {
            const FilterSample sample = c.filter->sample(random.next_2d());
            const double value = c.profile(sample.offset.x) * c.profile(sample.offset.y);
            const double magnitude = sqr(absolute / integral);
            INFO(c.name << " at " << sample.offset.x << ", " << sample.offset.y);
            CHECK(std::abs(sample.weight) == Approx(magnitude).epsilon(1e-4));
            if (std::abs(value) > 1e-3) CHECK((sample.weight > 0.f) == (value > 0.0));
            if (absolute == integral) CHECK(sample.weight == 1.f);
        }
    }
}
