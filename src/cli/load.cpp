// SPDX-License-Identifier: MIT
#include "base/named_file.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/text.h"
#include "cli/verbs.h"

#include <fmt/format.h>

namespace plumb {

namespace {

std::string point_text(const Vec3f& p)
{
    return fmt::format("({}, {}, {})", p.x, p.y, p.z);
}

void log_facts(const SceneRequest& request, const LoadedScene& loaded)
{
    const Scene& scene = *loaded.job.scene;
    const Vec2i resolution = loaded.job.camera->resolution();
    const Box3f bounds = scene.bounds();
    const std::string instances =
        scene.instances().empty() ? std::string() : fmt::format(", instances {}", scene.instances().size());
    print_log(fmt::format("scene: objects {}, triangles {}, emitters {}{}", scene.objects().size(),
                          scene.triangle_count(), scene.emitters().size(), instances));
    if (!bounds.isEmpty())
        print_log(fmt::format("bounds: {} to {}", point_text(bounds.min), point_text(bounds.max)));
    print_log(fmt::format("image: {} x {} pixels, {} samples each, seed {}", resolution.x, resolution.y,
                          render_samples(loaded.job, render_options(request.settings, 0)),
                          request.settings.samples.seed));
    print_log(fmt::format("integrator: {}; sampler: {}", loaded.integrator, loaded.sampler));
    print_log(fmt::format(
        "dialect settings: emitters {}, mirror {}, point lights in {}, environment images {}times {}",
        loaded.dialect.emitters_absorb ? "absorb" : "scatter", loaded.dialect.mirrored_view ? "on" : "off",
        loaded.dialect.point_takes_power ? "power" : "radiance",
        loaded.dialect.environment_flipped ? "flipped and " : "", loaded.dialect.environment_scale));
    print_log(fmt::format("embree: {}, {}", scene.embree_version(), scene.options().instruction_set));
    print_log(fmt::format("inputs: read in {}, built in {}, hash {}", duration_text(loaded.parse_seconds),
                          duration_text(loaded.build_seconds), loaded.input_hash));
}

} // namespace

LoadedScene load_and_log(const SceneRequest& request)
{
    const std::filesystem::path path(request.scene);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        if (is_no_file_name(request.scene) && !closest_verb(request.scene).empty())
            throw UsageError(unknown_verb(request.scene));
        throw Error(fmt::format("scene file '{}' does not exist{}", request.scene,
                                find_named_file({}, request.scene).way_out));
    }
    LoadedScene scene = load_scene(path, request.settings);
    if (request.quiet) return scene;
    for (const Diagnostic& warning : scene.warnings) print_log(warning);
    print_log(fmt::format("dialect: {} ({})", to_string(scene.dialect.name), scene.dialect.reason));
    if (request.verbose) log_facts(request, scene);
    return scene;
}

} // namespace plumb
