// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/text.h"

#include <fmt/format.h>

namespace plumb {

namespace {

std::string_view kind_text(PathEvent::Kind kind)
{
    switch (kind) {
    case PathEvent::Kind::ray: return "ray";
    case PathEvent::Kind::hit: return "hit";
    case PathEvent::Kind::escape: return "escape";
    case PathEvent::Kind::emission: return "emission";
    case PathEvent::Kind::direct: return "direct";
    case PathEvent::Kind::scatter: return "scatter";
    case PathEvent::Kind::roulette: return "roulette";
    case PathEvent::Kind::end: return "end";
    }
    return "";
}

} // namespace

int replay_command(const ReplayRequest& request)
{
    const Vec2i pixel = request.pixel;
    SceneRequest one_pixel = request; // no more of the image must fit into memory
    one_pixel.settings.view.crop = PixelRect{pixel.x, pixel.y, 1, 1};
    const LoadedScene scene = load_and_log(one_pixel);
    const ReplayedSample sample =
        replay(scene.job, render_options(request.settings, 0), pixel, request.sample);

    print_output(fmt::format("sample {} of pixel {},{}, seed {}, integrator {}\n", request.sample, pixel.x,
                             pixel.y, request.settings.samples.seed, scene.integrator));
    print_output(fmt::format("raster position {} {}\n\n", sample.raster.x, sample.raster.y));
    for (const PathEvent& event : sample.log)
        print_output(fmt::format("{:<9} {}\n", kind_text(event.kind), event.text));
    print_output(fmt::format("\nvalue     {}\nweight    {}\nverdict   {}\n", color_text(sample.value),
                             sample.weight, verdict_text(sample.verdict)));
    return exit_code::done;
}

} // namespace plumb
