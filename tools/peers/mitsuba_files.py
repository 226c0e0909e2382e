# SPDX-License-Identifier: MIT
"""Scenes of the bench that are files of Mitsuba 3, which Plumb reads as they are: see docs/mitsuba.md.

kitchen: a room with shelves of instanced crockery, plants with masked leaves, a window of thin glass and an environment map
behind it. 36 materials: textured diffuse, rough metals and plastics, glass, principled, bump and normal maps, masks.
"""

import math
import random

import numpy as np

import images

SEED = 7
WOODS, TILES, CLOTHS, METALS, PLASTICS, PRINCIPLED = 4, 4, 6, 6, 6, 4


def noise(numbers, size, cells):
    """Values in [0, 1] that repeat: a coarse grid, smoothly interpolated."""
    grid = numbers.random((cells, cells))
    at = np.arange(size) * cells / size
    low, t = at.astype(int), at % 1.0
    t = t * t * (3 - 2 * t)
    rows = grid[low] * (1 - t)[:, None] + grid[(low + 1) % cells] * t[:, None]
    return rows[:, low] * (1 - t) + rows[:, (low + 1) % cells] * t


def textures(directory, size):
    numbers = np.random.default_rng(SEED)
    x, y = np.meshgrid(np.arange(size) / size, np.arange(size) / size)

    def write(name, color, level):
        rgb = np.clip(np.asarray(color) * level[:, :, None], 0.0, 0.9)
        images.write(directory / (name + ".exr"), rgb)

    for i in range(WOODS):
        ring = 9.0 * np.hypot(x - 0.3 - 0.1 * i, 0.2 * np.sin(9 * y) + 0.4) + noise(numbers, size, 8)
        write(f"wood{i}", (0.62 - 0.08 * i, 0.38 - 0.05 * i, 0.2), 0.6 + 0.4 * (ring % 1.0))
    for i in range(TILES):
        joint = ((x * (4 + i)) % 1.0 < 0.06) | ((y * (4 + i)) % 1.0 < 0.06)
        write(f"tiles{i}", (0.7 - 0.1 * i, 0.68, 0.6 + 0.05 * i), np.where(joint, 0.4, 0.8 + 0.2 * noise(numbers, size, 16)))
    for i in range(CLOTHS):
        weave = 0.7 + 0.15 * np.sin(2 * math.pi * 16 * x) + 0.15 * np.sin(2 * math.pi * 16 * y)
        write(f"cloth{i}", (0.3 + 0.1 * i, 0.7 - 0.1 * i, 0.25 + 0.08 * ((3 * i) % 6)), weave)
    inside = (x - 0.5) ** 2 + ((y - 0.5) * 0.6) ** 2 < 0.05 + 0.02 * np.cos(2 * math.pi * 7 * y)
    images.write(directory / "leaf.exr", np.repeat(inside.astype(float)[:, :, None], 3, axis=2))
    write("veins", (0.2, 0.5, 0.12), 0.7 + 0.3 * np.abs(np.sin(2 * math.pi * 6 * (x + np.abs(y - 0.5)))))
    write("height", (0.9, 0.9, 0.9), noise(numbers, size, 16))
    slope = 0.15 * np.stack([np.sin(2 * math.pi * 8 * x), np.sin(2 * math.pi * 8 * y)], axis=2)
    normal = np.concatenate([slope, np.ones((size, size, 1))], axis=2)
    images.write(directory / "normal.exr", 0.5 + 0.5 * normal / np.linalg.norm(normal, axis=2, keepdims=True))


