# SPDX-License-Identifier: MIT
"""Turns a description into a Mitsuba 3 dictionary, and renders it."""

import mitsuba as mi
import numpy as np

import mitsuba_models
from description import Checkerboard, Color, Image

Transform = mi.ScalarTransform4f


def rgb(value):
    return {"type": "rgb", "value": [float(x) for x in value]}


def raw(value):
    """A colour that may exceed 1."""
    return {"type": "rawconstant", "value": [float(x) for x in value]}


def steps_transform(steps):
    result = Transform()
    for step in steps:
        if step[0] == "rotate":
            axis = np.array(step[1], dtype=float)  # Mitsuba expects a unit vector, and does not say so
            one = Transform().rotate((axis / np.linalg.norm(axis)).tolist(), float(step[2]))
        else:
            one = getattr(Transform(), step[0])([float(x) for x in step[1]])
        result = one @ result  # the first step is applied first
    return result


def texture(value):
    if isinstance(value, Color):
        value = value.value
    if isinstance(value, tuple):
        return rgb(value)
    if isinstance(value, Checkerboard):
        # Mitsuba's has 2 x 2 squares in the unit square, color0 at the corner.
        scale = [0.5 / value.scale[0], 0.5 / value.scale[1], 1.0]
        offset = [-0.5 * value.delta[0], -0.5 * value.delta[1], 0.0]
        ends = [value.first, value.second]
        # Mitsuba 3.9.1's checkerboard begins with color0 where it is asked for colours, with color1 where for a number.
        ends = [raw(x) for x in ends] if isinstance(ends[0], tuple) else [float(x) for x in reversed(ends)]
        return {
            "type": "checkerboard",
            "color0": ends[0],
            "color1": ends[1],
            "to_uv": Transform().translate(offset) @ Transform().scale(scale),
        }
    if isinstance(value, Image):
        # Mitsuba's first row is at v = 0.
        data = np.array(value.rows, dtype=np.float32)[::-1].copy()
        return {
            "type": "bitmap",
            "bitmap": mi.Bitmap(data),
            "raw": True,
            "filter_type": "bilinear",
            "wrap_mode": "repeat",
        }
    return float(value)


def dielectric_indices(p):
    return float(p.get("intIOR", 1.5046)), float(p.get("extIOR", 1.000277))


def rough_metal(p, **more):
    # Sampling all normals, not the visible ones: those are sampled after the exact shadowing function of [Heitz and
    # d'Eon 2014], while the density uses Walter's rational fit of it.
    return {
        "type": "roughconductor",
        "distribution": "beckmann",
        "alpha": texture(p.get("alpha", 0.1)),
        "sample_visible": False,
        **more,
    }


def bsdf(description):
    p = description.parameters

    def diffuse():
        return {"type": "diffuse", "reflectance": texture(p.get("albedo", (0.5, 0.5, 0.5)))}

    def mirror():
        return {"type": "conductor", "material": "none"}

    def dielectric():
        interior, exterior = dielectric_indices(p)
        return {"type": "dielectric", "int_ior": interior, "ext_ior": exterior}

    def microfacet():
        # kd / pi + ks (microfacets with the dielectric's reflectance): a blend of a diffuse base with albedo
        # kd / (1 - ks) and a metal whose index of refraction is real.
        interior, exterior = dielectric_indices(p)
        kd = p.get("kd", (0.5, 0.5, 0.5))
        base = max(kd)
        return {
            "type": "blendbsdf",
            "weight": 1.0 - base,
            "base": {"type": "diffuse", "reflectance": rgb([x / base if base > 0.0 else 0.0 for x in kd])},
            "coat": rough_metal(p, eta=interior / exterior, k=0.0),
        }

    def roughconductor():
        if p["R0"] != (1.0, 1.0, 1.0):
            return mitsuba_models.plugin(description)
        return rough_metal(p, material="none")  # Schlick's formula is 1 at all angles where R0 is 1

    def roughdielectric():
        interior, exterior = dielectric_indices(p)
        tint = texture(p.get("ka", (1.0, 1.0, 1.0)))
        dictionary = {
            "type": "roughdielectric",
            "distribution": "beckmann",
            "alpha": texture(p.get("alpha", 0.1)),
            "int_ior": interior,
            "ext_ior": exterior,
            "specular_reflectance": tint,
            "specular_transmittance": tint,
        }
        return mitsuba_models.rough_glass(dictionary)

    known = {f.__name__: f for f in (diffuse, mirror, dielectric, microfacet, roughconductor, roughdielectric)}
    if description.type not in known:
        return mitsuba_models.plugin(description)
    return known[description.type]()


def rectangle_transform(shape):
    """From the square [-1, 1]^2 of the xy plane. Width runs along x, projected onto the plane, or along z."""
    normal = np.array(shape.normal, dtype=float)
    normal /= np.linalg.norm(normal)
    along = np.array([1.0, 0.0, 0.0]) - normal * normal[0]
    along = along / np.linalg.norm(along) if np.linalg.norm(along) > 1e-6 else np.array([0.0, 0.0, 1.0])
    matrix = np.eye(4)
    matrix[:3, 0] = along * (shape.width / 2)
    matrix[:3, 1] = np.cross(normal, along) * (shape.height / 2)
    matrix[:3, 2] = normal
    matrix[:3, 3] = shape.center
    return Transform(matrix.tolist())


