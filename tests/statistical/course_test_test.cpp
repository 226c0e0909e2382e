// SPDX-License-Identifier: MIT

// The tests of test files: that right ones pass, wrong ones fail, and the p-values are what they should be.

#include "build_paths.h"
#include "estimator_checks/quadrature.h"
#include "estimator_checks/statistic.h"
#include "plumb/estimator_checks/estimator_check.h"
#include "plumb/sampling/sampling.h"
#include "support/catch.h"
#include "support/statistics.h"
#include "support/temp_directory.h"

using namespace plumb;

namespace {

const std::filesystem::path directory =
    std::filesystem::path(PLUMB_SOURCE_DIR) / "tests" / "scenes" / "course";

TestFile load_text(const std::string& text)
{
    const TempDirectory files;
    return load_test(files.write("test.xml", text));
}

// Samples the upper hemisphere uniformly, for wi everywhere, and does as its fields say.
struct FakeBsdf final : Bsdf {
    float density = inv_two_pi; // what it claims
    float refused = 0.f;
    float strayed = 0.f; // share of samples below the surface
    float broken = 0.f;  // share of samples that are not a number

    Lobes lobes() const override { return Lobe::diffuse_reflection; }
    BsdfValue evaluate(const SurfacePoint&, const Vec3f&, const Vec3f& wo) const override
    {
        return wo.z > 0.f ? BsdfValue{Color(density), density} : BsdfValue{};
    }
    std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3f&, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (u_lobe < refused) return std::nullopt;
        const float sine = safe_sqrt(1.f - u.x * u.x);
        const SinCos phi = sin_cos(two_pi * u.y);
        const float z = u_lobe > 1.f - strayed ? -u.x : u.x;
        const float weight = u_lobe > 1.f - broken ? std::numeric_limits<float>::quiet_NaN() : 1.f;
        return BsdfSample{
            {sine * phi.cos, sine * phi.sin, z}, Color(weight), density, Lobe::diffuse_reflection, 1.f};
    }
};

TestFile chi2_file(const FakeBsdf& bsdf, std::uint64_t samples = 20'000)
{
    TestFile file = load_text("<test type='chi2test'><bsdf type='diffuse'/></test>");
    file.sample_count = samples;
    file.directions = 1;
    file.bsdfs.front().bsdf = std::make_unique<FakeBsdf>(bsdf);
    return file;
}

TestResult only_result(const TestFile& file, std::uint64_t seed = 0)
{
    const auto results = run_tests(file, {seed, 0});
    REQUIRE(results.size() == 1);
    return results.front();
}

} // namespace

TEST_CASE("files with right references pass", "[statistical][course_test]")
{
    const std::string name =
        GENERATE("furnace.xml", "point_light.xml", "bsdf_means.xml", "chi2.xml", "lights.xml", "axis.xml");
    CAPTURE(name);
    const TestFile file = load_test(directory / name);
    CHECK(file.warnings.size() == (name == "axis.xml" ? 2u : 0u)); // of up along the view
    const auto results = run_tests(file, {});
    CHECK(results.size() == file.test_count());
    for (const TestResult& result : results) {
        INFO(result.name << ": p = " << result.runs.back().p);
        CHECK(result.passed());
        CHECK(result.runs.front().p > 0.0);
        CHECK(result.level == Approx(test::sidak_level(file.significance_level, file.test_count())));
    }
}

