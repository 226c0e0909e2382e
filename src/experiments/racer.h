// SPDX-License-Identifier: MIT
#pragma once

// One of the estimators of a race: Plumb's, or another program.

#include "experiments/foreign_run.h"
#include "plumb/experiments/agree.h"

#include <memory>
#include <span>

namespace plumb {

struct RacerImage {
    Image image; // R, G and B
    double seconds = 0.0;
};

class Racer {
public:
    virtual ~Racer() = default;
    virtual std::string name() const = 0;
    // As of Integrator; empty where nothing is known of it.
    virtual std::string bias() const { return {}; }
    // Images with these numbers of samples per pixel, which increase, and with one seed. Throws Error if somebody stops it.
    virtual std::vector<RacerImage> render(std::uint64_t seed, std::span<const std::uint64_t> samples,
                                           const SessionCallbacks& callbacks) = 0;
    // How many rays a pixel takes, in any unit; nothing where nothing is known of it.
    virtual std::optional<Image> rays(const SessionCallbacks&) { return {}; }
};

std::unique_ptr<Racer> make_racer(RenderTask task);
// The command is run anew for each image. Its seconds are those of the whole process. size: that its images must have.
std::unique_ptr<Racer> make_racer(ForeignJob job, Vec2i size);

// Red, green and blue, or the luminance three times, by whatever names.
Image colors_of(const Image& image, Side side = Side::a);

} // namespace plumb