def shape(description, directory):
    to_world = steps_transform(description.steps)
    if description.kind == "mesh":
        result = {
            "type": "obj",
            "filename": str(directory / (description.mesh.name + ".obj")),
            "face_normals": description.mesh.normals is None,
            "flip_tex_coords": False,
            "to_world": to_world,
        }
    elif description.kind == "sphere":
        result = {
            "type": "sphere",
            "center": [float(x) for x in description.center],
            "radius": float(description.radius),
            "to_world": to_world,
        }
    else:
        result = {"type": "rectangle", "to_world": to_world @ rectangle_transform(description)}
    result["bsdf"] = bsdf(description.bsdf)
    if description.radiance is not None:
        factor = description.radiance_scale
        radiance = description.radiance
        if isinstance(radiance, tuple):
            radiance = tuple(x * factor for x in radiance)
        elif factor != 1.0:
            raise KeyError("a scaled texture")
        result["emitter"] = {"type": "area", "radiance": texture(radiance)}
    return result


def environment_rows(rows):
    """Mitsuba's first and last row stand at the poles, ours have half a row between: twice as many rows and one."""
    ours = np.array(rows, dtype=np.float32)
    count = 2 * len(ours) + 1
    result = np.empty((count, *ours.shape[1:]), dtype=np.float32)
    for i in range(count):
        low = max((i - 1) // 2, 0)
        high = min(i // 2, len(ours) - 1)
        result[i] = 0.5 * (ours[low] + ours[high])
    return result


def light(description):
    color = [float(x) for x in description.color]
    if description.kind == "point":
        if description.as_power:
            color = [x / (4.0 * np.pi) for x in color]
        return {"type": "point", "position": list(map(float, description.position)), "intensity": rgb(color)}
    if description.kind == "directional":
        towards = [-float(x) for x in description.towards]
        return {"type": "directional", "direction": towards, "irradiance": rgb(color)}
    if description.image is None:
        return {"type": "constant", "radiance": rgb(color)}
    # Ours has u = atan2(z, x) / 2 pi, Mitsuba's u = atan2(x, -z) / 2 pi: a quarter turn about y.
    rows = environment_rows(description.image.rows) * np.array(color, dtype=np.float32)
    turn = np.array([[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]], dtype=float)
    return {
        "type": "envmap",
        "bitmap": mi.Bitmap(rows.astype(np.float32)),
        "to_world": Transform(np.linalg.inv(turn).tolist()),
    }


def camera(scene, sampler):
    c = scene.camera
    rfilter = {"type": scene.filter.kind}
    if scene.filter.kind == "box":
        assert scene.filter.radius == 0.5, "Mitsuba's box is a pixel"
    if scene.filter.kind == "tent":
        rfilter["radius"] = scene.filter.radius
    if scene.filter.kind == "gaussian":
        assert scene.filter.radius == 4 * scene.filter.stddev, "Mitsuba's gaussian ends at four deviations"
        rfilter["stddev"] = scene.filter.stddev
    if scene.filter.kind == "mitchell":
        assert scene.filter.radius == 2.0
        rfilter |= {"B": scene.filter.b, "C": scene.filter.c}
    result = {
        "type": "perspective",
        "fov": c.fov,
        "fov_axis": "x",
        "near_clip": 1e-3,
        "to_world": Transform().look_at(
            *([float(x) for x in point] for point in (c.origin, c.target, c.up))
        ),
        "film": {
            "type": "hdrfilm",
            "width": c.width,
            "height": c.height,
            "pixel_format": "rgb",
            "component_format": "float32",
            "sample_border": scene.filter.radius > 0.5,
            "rfilter": rfilter,
        },
        "sampler": {"type": sampler},
    }
    if c.lens_radius > 0.0:
        result |= {"type": "thinlens", "aperture_radius": c.lens_radius, "focus_distance": c.focal_distance}
    return result


def build(scene, directory, sampler="independent", robust=False):
    """robust: Embree's rays do not pass between triangles that share an edge, as they do not in Plumb."""
    depth = scene.max_depth if scene.max_depth < 0 else scene.max_depth + 1  # Mitsuba counts the camera's ray
    result = {"type": "scene", "integrator": {"type": "path", "max_depth": depth}, "camera": camera(scene, sampler)}
    if robust:
        result["embree_use_robust_intersections"] = True
    for i, one in enumerate(scene.shapes):
        result[f"shape{i}"] = shape(one, directory)
    for i, one in enumerate(scene.lights):
        result[f"light{i}"] = light(one)
    return mi.load_dict(result)


def render(scene, directory, replicates, samples):
    """The mean of `replicates` renders with seeds of their own, and the variance of that mean, of each value."""
    return statistics(build(scene, directory), replicates, samples, scene.filter.radius > 0.5)


def render_file(path, replicates, samples):
    """The same of a file, whose filter is a pixel's box."""
    return statistics(mi.load_file(str(path)), replicates, samples, False)


def statistics(built, replicates, samples, shares_samples):
    renders = [
        np.array(mi.render(built, spp=samples, seed=1000 + i), dtype=np.float64)[:, :, :3]
        for i in range(replicates)
    ]
    stack = np.array(renders)
    mean = stack.mean(axis=0)
    variance = stack.var(axis=0, ddof=1) / replicates
    # A sample of a wide filter adds to several pixels. What that adds to the variance of a sum over many pixels is
    # spread over them, so that variances of pixels may be summed.
    if shares_samples:
        of_sum = stack.sum(axis=(1, 2)).var(axis=0, ddof=1) / replicates
        variance *= np.maximum(of_sum / np.maximum(variance.sum(axis=(0, 1)), 1e-300), 1.0)
    return mean, variance
