// SPDX-License-Identifier: MIT
#pragma once

// Images of pure noise with the channels that tell about it, for tests of comparisons.

#include "plumb/image/image.h"
#include "support/random.h"

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace plumb::test {

// Draws `count` samples of expectation 1 and gives their sum, sum of squares and how many were not 0.
struct SampleSums {
    double sum = 0.0;
    double squares = 0.0;
    double contributing = 0.0;
};
struct SampleKind {
    std::string name;
    std::function<SampleSums(int count, TestRandom& random)> draw;
};

inline double draw_normal(TestRandom& random)
{
    const double u = 1.0 - random.next_double();
    const double angle = 2.0 * pi_d * random.next_double();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(angle);
}

inline SampleKind one_by_one(const std::string& name, const std::function<double(TestRandom&)>& draw)
{
    return {name, [draw](int count, TestRandom& random) {
                SampleSums sums;
                for (int i = 0; i < count; ++i) {
                    const double x = draw(random);
                    sums.sum += x;
                    sums.squares += x * x;
                    sums.contributing += x != 0.0 ? 1.0 : 0.0;
                }
                return sums;
            }};
}

inline SampleKind normal_samples(double deviation)
{
    return one_by_one("normal " + std::to_string(deviation),
                      [deviation](TestRandom& random) { return 1.0 + deviation * draw_normal(random); });
}

inline SampleKind exponential_samples()
{
    return one_by_one("exponential",
                      [](TestRandom& random) { return -std::log(1.0 - random.next_double()); });
}

inline SampleKind lognormal_samples(double sigma)
{
    return one_by_one("lognormal " + std::to_string(sigma), [sigma](TestRandom& random) {
        return std::exp(sigma * draw_normal(random) - 0.5 * sigma * sigma);
    });
}

// 1 / chance with that chance, else 0: a path that rarely finds the light. Skips from hit to hit.
inline SampleKind hits(double chance)
{
    return {"hits " + std::to_string(chance), [chance](int count, TestRandom& random) {
                const double scale = 1.0 / std::log1p(-chance);
                const auto misses = [&] { return std::floor(std::log(1.0 - random.next_double()) * scale); };
                SampleSums sums;
                for (double i = misses(); i < count; i += 1.0 + misses()) sums.contributing += 1.0;
                sums.sum = sums.contributing / chance;
                sums.squares = sums.sum / chance;
                return sums;
            }};
}

// Ordinary light, whose samples deviate by 0.3, and this share of all light from rare bright samples. Draws the sums
// alone: the ordinary samples' sum of squares by Wilson and Hilferty's approximation of chi^2.
inline SampleKind rare_light(double share, double chance)
{
    const SampleKind bright = hits(chance);
    const std::string name = "rare light " + std::to_string(share) + ", " + bright.name;
    return {name, [share, chance, bright](int count, TestRandom& random) {
                constexpr double deviation = 0.3;
                const double n = count;
                const double mean = 1.0 - share + deviation * draw_normal(random) / std::sqrt(n);
                const double w = 2.0 / (9.0 * (n - 1.0));
                const double cube_root = 1.0 - w + draw_normal(random) * std::sqrt(w);
                const double spread = deviation * deviation * (n - 1.0) * cube_root * cube_root * cube_root;
                const double number = bright.draw(count, random).contributing;
                const double height = share / chance;
                SampleSums sums;
                sums.contributing = n;
                sums.sum = n * mean + number * height;
                sums.squares = n * mean * mean + spread + number * height * (height + 2.0 * (1.0 - share));
                return sums;
            }};
}

struct NoisyImage {
    int size = 16; // of a side
    int samples = 64;
    double bias = 1.0;     // factor of all pixels
    double contrast = 1.0; // ratio of the brightest pixel to the darkest
    bool knows_noise = true;
    std::string estimator = {};                // what the header says of the integrator
    std::vector<std::string> channels = {"Y"}; // all the same
};

inline Image noisy_image(const NoisyImage& how, const SampleKind& kind, std::uint64_t seed)
{
    std::vector<std::string> names = how.channels;
    if (how.knows_noise) {
        for (const std::string& name : how.channels) names.push_back("variance." + name);
        names.push_back("contributing");
    }
    Image image({0, 0, how.size, how.size}, how.size, how.size, names);
    image.metadata.emplace_back("plumb:samplesPerPixel", how.samples);
    if (!how.estimator.empty()) {
        image.metadata.emplace_back("plumb:integrator", how.estimator);
        image.metadata.emplace_back("plumb:inputHash", "0123");
        image.metadata.emplace_back("plumb:seed", std::to_string(seed));
    }
    TestRandom random(seed);
    const double n = how.samples;
    for (int y = 0; y < how.size; ++y) {
        for (int x = 0; x < how.size; ++x) {
            const double scale =
                how.bias * std::pow(how.contrast, ((x * 7 + y * 13) % how.size) / double(how.size));
            const SampleSums sums = kind.draw(how.samples, random);
            const double mean = sums.sum / n;
            const double variance = std::max(0.0, (sums.squares - n * mean * mean) / (n - 1.0) / n);
            float* pixel = image.pixel(x, y);
            for (std::size_t i = 0; i < how.channels.size(); ++i) *pixel++ = static_cast<float>(mean * scale);
            if (!how.knows_noise) continue;
            for (std::size_t i = 0; i < how.channels.size(); ++i)
                *pixel++ = static_cast<float>(variance * scale * scale);
            *pixel = static_cast<float>(sums.contributing);
        }
    }
    return image;
}

// What the images estimate.
inline Image true_image(const NoisyImage& how)
{
    NoisyImage exact = how;
    exact.knows_noise = false;
    exact.bias = 1.0;
    return noisy_image(exact, one_by_one("1", [](TestRandom&) { return 1.0; }), 1);
}

} // namespace plumb::test
