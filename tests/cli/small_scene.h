// SPDX-License-Identifier: MIT
#pragma once

// A scene that renders in milliseconds, in a folder of its own.

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

// A folder with the small scene in scene.xml.
struct SceneFolder : TempFolder {
    SceneFolder() { write("scene.xml", small_scene()); }
    RunResult run(const Names& words, const std::string& out = "") const
    {
        return run_renderer(words, path(), out);
    }
};

} // namespace plumb
