// SPDX-License-Identifier: MIT
#include "base/memory.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/manuals.h"
#include "cli/text.h"

#include "plumb/check/check.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr double megabyte = 1e6;

// What the scene has taken so far, and what film and picture will.
std::string memory_text(const LoadedScene& scene)
{
    const auto now = static_cast<double>(peak_memory());
    const Vec2i size = scene.job.camera->resolution();
    constexpr double picture_bytes = 7 * sizeof(float);
    const double later = static_cast<double>(size.x) * static_cast<double>(size.y) *
                         (static_cast<double>(Film::bytes_per_pixel()) + picture_bytes);
    return fmt::format("memory: {:.0f} MB for the scene and the program, {:.0f} MB for film and image without AOVs",
                       now / megabyte, later / megabyte);
}

} // namespace

std::string_view check_manual()
{
    return R"(Checks a scene for mistakes without rendering it. Reports
  - all errors and warnings of loading (triangles without area, albedos above
    1, images with values that are not finite, ...);
  - glass that is not closed or is turned inside out;
  - emitters that are black, face a wall or shine into themselves;
  - BSDFs that scatter more light than they receive;
  - a camera inside an object;
  - a scene without light, or with light that no path from the camera finds;
  - a scene so far from the origin that floats are too coarse for it;
  - surfaces that coincide;
  - how much memory rendering takes.
Exit code: 0 no mistakes found, 1 errors, 2 wrong usage, 3 likely mistakes.
)";
}

int check_command(const SceneRequest& request)
{
    const LoadedScene scene = load_and_log(request);
    ImageLibrary::hash(); // is loaded, since rendering takes its memory, too
    const std::string memory = memory_text(scene);
    const std::vector<Doubt> doubts = find_doubts(scene.job);
    const bool is_clean = doubts.empty() && scene.warnings.empty();
    for (const Doubt& doubt : doubts)
        print_output(fmt::format("{}{}{}\n", visible_text(doubt.object), doubt.object.empty() ? "" : ": ",
                                 visible_text(doubt.text)));
    if (!request.quiet) {
        print_output(memory + "\n");
        if (is_clean) print_output("no mistakes found\n");
    }
    return is_clean ? exit_code::done : exit_code::differs;
}

} // namespace plumb
