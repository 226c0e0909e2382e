// SPDX-License-Identifier: MIT
#include "base/float_mode.h"
#include "base/parallel.h"
#include "estimator_checks/statistic.h"
#include "plumb/math/elementary.h"
#include "plumb/model/guide.h"
#include "plumb/scene/tracer.h"
#include "plumb/statistics/mean_and_variance.h"
#include "plumb/statistics/statistics.h"

#include <fmt/format.h>

namespace plumb {

namespace {

// The courses' test takes no variance for smaller than this: rounding errors would be significant.
constexpr double least_variance = 1e-5;

// What one thread saw of the samples of a chunk.
struct Seen {
    MeanAndVariance finite;
    std::uint64_t not_finite = 0;
    std::uint64_t first_not_finite = 0; // its number

    void add(double value, std::uint64_t number)
    {
        if (std::isfinite(value))
            finite.add(value);
        else if (not_finite++ == 0)
            first_not_finite = number;
    }

    void add(const Seen& later)
    {
        finite.add(later.finite);
        if (not_finite == 0) first_not_finite = later.first_not_finite;
        not_finite += later.not_finite;
    }
};

// The means of chunks, put together in their order. make_sampler() gives a thread a function from random numbers to
// luminance.
template <class MakeEstimator>
Seen gather(const TestFile& file, const RunOptions& options, const MakeEstimator& make_estimator)
{
    const std::vector<Chunk> chunks = cut_into_chunks(options.samples);
    std::vector<Seen> parts(chunks.size());
    parallel_for(chunks.size(), options.threads, [&](std::size_t i) {
        const FlushDenormals flush;
        Stream stream(*file.sampler, options.seed, options.test_index, options.purpose);
        auto estimate = make_estimator();
        for (std::uint64_t number = chunks[i].first; number < chunks[i].last; ++number)
            parts[i].add(static_cast<double>(estimate(stream.sample(number))), number);
    });
    Seen all;
    for (const Seen& part : parts) all.add(part);
    return all;
}

// Student's t-test.
TestRun judge(const Seen& seen, double reference, const RunOptions& options)
{
    TestRun run;
    run.samples = options.samples;
    run.mean = seen.finite.mean();
    run.variance = seen.finite.variance();
    run.degrees_of_freedom = static_cast<double>(options.samples - 1);
    run.statistic = (run.mean - reference) *
                    std::sqrt(static_cast<double>(options.samples) / std::max(run.variance, least_variance));
    if (seen.not_finite > 0)
        run.problem = fmt::format("{} samples are not finite, the first is number {}", seen.not_finite,
                                  seen.first_not_finite);
    else
        run.p = student_t_two_sided(run.statistic, run.degrees_of_freedom);
    return run;
}

} // namespace

TestRun test_bsdf_mean(const TestFile& file, const Bsdf& bsdf, double angle, double reference,
                       const RunOptions& options)
{
    const SinCosD theta = sin_cos(angle * (pi_d / 180.0));
    const Vec3f wi(static_cast<float>(theta.sin), 0.f, static_cast<float>(theta.cos));
    const Seen seen = gather(file, options, [&] {
        return [&](Sampler& sampler) {
            const float u_lobe = sampler.next_1d();
            const auto sample = bsdf.sample(SurfacePoint(), wi, u_lobe, sampler.next_2d());
            return sample ? luminance(sample->weight) : 0.f;
        };
    });
    return judge(seen, reference, options);
}

TestRun test_emitter_mean(const TestFile& file, const Emitter& emitter, double distance, double reference,
                          const RunOptions& options)
{
    const LightReceiver receiver{Vec3f(0.f, 0.f, static_cast<float>(distance)), Vec3f(0.f)};
    const Seen seen = gather(file, options, [&] {
        return [&](Sampler& sampler) {
            const double u_select = sampler.next_choice();
            const auto light = emitter.sample(receiver, u_select, sampler.next_2d(), Measure::best);
            return light ? luminance(light->radiance) / light->pdf : 0.f;
        };
    });
    return judge(seen, reference, options);
}

TestRun test_scene_mean(const TestFile& file, const RenderJob& job, double reference,
                        const RunOptions& options)
{
    const Vec2f size(job.camera->resolution());
    train(*job.integrator, *job.scene, *job.camera, options.threads);
    const Seen seen = gather(file, options, [&] {
        return [&, tracer = Tracer(*job.scene)](Sampler& sampler) mutable {
            const Vec2f u_film = sampler.next_2d();
            const Vec2f u_lens = sampler.next_2d();
            const CameraRay camera_ray =
                job.camera->sample_ray({u_film.x * size.x, u_film.y * size.y}, u_lens);
            const Color light = job.integrator->radiance(tracer, sampler, camera_ray.ray) * camera_ray.weight;
            return tracer.take_failure() ? std::numeric_limits<float>::quiet_NaN() : luminance(light);
        };
    });
    return judge(seen, reference, options);
}

} // namespace plumb
