// SPDX-License-Identifier: MIT
#include "cameras/film_window.h"

#include <fmt/format.h>

namespace plumb {

FilmWindow::FilmWindow(const Params& params)
{
    const Range size = Range::closed(1, 65535), place = Range::closed(0, 65535);
    const auto integer = [&](std::string_view name, int fallback, const Range& range) {
        return static_cast<int>(params.integer(name, fallback, range));
    };
    full.x = integer("width", 1280, size);
    full.y = integer("height", 720, size);
    const Vec2i corner(integer("cropOffsetX", 0, place), integer("cropOffsetY", 0, place));
    resolution.x = integer("cropWidth", std::max(full.x - corner.x, 1), size);
    resolution.y = integer("cropHeight", std::max(full.y - corner.y, 1), size);
    sample_border = params.boolean("sampleBorder", true);
    offset = Vec2f(static_cast<float>(corner.x), static_cast<float>(corner.y));
    const auto check = [&](const char* offset_name, const char* size_name, int begin, int length, int all) {
        if (begin + length <= all) return;
        params.fail(
            params.has(size_name) ? size_name : offset_name,
            fmt::format(
                "must leave the crop inside the image of {} x {} pixels, not end it at pixel {} of {}",
                full.x, full.y, begin + length, all));
    };
    check("cropOffsetX", "cropWidth", corner.x, resolution.x, full.x);
    check("cropOffsetY", "cropHeight", corner.y, resolution.y, full.y);
}

} // namespace plumb
