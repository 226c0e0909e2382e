// SPDX-License-Identifier: MIT
#include "plumb/compare/compare.h"

#include "base/lower_case.h"
#include "compare/channel_names.h"

#include <algorithm>

namespace plumb {

bool is_low_dynamic_range(const std::filesystem::path& path)
{
    constexpr std::string_view extensions[] = {".png", ".jpg", ".jpeg", ".bmp", ".tga", ".gif", ".ppm"};
    return std::ranges::find(extensions, lower_case(path.extension().string())) != std::end(extensions);
}

Image read_to_compare(const std::filesystem::path& path)
{
    Image image = read_image(path, true);
    if (is_low_dynamic_range(path)) image.metadata.emplace_back(screen_mark, 1);
    return image;
}

} // namespace plumb
