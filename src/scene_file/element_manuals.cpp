// SPDX-License-Identifier: MIT
#include "scene_file/element_manuals.h"

#include <algorithm>

namespace plumb {

namespace {

// Elements with types end with the list of these, which the caller prints.
constexpr ElementManual manuals[] = {
    {"scene", R"(The root of a scene file.

Holds one <camera>, one <integrator>, at most one <sampler>, any number of <mesh> or <shape> and of <emitter>, in any
order, <bsdf> and <texture> that a <ref> names, and <include> and <default>. The attribute `dialect` says which
course's dialect applies: plumb, epfl, eth, zaragoza or mcgill; without it the dialect is chosen by marks in the
file.

    aovs   string   layers that are written besides those of --aov: "albedo, dd.y:mean_depth" (docs/aovs.md)

        <scene dialect="plumb">
            <integrator type="path_mis"/>
            <camera type="perspective"/>
            <mesh type="sphere"> <emitter type="area"/> </mesh>
        </scene>
)"},
    {"transform translate scale rotate lookat matrix",
     R"(A parameter that is a matrix: the product of operations, the first one applied first.

    translate   value="x,y,z"
    scale       value="x,y,z", none of them 0
    rotate      axis="x,y,z" angle="degrees", counter-clockwise seen from the axis' tip
    lookat      origin="x,y,z" target="x,y,z" up="x,y,z": places a camera, which looks from origin to target
    matrix      value="16 numbers", row by row; the last row is 0 0 0 1

For example:

        <transform name="toWorld">
            <scale value="2,2,2"/>
            <rotate axis="0,1,0" angle="30"/>
            <translate value="0,1,0"/>
        </transform>
)"},
    {"parameter boolean integer float string point vector color",
     R"(A value, in the object whose parameter it is; 'renderer types TYPE' lists an object's parameters.

    boolean   true or false
    integer   a whole number
    float     a number; or an integer
    string    text; file names are relative to the directory of the file that contains them
    point     three numbers
    vector    three numbers, or two where a texture takes u and v
    color     three numbers: linear RGB

Numbers in a list are separated by commas or blanks. For example:

        <float name="fov" value="40"/>
        <color name="albedo" value="0.7,0.6,0.5"/>
)"},
    {"include", R"(Puts the children of another file's root in its place.

    filename   relative to the directory of the file that contains it

It stands in <scene> (in suites: in <suite> or <group>). For example:

        <include filename="parts/lamps.xml"/>
)"},
    {"default", R"(Gives $name a value, to be used in any attribute of the scene.

    name    letters, digits, - and _; it begins with a letter or _
    value   any text

-D name=value on the command line takes precedence over every <default>, and the first
<default> of a name over later ones.
$$ stands for the sign itself. It stands in <scene> (in suites: in <suite> or <group>). For example:

        <default name="spp" value="64"/>
        <sampler type="independent"> <integer name="sampleCount" value="$spp"/> </sampler>
)"},
    {"mesh shape", R"(A surface. <mesh> and <shape> mean the same.

It stands in <scene>, or in a <shape type="group">, and may hold one <bsdf> (default: diffuse, albedo 0.5) and, in <scene>,
one <emitter type="area">.
)"},
    {"bsdf", R"(What a surface is made of.

It stands in the <mesh> or <shape> whose surface it is, in another <bsdf> that changes it, or, with an id for <ref>, in
<scene>. It may hold a <texture> for each parameter that takes one.
)"},
    {"texture", R"(A value that differs from point to point of a surface, over its uv coordinates.

It stands in a <bsdf> or <emitter>, with the parameter that it replaces as its name: <texture name="albedo" ...>. Where
only one parameter can be a texture, the name may be omitted. With an id for <ref>, it may stand in <scene>.
)"},
    {"ref", R"(Uses a <bsdf>, a <texture> or, in an instance, a group that is defined elsewhere.

    id      of a <bsdf>, <texture> or <shape type="group"> anywhere in the scene, before or after
    name    of a texture: the parameter that it replaces, as in <texture>

The object is built once, however many use it. It stands in <mesh>, <shape>, <bsdf> or <emitter>. For example:

        <bsdf type="roughconductor" id="gold"> <color name="R0" value="1 0.71 0.29"/> </bsdf>
        <shape type="sphere"> <ref id="gold"/> </shape>
)"},
    {"emitter", R"(A light source.

'area' stands in the <mesh> or <shape> that emits; all others stand in <scene>.
)"},
    {"camera", R"(Where the image is taken from, and its size.

One stands in <scene>. It may hold one <rfilter>.
)"},
    {"rfilter", R"(The reconstruction filter: how samples make pixels.

It stands in <camera>; without one: gaussian.
)"},
    {"sampler", R"(Where random numbers come from, and how many samples a pixel gets.

It stands in <scene>; without one: independent, 1 sample.
)"},
    {"integrator", R"(How light is gathered.

One stands in <scene>.
)"},
};

} // namespace

std::string_view ElementManual::title() const
{
    return names.substr(0, names.find(' '));
}

bool ElementManual::is_about(std::string_view name) const
{
    for (std::string_view rest = names; !rest.empty();) {
        const std::string_view one = rest.substr(0, rest.find(' '));
        if (one == name) return true;
        rest.remove_prefix(std::min(one.size() + 1, rest.size()));
    }
    return false;
}

std::span<const ElementManual> element_manuals()
{
    return manuals;
}

const ElementManual* find_element_manual(std::string_view name)
{
    for (const ElementManual& manual : manuals)
        if (manual.is_about(name)) return &manual;
    return nullptr;
}

} // namespace plumb
