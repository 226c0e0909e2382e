# SPDX-License-Identifier: MIT
"""Writes a description as a Plumb scene file, and its meshes beside it."""

from xml.sax.saxutils import quoteattr

from description import Checkerboard, Color, Image


def numbers(value):
    values = value if isinstance(value, (tuple, list)) else (value,)
    return ", ".join(repr(x) for x in values)


class Writer:
    def __init__(self):
        self.lines = []
        self.depth = 0

    def leaf(self, tag, **attributes):
        text = "".join(f" {name}={quoteattr(str(value))}" for name, value in attributes.items())
        self.lines.append("    " * self.depth + f"<{tag}{text}/>")

    def open(self, tag, **attributes):
        self.leaf(tag, **attributes)
        self.lines[-1] = self.lines[-1][:-2] + ">"
        self.depth += 1

    def close(self, tag):
        self.depth -= 1
        self.lines.append("    " * self.depth + f"</{tag}>")

    def text(self):
        return "\n".join(self.lines) + "\n"


def write_steps(out, steps):
    if not steps:
        return
    out.open("transform", name="toWorld")
    for step in steps:
        if step[0] == "rotate":
            out.leaf("rotate", axis=numbers(step[1]), angle=repr(step[2]))
        elif step[0] == "lookat":
            out.leaf("lookat", origin=numbers(step[1]), target=numbers(step[2]), up=numbers(step[3]))
        else:
            out.leaf(step[0], value=numbers(step[1]))
    out.close("transform")


def write_parameter(out, name, value):
    if isinstance(value, Color):
        value = value.value
    if isinstance(value, Checkerboard):
        tag = "color" if isinstance(value.first, tuple) else "float"
        out.open("texture", type="checkerboard_" + tag, name=name)
        out.leaf(tag, name="value1", value=numbers(value.first))
        out.leaf(tag, name="value2", value=numbers(value.second))
        out.leaf("vector", name="scale", value=numbers(value.scale))
        out.leaf("point", name="delta", value=numbers(value.delta))
        out.close("texture")
    elif isinstance(value, Image):
        out.open("texture", type="imagetexture_color3f", name=name)
        out.leaf("string", name="filepath", value=value.name + ".exr")
        out.close("texture")
    elif isinstance(value, tuple):
        out.leaf("color", name=name, value=numbers(value))
    elif name == "exponent":
        out.leaf("integer", name=name, value=value)
    else:
        out.leaf("float", name=name, value=repr(value))


def write_bsdf(out, bsdf):
    out.open("bsdf", type=bsdf.type)
    for name, value in bsdf.parameters.items():
        write_parameter(out, name, value)
    out.close("bsdf")


def write_shape(out, shape):
    tag = "mesh" if shape.kind == "mesh" else "shape"
    out.open(tag, type="obj" if shape.kind == "mesh" else shape.kind)
    if shape.kind == "mesh":
        out.leaf("string", name="filename", value=shape.mesh.name + ".obj")
    else:
        out.leaf("point", name="center", value=numbers(shape.center))
    if shape.kind == "sphere":
        out.leaf("float", name="radius", value=repr(shape.radius))
    if shape.kind == "rectangle":
        out.leaf("float", name="width", value=repr(shape.width))
        out.leaf("float", name="height", value=repr(shape.height))
        out.leaf("vector", name="normal", value=numbers(shape.normal))
    write_steps(out, shape.steps)
    write_bsdf(out, shape.bsdf)
    if shape.radiance is not None:
        out.open("emitter", type="area")
        write_parameter(out, "radiance", shape.radiance)
        if shape.radiance_scale != 1.0:
            out.leaf("float", name="scale", value=repr(shape.radiance_scale))
        out.close("emitter")
    out.close(tag)


def write_light(out, light):
    out.open("emitter", type="pointlight" if light.kind == "point" else light.kind)
    if light.kind == "point":
        out.leaf("point", name="position", value=numbers(light.position))
    if light.kind == "directional":
        out.leaf("vector", name="direction", value=numbers(tuple(-x for x in light.towards)))
    if light.image:
        out.leaf("string", name="filename", value=light.image.name + ".exr")
    out.leaf("color", name="power" if light.as_power else "radiance", value=numbers(light.color))
    out.close("emitter")


def write_camera(out, camera, rfilter):
    out.open("camera", type="perspective")
    out.leaf("integer", name="width", value=camera.width)
    out.leaf("integer", name="height", value=camera.height)
    out.leaf("float", name="fov", value=repr(camera.fov))
    if camera.lens_radius > 0.0:
        out.leaf("float", name="lensRadius", value=repr(camera.lens_radius))
        out.leaf("float", name="focalDistance", value=repr(camera.focal_distance))
    write_steps(out, [("lookat", camera.origin, camera.target, camera.up)])
    out.open("rfilter", type=rfilter.kind)
    out.leaf("float", name="radius", value=repr(rfilter.radius))
    for name, value in (("stddev", rfilter.stddev), ("B", rfilter.b), ("C", rfilter.c)):
        if value is not None:
            out.leaf("float", name=name, value=repr(value))
    out.close("rfilter")
    out.close("camera")


def scene_text(scene):
    out = Writer()
    out.lines.append(f"<!-- {scene.what}. Written by tools/judge/make.py. -->")
    out.open("scene", dialect="plumb")
    out.open("integrator", type="path_mis")
    out.leaf("integer", name="maxDepth", value=scene.max_depth)
    out.close("integrator")
    out.open("sampler", type="independent")
    out.leaf("integer", name="sampleCount", value=64)
    out.close("sampler")
    write_camera(out, scene.camera, scene.filter)
    for shape in scene.shapes:
        write_shape(out, shape)
    for light in scene.lights:
        write_light(out, light)
    out.close("scene")
    return out.text()


def mesh_text(mesh):
    lines = ["# Written by tools/judge/make.py"]
    lines += ["v " + " ".join(repr(x) for x in p) for p in mesh.positions]
    lines += ["vt " + " ".join(repr(x) for x in p) for p in mesh.uvs or []]
    lines += ["vn " + " ".join(repr(x) for x in p) for p in mesh.normals or []]
    for face in mesh.faces:
        corners = []
        for i in face:
            uv = str(i + 1) if mesh.uvs else ""
            normal = str(i + 1) if mesh.normals else ""
            corners.append(f"{i + 1}/{uv}/{normal}".rstrip("/"))
        lines.append("f " + " ".join(corners))
    return "\n".join(lines) + "\n"


def meshes(scene):
    return [shape.mesh for shape in scene.shapes if shape.mesh]


def images(scene):
    found = [light.image for light in scene.lights if light.image]
    for shape in scene.shapes:
        values = list(shape.bsdf.parameters.values()) + [shape.radiance]
        found += [value for value in values if isinstance(value, Image)]
    return found
