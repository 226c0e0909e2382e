// SPDX-License-Identifier: MIT

// Renders a scene into a picture: consumer SCENE PICTURE

#include "plumb/image/image.h"
#include "plumb/scene_file/scene_file.h"

#include <cstdio>
#include <exception>

int main(int count, char** words)
{
    if (count != 3) return 2;
    try {
        const plumb::LoadedScene scene = plumb::load_scene(words[1], {.resolution = plumb::Vec2i(16, 12)});
        const plumb::RenderState state = plumb::render(scene.job, {.samples_per_pixel = 2});
        plumb::write_image(words[2], state.film.develop());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
