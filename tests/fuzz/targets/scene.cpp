// SPDX-License-Identifier: MIT

// Scene files: XML, includes, values, plugins, meshes, Embree; and one sample of what was loaded.

#include "base/visible_text.h"
#include "fuzz/fuzz.h"
#include "plumb/scene_file/scene_file.h"

using namespace plumb;
using namespace plumb::fuzz;

namespace {

// What a scene may name.
void make_files()
{
    static const bool once = [] {
        write_file("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n");
        write_file("i.xml", "<scene><default name=\"q\" value=\"3\"/><mesh type=\"sphere\"/></scene>");
        write_file("t.png", "window 0 0 2 2 of 2 2\nfloats R G B\nlevels 256\npixels\n1234567890abcdefghij");
        write_file("t.exr", "window 0 0 3 2 of 3 2\nfloats R G B\npixels\naaa@bbb@ccc>ddd>eee=fff=ggg?");
        return true;
    }();
    static_cast<void>(once);
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    make_files();
    const auto path = write_file("scene.xml", text_of(data, size));
    RenderSettings options;
    options.view.size = Vec2i(4, 4);
    allow_our_errors([&] {
        const LoadedScene scene = load_scene(path, options);
        for (const Diagnostic& warning : scene.warnings) expect_printable(warning.text());
        expect_printable(visible_text(scene.dialect.reason));
        RenderOptions one_sample;
        one_sample.samples_per_pixel = 1;
        one_sample.threads = 1;
        one_sample.crop = PixelRect{2, 2, 1, 1};
        expect(render(scene.job, one_sample).taken.count() == 1, "a sample was not taken");
    });
    return 0;
}
