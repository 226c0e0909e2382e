// SPDX-License-Identifier: MIT
#pragma once

// A scene that renders in milliseconds, in a directory of its own.

#include "support/run.h"

namespace plumb {

using Names = std::vector<std::string>;

// Two spheres on a floor below a lamp.
inline std::string small_scene(const std::string& integrator = R"(<integrator type="path_mis"/>)")
{
    return R"(<scene dialect="plumb">
  )" + integrator +
           R"(
  <sampler type="independent"><integer name="sampleCount" value="4"/></sampler>
  <camera type="perspective">
    <transform name="toWorld"><lookat origin="0,1.5,5" target="0,0.7,0" up="0,1,0"/></transform>
    <float name="fov" value="40"/>
    <integer name="width" value="48"/>
    <integer name="height" value="36"/>
  </camera>
  <shape type="rectangle">
    <float name="width" value="8"/><float name="height" value="8"/><vector name="normal" value="0,1,0"/>
    <bsdf type="diffuse"><color name="albedo" value="0.6,0.5,0.4"/></bsdf>
  </shape>
  <shape type="sphere">
    <point name="center" value="-0.8,0.6,0"/><float name="radius" value="0.6"/>
    <bsdf type="dielectric"/>
  </shape>
  <shape type="sphere">
    <point name="center" value="0.8,0.6,0"/><float name="radius" value="0.6"/>
    <bsdf type="diffuse"/>
  </shape>
  <shape type="sphere">
    <point name="center" value="0,3,1"/><float name="radius" value="0.4"/>
    <emitter type="area"><color name="radiance" value="20,20,18"/></emitter>
  </shape>
</scene>
)";
}

// A ball on a floor below a large lamp: no estimator finds that hard.
inline constexpr const char* easy_scene = R"(<scene dialect="plumb">
  <sampler type="independent"><integer name="sampleCount" value="64"/></sampler>
  <camera type="perspective">
    <transform name="toWorld"><lookat origin="0,0,-0.9" target="0,0,1" up="0,1,0"/></transform>
    <float name="fov" value="60"/><integer name="width" value="24"/><integer name="height" value="18"/>
  </camera>
  <shape type="rectangle"><vector name="normal" value="0,1,0"/><point name="center" value="0,-0.5,0"/>
    <float name="width" value="9"/><float name="height" value="9"/>
    <bsdf type="diffuse"><color name="albedo" value="0.7,0.6,0.5"/></bsdf></shape>
  <shape type="sphere"><point name="center" value="0,0,1"/><float name="radius" value="0.4"/>
    <bsdf type="diffuse"><color name="albedo" value="0.5,0.8,0.9"/></bsdf></shape>
  <shape type="sphere"><point name="center" value="0,3,0"/><float name="radius" value="2"/>
    <emitter type="area"><color name="radiance" value="1,1,1"/></emitter></shape>
</scene>
)";

// The same with a lamp that few naive paths meet.
inline std::string small_lamp_scene()
{
    std::string scene = easy_scene;
    const std::string large = R"(<float name="radius" value="2"/>
    <emitter type="area"><color name="radiance" value="1,1,1"/>)";
    return scene.replace(scene.find(large), large.size(), R"(<float name="radius" value="0.02"/>
    <emitter type="area"><color name="radiance" value="9999,9999,9999"/>)");
}

// A directory with the small scene in scene.xml.
struct SceneDirectory : TempDirectory {
    SceneDirectory() { write("scene.xml", small_scene()); }
    RunResult run(const Names& words, const std::string& out = "") const
    {
        return run_renderer(words, path(), out);
    }
};

} // namespace plumb
