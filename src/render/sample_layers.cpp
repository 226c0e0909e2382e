// SPDX-License-Identifier: MIT

#include "render/sample_layers.h"

#include "plumb/base/error.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

ChannelSet render_layers(const RenderJob& job, const RenderOptions& options)
{
    if (!options.splits.empty() && !job.integrator->notes_light())
        throw Error(
            "--split needs an integrator that follows light from emitters, such as path_mis or whitted; "
            "choose one with --integrator");
    ChannelSet layers = layers_of(options.aovs);
    const ChannelSet shares = layers_of(options.splits, *job.scene);
    for (const Layer& share : shares) {
        if (std::ranges::find(layers, share.name, &Layer::name) != layers.end())
            throw Error(fmt::format("two layers are called '{}'", share.name));
        layers.push_back(share);
    }
    return layers;
}

SampleLayers::SampleLayers(const RenderJob& job, const RenderOptions& options)
    : aovs_(options.aovs, *job.scene, *job.camera),
      splitter_(options.splits, *job.scene, layers_of(options.aovs).size()),
      families_(options.splits.size())
{}

Tracer::Notes SampleLayers::Meter::notes()
{
    Tracer::Notes notes;
    if (layers_.aovs_.needs_surfaces()) notes.first = &first_;
    if (!layers_.splitter_.empty()) notes.light = &light_;
    return notes;
}

void SampleLayers::Meter::start(const RayCounts& counts)
{
    first_ = {};
    light_.clear();
    rays_before_ = counts.total();
}

LayerSample SampleLayers::Meter::measure(const Color& radiance, const RayCounts& counts)
{
    LayerSample sample = layers_.aovs_.measure({first_, radiance, counts.total() - rays_before_}, values_);
    sample.shares = layers_.splitter_.shares(light_, radiance, shares_);
    sample.families = layers_.families_;
    return sample;
}

} // namespace plumb
