// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/verb_file.h"
#include "reports/exit_codes.h"

#include "base/shell_words.h"
#include "plumb/base/error.h"

#include <cerrno>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <system_error>

namespace plumb {

namespace {

constexpr std::string_view first_scene =
    R"(<!-- To render it: renderer FILE. To list all types: renderer types. -->

<!-- The scene language has dialects, for the courses that use it: "plumb" is that of the manual. -->
<scene dialect="plumb">

    <!-- How light is found, and the number of paths per pixel: more paths mean less noise. -->
    <integrator type="path_mis"/>
    <sampler type="sobol"> <integer name="sampleCount" value="64"/> </sampler>

    <!-- x goes to the right, y up, z towards you. -->
    <camera type="perspective">
        <integer name="width" value="480"/> <integer name="height" value="320"/>
        <float name="fov" value="46"/>
        <transform name="toWorld">
            <lookat origin="0, 2.4, 7" target="0, 0.9, 0" up="0, 1, 0"/>
        </transform>
    </camera>

    <!-- The floor: squares of 1 by 1. -->
    <shape type="rectangle">
        <point name="center" value="0, 0, 0"/> <vector name="normal" value="0, 1, 0"/>
        <float name="width" value="24"/> <float name="height" value="24"/>
        <bsdf type="diffuse">
            <texture type="checkerboard_color" name="albedo">
                <color name="value1" value="0.65 0.62 0.58"/> <color name="value2" value="0.28 0.30 0.34"/>
                <vector name="scale" value="0.041667, 0.041667"/>
            </texture>
        </bsdf>
    </shape>

    <!-- Gold, glass and plastic. -->
    <shape type="sphere">
        <point name="center" value="-1.9, 0.9, -0.4"/> <float name="radius" value="0.9"/>
        <bsdf type="roughconductor">
            <color name="R0" value="1.0 0.78 0.34"/> <float name="alpha" value="0.15"/>
        </bsdf>
    </shape>
    <shape type="sphere">
        <point name="center" value="0.1, 0.8, 0.7"/> <float name="radius" value="0.8"/>
        <bsdf type="dielectric"/>
    </shape>
    <shape type="sphere">
        <point name="center" value="1.9, 0.9, -0.6"/> <float name="radius" value="0.9"/>
        <bsdf type="roughsubstrate">
            <color name="kd" value="0.55 0.08 0.06"/> <float name="alpha" value="0.08"/>
        </bsdf>
    </shape>

    <!-- An emitter above. It shines along its normal, downwards. -->
    <shape type="rectangle">
        <point name="center" value="-1.5, 5, 2"/> <vector name="normal" value="0.2, -1, -0.3"/>
        <float name="width" value="2.5"/> <float name="height" value="2.5"/>
        <emitter type="area"> <color name="radiance" value="11 10 8.5"/> </emitter>
    </shape>

    <!-- And the sky. -->
    <emitter type="environment"> <color name="radiance" value="0.25 0.32 0.42"/> </emitter>
</scene>
)";

std::string reason_of(int error)
{
    return std::generic_category().message(error);
}

// A file that is there already stays as it is.
void write_new(const std::string& file, std::string_view text)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(file.c_str(), "wxb"), std::fclose);
    if (!out && errno == EEXIST)
        throw Error(fmt::format("'{}' already exists; choose another file name", file));
    if (!out) throw Error(fmt::format("cannot write '{}': {}", file, reason_of(errno)));
    const bool written = std::fwrite(text.data(), 1, text.size(), out.get()) == text.size();
    if (!written || std::fflush(out.get()) != 0) {
        const int error = errno;
        std::remove(file.c_str());
        throw Error(fmt::format("cannot write '{}': {}", file, reason_of(error)));
    }
}

int run(const VerbOptions& options)
{
    const std::string& file = options.subject();
    write_new(file, first_scene);
    print_log(fmt::format("{}: written; to see it:", shell_quote(file)));
    print_log(fmt::format("    renderer {}", shell_quote(file)));
    return exit_code::done;
}

constexpr std::string_view manual =
    R"(Writes a small scene with comments, to begin with. An existing file is not
overwritten.
)";

} // namespace

struct NewVerb {
    static Verb make()
    {
        return make_verb<VerbOptions>(
            {"new", "FILE", "write a small scene to begin with", "scene file", 1, 1, std::string(manual)},
            help_option<VerbOptions>(), run);
    }
};
template const Verb& verb<NewVerb>();

} // namespace plumb