TEST_CASE("a wrong reference fails, after a repetition", "[statistical][course_test]")
{
    const auto results = run_tests(load_test(directory / "wrong_reference.xml"), {});
    REQUIRE(results.size() == 2);
    CHECK(results[0].passed());
    CHECK(results[0].runs.size() == 1);
    CHECK_FALSE(results[1].passed());
    REQUIRE(results[1].runs.size() == 2);
    CHECK(results[1].runs[0].samples == 1000);
    CHECK(results[1].runs[1].samples == 100'000);
}

TEST_CASE("results depend on the seed and not on threads", "[statistical][course_test]")
{
    for (const char* name : {"furnace.xml", "chi2.xml"}) {
        const TestFile file = load_test(directory / name);
        const auto once = run_tests(file, {7, 1}), again = run_tests(file, {7, 3}),
                   other = run_tests(file, {8, 3});
        for (std::size_t i = 0; i < once.size(); ++i) {
            CHECK(once[i].runs.size() == again[i].runs.size());
            CHECK(once[i].runs[0].mean == again[i].runs[0].mean);
            CHECK(once[i].runs[0].p == again[i].runs[0].p);
            CHECK(once[i].runs[0].p != other[i].runs[0].p);
        }
    }
}

TEST_CASE("a ttest is Student's", "[statistical][course_test]")
{
    const TestFile file = load_test(directory / "furnace.xml");
    for (const TestResult& result : run_tests(file, {3, 0})) {
        const TestRun& run = result.runs.front();
        REQUIRE(run.variance > 1e-3);
        const double t = (run.mean - result.reference) / std::sqrt(run.variance / 5000);
        CHECK(run.statistic == Approx(t).epsilon(1e-12));
        CHECK(run.degrees_of_freedom == 4999);
        CHECK(run.p == Approx(test::student_t_two_sided(t, 4999)).epsilon(1e-8));
    }
    // Of values that do not differ the variance counts as 1e-5.
    const TestRun constant = only_result(load_test(directory / "point_light.xml")).runs.front();
    CHECK(constant.variance < 1e-12);
    CHECK(constant.p ==
          Approx(test::student_t_two_sided((constant.mean - 0.1591549) * 1e4, 999)).epsilon(1e-8));
}

TEST_CASE("a chi2test is Pearson's over cells of equal solid angle", "[statistical][course_test]")
{
    // Samples of a uniform density, counted once more.
    const TestFile file = chi2_file({}, 50'000);
    const TestRun run = only_result(file, 5).runs.front();
    std::vector<double> counts(100);
    Stream stream(*file.sampler, 5, 0, Purpose::first_run);
    for (std::uint64_t i = 0; i < 50'000; ++i) {
        Sampler& sampler = stream.sample(i);
        sampler.next_1d();
        const Vec2f u = sampler.next_2d(); // cos theta, phi / 2 pi
        counts[static_cast<std::size_t>(u.x * 5.f) * 20 + static_cast<std::size_t>(u.y * 20.f)] += 1.0;
    }
    double chi2 = 0.0;
    for (const double count : counts) chi2 += (count - 500.0) * (count - 500.0) / 500.0;
    CHECK(run.statistic == Approx(chi2).epsilon(0.02)); // phi is rounded to float: a few samples change cells
    CHECK(run.degrees_of_freedom == 99);
    CHECK(run.p == Approx(test::chi2_survival(run.statistic, 99)).epsilon(1e-8));
}

TEST_CASE("a chi2test notices wrong densities", "[statistical][course_test]")
{
    CHECK(only_result(chi2_file({})).passed());
    FakeBsdf bsdf;
    SECTION("too large")
    {
        bsdf.density = 1.1f * inv_two_pi;
        CHECK_FALSE(only_result(chi2_file(bsdf)).passed());
    }
    SECTION("samples that are refused and not accounted for")
    {
        bsdf.refused = 0.1f;
        CHECK_FALSE(only_result(chi2_file(bsdf)).passed());
        bsdf.density = 0.9f * inv_two_pi;
        CHECK(only_result(chi2_file(bsdf)).passed());
    }
    SECTION("samples where the density is 0")
    {
        bsdf.strayed = 0.02f;
        const TestRun run = only_result(chi2_file(bsdf)).runs.back();
        CHECK(run.p == 0.0);
        CHECK_THAT(run.problem, ContainsSubstring("samples fall into a cell where the density is 0"));
    }
    SECTION("samples that are not numbers")
    {
        bsdf.broken = 0.001f;
        const TestRun run = only_result(chi2_file(bsdf)).runs.back();
        CHECK(run.p == 0.0);
        CHECK_THAT(run.problem, ContainsSubstring("samples are not finite"));
    }
    SECTION("a density that is not a number")
    {
        bsdf.density = std::numeric_limits<float>::quiet_NaN();
        CHECK(only_result(chi2_file(bsdf)).runs.back().problem == "the density is negative or not a number");
    }
}

TEST_CASE("cells that expect few samples are pooled", "[statistical][course_test]")
{
    // 300 samples in 100 cells are 3 each, in one pool.
    const TestRun pooled = only_result(chi2_file({}, 3)).runs.front();
    CHECK(pooled.p == 0.0);
    CHECK(pooled.problem == "fewer than two cells expect enough samples; raise resolution or sampleCount");
    TestFile file = chi2_file({}, 300);
    CHECK(only_result(file).runs.front().degrees_of_freedom == 0);
    file.min_expected = 2.0;
    CHECK(only_result(file).runs.front().degrees_of_freedom == 99);
}

TEST_CASE("a sample that is not finite fails a ttest", "[statistical][course_test]")
{
    TestFile file = load_text("<test type='ttest'><string name='angles' value='0'/>"
                              "<string name='references' value='1'/><bsdf type='diffuse'/></test>");
    file.sample_count = 10'000;
    FakeBsdf bsdf;
    file.bsdfs.front().bsdf = std::make_unique<FakeBsdf>(bsdf);
    CHECK(only_result(file).passed());
    bsdf.broken = 0.01f;
    file.bsdfs.front().bsdf = std::make_unique<FakeBsdf>(bsdf);
    const TestResult result = only_result(file);
    CHECK_FALSE(result.passed());
    CHECK_THAT(result.runs.front().problem,
               ContainsSubstring("samples are not finite, the first is number "));
}

TEST_CASE("a rejection is settled by other random numbers", "[statistical][course_test]")
{
    // The mean of its weights is 1/2.
    struct Uniform final : Bsdf {
        Lobes lobes() const override { return Lobe::diffuse_reflection; }
        BsdfValue evaluate(const SurfacePoint&, const Vec3f&, const Vec3f&) const override { return {}; }
        std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3f&, float u_lobe,
                                         const Vec2f&) const override
        {
            return BsdfSample{{0.f, 0.f, 1.f}, Color(u_lobe), 1.f, Lobe::diffuse_reflection, 1.f};
        }
    };
    // At a level of one half there is every outcome: passed, rejected once, rejected twice.
    TestFile file = load_text("<test type='ttest'><float name='significanceLevel' value='0.5'/>"
                              "<integer name='sampleCount' value='200'/><string name='angles' value='30'/>"
                              "<string name='references' value='0.5'/><bsdf type='diffuse'/></test>");
    file.bsdfs.front().bsdf = std::make_unique<Uniform>();
    int passed = 0, settled = 0, failed = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const TestResult result = only_result(file, seed);
        const bool once = result.runs.size() == 1;
        passed += once;
        settled += !once && result.passed();
        failed += !result.passed();
        if (!once) CHECK(result.runs[1].mean != result.runs[0].mean);
    }
    // Chances 1/2, 1/4 and 1/4: means 100, 50 and 50, with standard deviations of 7 and 6.
    CHECK(std::abs(passed - 100) < 28);
    CHECK(std::abs(settled - 50) < 25);
    CHECK(std::abs(failed - 50) < 25);
}

TEST_CASE("quadrature over rectangles", "[unit][quadrature]")
{
    const auto peak = [](double x, double y) { return std::exp(-(x * x + y * y) / 2e-4) / (2e-4 * pi_d); };
    CHECK(integrate(peak, {-1, 1, -1, 1}, 8, 1e-9) == Approx(1.0).epsilon(1e-8));
    const auto disk = [](double x, double y) { return x * x + y * y < 1 ? 1.0 : 0.0; };
    CHECK(integrate(disk, {0, 1, 0, 1}, 8, 1e-9) == Approx(pi_d / 4).epsilon(3e-5));
    CHECK(integrate([](double x, double y) { return x + 3 * y; }, {1, 2, 0, 4}, 1, 1e-9) == Approx(30.0));
}
