// SPDX-License-Identifier: MIT
#pragma once

// What each sample of a rendering has for the film's layers: AOVs, then parts of the light.

#include "plumb/render/aovs.h"
#include "plumb/render/render.h"
#include "plumb/scene/tracer.h"

namespace plumb {

class SampleLayers {
public:
    // Job and options must outlive it.
    SampleLayers(const RenderJob& job, const RenderOptions& options);
    bool empty() const { return aovs_.empty() && splitter_.empty(); }

    // One thread's; must not move once its notes are in use.
    class Meter {
    public:
        explicit Meter(const SampleLayers& layers) : layers_(layers) {}
        Tracer::Notes notes(); // for the tracer
        void start(const RayCounts& counts);
        // What it returns is valid until the next start().
        LayerSample measure(const Color& radiance, const RayCounts& counts);

    private:
        const SampleLayers& layers_;
        FirstSurfaces first_;
        LightNotes light_;
        AovMeter::Values values_;
        std::vector<LightShare> shares_;
        std::uint64_t rays_before_ = 0;
    };

private:
    AovMeter aovs_;
    LightSplitter splitter_;
    std::size_t families_;
};

} // namespace plumb
