// SPDX-License-Identifier: MIT
#pragma once

// The scene of the seeds that are images and states: a lamp above a ball.

namespace plumb::fuzz {

inline constexpr const char* small_scene_name = "small_scene.xml";

inline constexpr const char* small_scene = R"(<scene dialect="plumb">
  <default name="size" value="4"/>
  <integrator type="path_mis"/>
  <sampler type="independent"><integer name="sampleCount" value="2"/></sampler>
  <camera type="perspective">
    <transform name="toWorld"><lookat origin="0,1,5" target="0,0.7,0" up="0,1,0"/></transform>
    <integer name="width" value="$size"/>
    <integer name="height" value="3"/>
  </camera>
  <shape type="sphere">
    <point name="center" value="0,0.6,0"/><float name="radius" value="0.6"/>
    <bsdf type="diffuse"/>
  </shape>
  <shape type="sphere">
    <point name="center" value="0,3,1"/><float name="radius" value="0.4"/>
    <emitter type="area"><color name="radiance" value="20,20,18"/></emitter>
  </shape>
</scene>
)";

} // namespace plumb::fuzz
