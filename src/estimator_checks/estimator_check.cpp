// SPDX-License-Identifier: MIT
#include "plumb/estimator_checks/estimator_check.h"

#include "estimator_checks/statistic.h"
#include "plumb/math/elementary.h"
#include "plumb/statistics/statistics.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::uint64_t repetition_factor = 100;

double degrees_from_normal(const Vec3f& w)
{
    const double sine = std::sqrt(static_cast<double>(w.x) * static_cast<double>(w.x) +
                                  static_cast<double>(w.y) * static_cast<double>(w.y));
    return atan2(sine, static_cast<double>(w.z)) * (180.0 / pi_d);
}

// One test of a file, and how to run it.
struct Test {
    TestResult result;
    std::function<TestRun(const RunOptions&)> run;
};

Test make_ttest(const TestFile& file, std::size_t index)
{
    Test test;
    const double reference = file.references[index];
    test.result.reference = reference;
    if (!file.emitters.empty()) {
        const TestedEmitter& emitter = file.emitters[index / file.distances.size()];
        const double distance = file.distances[index % file.distances.size()];
        test.result.name = fmt::format("{} at a distance of {}", emitter.name, distance);
        test.run = [&, reference, distance](const RunOptions& options) {
            return test_emitter_mean(file, *emitter.emitter, distance, reference, options);
        };
        return test;
    }
    if (file.bsdfs.empty()) {
        const TestedScene& scene = file.scenes[index];
        test.result.name = scene.name;
        test.run = [&, reference](const RunOptions& options) {
            return test_scene_mean(file, scene.job, reference, options);
        };
        return test;
    }
    const TestedBsdf& bsdf = file.bsdfs[index / file.angles.size()];
    const double angle = file.angles[index % file.angles.size()];
    test.result.name = fmt::format("{} at {} degrees", bsdf.name, angle);
    test.run = [&, reference, angle](const RunOptions& options) {
        return test_bsdf_mean(file, *bsdf.bsdf, angle, reference, options);
    };
    return test;
}

Test make_chi2test(const TestFile& file, std::size_t index, std::uint64_t seed)
{
    Test test;
    const TestedBsdf& bsdf = file.bsdfs[index / file.directions];
    const Vec3f wi = random_direction(file, index, seed);
    test.result.name = fmt::format("{} at {:.1f} degrees", bsdf.name, degrees_from_normal(wi));
    test.run = [&, wi](const RunOptions& options) {
        return test_bsdf_distribution(file, *bsdf.bsdf, wi, options);
    };
    return test;
}

} // namespace

double test_level(const TestFile& file)
{
    return sidak_level(file.significance_level, file.test_count());
}

std::vector<TestResult> run_tests(const TestFile& file, const TestOptions& options,
                                  const std::function<void(const TestResult&)>& each)
{
    std::vector<TestResult> results;
    for (std::size_t i = 0; i < file.test_count(); ++i) {
        Test test = file.type == TestType::ttest ? make_ttest(file, i) : make_chi2test(file, i, options.seed);
        test.result.level = test_level(file);
        RunOptions run{i, Purpose::first_run, file.sample_count, options.seed, options.threads};
        test.result.runs.push_back(test.run(run));
        if (!test.result.passed()) {
            run.purpose = Purpose::repetition;
            run.samples *= repetition_factor;
            test.result.runs.push_back(test.run(run));
        }
        if (each) each(test.result);
        results.push_back(std::move(test.result));
    }
    return results;
}

} // namespace plumb
