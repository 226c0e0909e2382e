// SPDX-License-Identifier: MIT
#pragma once

// How two images are compared: compare.h.

#include "plumb/settings/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace plumb {

enum class Side { a, b };
enum class VarianceOf { sample, mean };
enum class FlipMode { none, ldr, hdr };

// The image fails if the metric is above the limit. Metrics: mse, rmse, relmse, mae, max, flip; psnr is a lower
// limit.
struct Threshold {
    std::string metric;
    double limit = 0.0;
    friend bool operator==(const Threshold&, const Threshold&) = default;
};

struct CompareSettings {
    std::string layer = {};         // compare the channels LAYER.*, at most three; empty: R, G and B, or Y
    double significance = 0.01;     // the chance to say "differs" of two images with the same expectation
    bool verdict = true;            // look at the noise at all
    std::optional<Side> exact = {}; // this image has no noise
    std::optional<VarianceOf> variance_of =
        {};                             // what others' variance channels are of; absent: by their names
    std::optional<double> samples = {}; // per pixel, of images whose headers do not say
    bool alignment = true;     // try whether a change makes an image that differs agree; no setting of a user
    double fail_percent = 0.0; // of the pixels may differ, or stay undecided
    double rounding = 1e-5;    // relative difference of means that floats may make; no setting of a user
    std::optional<FlipMode> flip = {}; // absent: hdr; for two files made for screens ldr; of a layer none
    std::vector<Threshold> thresholds = {};
    friend bool operator==(const CompareSettings&, const CompareSettings&) = default;
};

template <>
std::span<const SettingRow<CompareSettings>> setting_rows<CompareSettings>();

} // namespace plumb