def lathe(path, profile, segments):
    """A surface of revolution about +y, with uv, as a binary PLY."""
    rows, points, faces = len(profile), [], []
    for j in range(segments + 1):
        angle = 2 * math.pi * j / segments
        for i, (radius, height) in enumerate(profile):
            points.append((radius * math.cos(angle), height, -radius * math.sin(angle), j / segments, i / (rows - 1)))
    for j in range(segments):
        for i in range(rows - 1):
            a, b = j * rows + i, (j + 1) * rows + i
            faces += [(a, b, a + 1), (b, b + 1, a + 1)]
    header = ("ply\nformat binary_little_endian 1.0\n" f"element vertex {len(points)}\n"
              + "".join(f"property float {name}\n" for name in "xyzuv")
              + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")  # fmt: skip
    records = np.empty(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    records["n"], records["v"] = 3, faces
    path.write_bytes(header.encode() + np.asarray(points, "<f4").tobytes() + records.tobytes())


def bitmap(name, file, more=""):
    return f'<texture name="{name}" type="bitmap"><string name="filename" value="{file}.exr"/>{more}</texture>'


def to_uv(scale):
    return f'<transform name="to_uv"><scale value="{scale}"/></transform>'


def bsdf(kind, inner="", name=""):
    return f'<bsdf type="{kind}"{name}>{inner}</bsdf>'


def materials():
    """Name: XML without its id."""
    found = {}
    for i in range(WOODS):
        found[f"wood{i}"] = bsdf("diffuse", bitmap("reflectance", f"wood{i}", to_uv(1 + i)))
    for i in range(TILES):
        found[f"tiles{i}"] = bsdf("roughplastic", bitmap("diffuse_reflectance", f"tiles{i}", to_uv(2)) +
                                  f'<float name="alpha" value="{0.08 + 0.06 * i:.2f}"/>')  # fmt: skip
    for i in range(CLOTHS):
        found[f"cloth{i}"] = bsdf("diffuse", bitmap("reflectance", f"cloth{i}", to_uv(3)))
    for i, metal in enumerate(("Au", "Cu", "Al", "Ag", "Cr", "W")[:METALS]):
        found[f"metal{i}"] = bsdf("roughconductor", f'<string name="material" value="{metal}"/><string name="distribution" '
                                  f'value="ggx"/><float name="alpha" value="{0.08 + 0.05 * i:.2f}"/>')  # fmt: skip
    for i in range(PLASTICS):
        found[f"glaze{i}"] = bsdf("roughplastic", f'<rgb name="diffuse_reflectance" value="{0.1 + 0.12 * i:.2f}, '
                                  f'{0.7 - 0.1 * i:.2f}, 0.4"/><string name="distribution" value="ggx"/><float name="alpha" '
                                  f'value="{0.05 + 0.04 * i:.2f}"/><boolean name="nonlinear" value="true"/>')  # fmt: skip
    for i in range(PRINCIPLED):
        found[f"paint{i}"] = bsdf("principled", bitmap("base_color", f"cloth{i}") + f'<float name="roughness" '
                                  f'value="{0.2 + 0.15 * i:.2f}"/><float name="metallic" value="{0.2 * i:.1f}"/>')  # fmt: skip
    found["bumpy"] = bsdf("bumpmap", bitmap("height", "height", '<boolean name="raw" value="true"/>') +
                          '<float name="scale" value="0.05"/>' + found["tiles1"])  # fmt: skip
    found["dented"] = bsdf("normalmap", bitmap("normalmap", "normal", '<boolean name="raw" value="true"/>') + found["metal2"])
    solid = ("wood", "tiles", "cloth", "metal", "glaze", "paint", "bumpy", "dented")
    found = {name: bsdf("twosided", text) if name.startswith(solid) else text for name, text in found.items()}
    found["leaf"] = bsdf("mask", bitmap("opacity", "leaf") + bsdf("twosided", bsdf("diffuse", bitmap("reflectance", "veins"))))
    found["glass"] = bsdf("dielectric")
    found["frosted"] = bsdf("roughdielectric", '<string name="distribution" value="ggx"/><float name="alpha" value="0.2"/>')
    found["pane"] = bsdf("thindielectric")
    return found


def move(*steps):
    return '<transform name="to_world">' + "".join(steps) + "</transform>"


def scaled(x, y, z):
    return f'<scale x="{x:g}" y="{y:g}" z="{z:g}"/>'


def turned(axis, angle):
    return f'<rotate {axis}="1" angle="{angle:g}"/>'


def at(x, y, z):
    return f'<translate x="{x:.4f}" y="{y:.4f}" z="{z:.4f}"/>'


def shape(kind, material, *steps, more=""):
    return f'<shape type="{kind}">{more}{move(*steps)}<ref id="{material}"/></shape>\n'


def kitchen(directory, width, height, quick):
    textures(directory, 64 if quick else 512)
    images.write(directory / "sky.exr", sky())
    fine = 24 if quick else 96
    arc = [(math.sin(t), t) for t in np.linspace(0.05, 1.6, fine)]
    profiles = {
        "cup": [(0.3 + 0.2 * s, 0.9 * t / 1.6) for s, t in arc],
        "bowl": [(0.7 * s, 0.5 * (1 - math.cos(t))) for s, t in arc],
        "bottle": [(0.28 if t < 1.0 else 0.28 - 0.18 * (t - 1.0) / 0.6, 1.2 * t) for _, t in arc],
    }
    for name, profile in profiles.items():
        lathe(directory / (name + ".ply"), profile, 2 * fine)

    numbers = random.Random(SEED)
    known = materials()
    parts = [f'<scene version="3.0.0">\n<integrator type="path"/>\n'
             '<sensor type="perspective"><float name="fov" value="62"/>'
             '<transform name="to_world"><lookat origin="1.5, 1.7, 2.4" target="-0.3, 1.1, -1" up="0, 1, 0"/></transform>'
             f'<film type="hdrfilm"><integer name="width" value="{width}"/><integer name="height" value="{height}"/>'
             '<rfilter type="box"/></film><sampler type="independent"><integer name="sample_count" value="16"/></sampler></sensor>\n'
             '<emitter type="envmap"><string name="filename" value="sky.exr"/></emitter>\n']  # fmt: skip
    parts += [text.replace("<bsdf ", f'<bsdf id="{name}" ', 1) + "\n" for name, text in known.items()]

    # The room, with a window on the left; then counters and shelves.
    parts += [shape("rectangle", "tiles0", scaled(2.5, 2.5, 1), turned("x", -90)),
              shape("rectangle", "wood3", scaled(2.5, 2.5, 1), turned("x", 90), at(0, 3, 0)),
              shape("rectangle", "tiles2", scaled(2.5, 1.5, 1), at(0, 1.5, -2.5)),
              shape("rectangle", "cloth4", scaled(2.5, 1.5, 1), turned("y", -90), at(2.5, 1.5, 0)),
              shape("rectangle", "cloth5", scaled(2.5, 1.5, 1), turned("y", 180), at(0, 1.5, 2.5)),
              shape("rectangle", "bumpy", scaled(2.5, 0.45, 1), turned("y", 90), at(-2.5, 0.45, 0)),
              shape("rectangle", "bumpy", scaled(2.5, 0.25, 1), turned("y", 90), at(-2.5, 2.75, 0)),
              shape("rectangle", "pane", scaled(2.5, 0.8, 1), turned("y", 90), at(-2.45, 1.7, 0)),
              shape("cube", "wood0", scaled(2.4, 0.45, 0.35), at(0, 0.45, -2.1)),
              shape("cube", "dented", scaled(2.4, 0.02, 0.38), at(0, 0.92, -2.08)),
              shape("cube", "wood1", scaled(0.8, 0.03, 0.5), at(0.1, 0.75, -0.2)),
              shape("cylinder", "metal0", scaled(0.06, 0.06, 0.72), turned("x", -90), at(0.1, 0, -0.2))]  # fmt: skip
    parts += [shape("cube", f"wood{1 + i}", scaled(2.0, 0.02, 0.18), at(0.3, 1.5 + 0.55 * i, -2.3)) for i in range(2)]

    surfaces = [f"glaze{i}" for i in range(PLASTICS)] + [f"metal{i}" for i in range(METALS)] + [f"paint{i}" for i in range(PRINCIPLED)]
    surfaces += ["tiles1", "tiles3", "frosted", "glass", "cloth0", "cloth1", "cloth2", "cloth3"]
    groups = {}
    for row, (y, z) in enumerate(((0.94, -2.0), (1.52, -2.3), (2.07, -2.3))):
        for i in range(20):
            size = 0.13 + 0.05 * numbers.random()
            name, material = numbers.choice(list(profiles)), surfaces[(7 * i + 5 * row) % len(surfaces)]
            group = f"{name}-{material}"
            groups[group] = (f'<shape type="shapegroup" id="{group}"><shape type="ply"><string name="filename" '
                             f'value="{name}.ply"/><ref id="{material}"/></shape></shape>\n')  # fmt: skip
            parts.append(f'<shape type="instance"><ref id="{group}"/>' +
                         move(scaled(size, size, size), turned("y", 360 * numbers.random()), at(-1.6 + 0.19 * i, y, z)) + "</shape>\n")  # fmt: skip
    parts += groups.values()
    parts.append('<shape type="shapegroup" id="leaf-group">' + shape("rectangle", "leaf", scaled(0.12, 0.2, 1)) + "</shape>\n")
    for plant in range(4):
        for i in range(40):
            parts.append('<shape type="instance"><ref id="leaf-group"/>' +
                         move(turned("x", 90 * numbers.random() - 30), turned("y", 360 * numbers.random()),
                              at(-1.9 + 0.25 * numbers.random(), 0.5 + 0.9 * numbers.random(), -1.2 + 0.9 * plant)) +
                         "</shape>\n")  # fmt: skip
    parts.append(shape("sphere", "glass", scaled(0.18, 0.18, 0.18), at(0.3, 0.97, -0.1)))
    (directory / "kitchen.xml").write_text("".join(parts) + "</scene>\n")


def sky():
    """A gradient with a soft sun, low on the side of the window."""
    height, width = 64, 128
    elevation = math.pi * (0.5 - (np.arange(height) + 0.5) / height)[:, None, None]
    azimuth = 2 * math.pi * ((np.arange(width) + 0.5) / width)[None, :, None]
    sun = np.cos(elevation) * math.cos(0.5) * np.cos(azimuth - 4.7) + np.sin(elevation) * math.sin(0.5)
    glow = 40 * np.exp(-60 * (1 - sun)) + 2 * np.exp(-4 * (1 - sun))
    base = np.asarray((0.6, 0.75, 1.0)) * (0.6 + 0.4 * np.exp(-2 * np.abs(elevation)))
    colors = np.where(elevation > 0, base + glow * np.asarray((1.0, 0.85, 0.6)), 0.15)
    colors[0], colors[-1] = colors[0].mean(axis=0), colors[-1].mean(axis=0)
    return colors
