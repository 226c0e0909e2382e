# SPDX-License-Identifier: MIT
"""The scenes of the bench, in the words of tools/judge/description.py.

Materials are those that all renderers have with the same meaning: diffuse, mirror, smooth glass, and metal with
Beckmann microfacets that reflects all light; facets are flat, lamps are black. Where a renderer lacks one, or means
something else by it, `left_out` says why.
"""

import math
import random
from dataclasses import dataclass, field
from pathlib import Path

import meshes
import mitsuba_files
from description import Camera, Light, Mesh, Image, Scene, Shape
from objects import MIRROR, cube, dielectric, diffuse, metal

ROOT = Path(__file__).resolve().parent.parent.parent
SCENES = ROOT / "scenes"

BLACK = diffuse(0.0, 0.0, 0.0)
WHITE = diffuse(0.73, 0.73, 0.73)
NO_BECKMANN = "LuxCore has no Beckmann metal"


@dataclass
class BenchScene:
    scene: Scene
    left_out: dict = field(default_factory=dict)  # renderer: reason
    write: object = None  # of a file of Mitsuba's: (directory, width, height, quick) writes it; `scene` has its name alone


def panel(center, normal, width, height, bsdf, radiance=None):
    return Shape("rectangle", bsdf, center=center, normal=normal, width=width, height=height, radiance=radiance)


def box_walls():
    """Two units wide, open towards the camera."""
    return [
        panel((0.0, 0.0, 0.0), (0, 1, 0), 2.0, 2.0, WHITE),
        panel((0.0, 2.0, 0.0), (0, -1, 0), 2.0, 2.0, WHITE),
        panel((0.0, 1.0, -1.0), (0, 0, 1), 2.0, 2.0, WHITE),
        panel((-1.0, 1.0, 0.0), (1, 0, 0), 2.0, 2.0, diffuse(0.63, 0.065, 0.05)),
        panel((1.0, 1.0, 0.0), (-1, 0, 0), 2.0, 2.0, diffuse(0.14, 0.45, 0.091)),
        panel((0.0, 1.98, 0.0), (0, -1, 0), 0.5, 0.4, BLACK, (17.0, 12.0, 6.0)),
    ]


BOX_CAMERA = {"origin": (0.0, 1.0, 4.4), "target": (0.0, 1.0, 0.0), "fov": 36.0}


def block(size, angle, center):
    steps = [("scale", size), ("rotate", (0, 1, 0), angle), ("translate", center)]
    return Shape("mesh", WHITE, mesh=cube(), steps=steps)


def sphere(bsdf, mesh, radius, center, radiance=None):
    steps = [("scale", (radius,) * 3), ("translate", center)]
    return Shape("mesh", bsdf, mesh=mesh, steps=steps, radiance=radiance)


def cornell_box(camera, quick):
    blocks = [block((0.3, 0.6, 0.3), 17.0, (-0.35, 0.6, -0.3)), block((0.3, 0.3, 0.3), -18.0, (0.35, 0.3, 0.35))]
    return BenchScene(Scene("cornell-box", box_walls() + blocks, camera=camera(**BOX_CAMERA), what="Cornell box"))


def cornell_glass(camera, quick):
    fine = meshes.ball("ball-fine", 128)
    balls = [sphere(MIRROR, fine, 0.4, (-0.45, 0.4, -0.35)), sphere(dielectric(1.5), fine, 0.4, (0.45, 0.4, 0.3))]
    return BenchScene(Scene("cornell-glass", box_walls() + balls, camera=camera(**BOX_CAMERA), what="Cornell box, glass and mirror"))


def veach(camera, quick):
    lamp = meshes.ball("ball-coarse", 8)
    shapes = [
        sphere(BLACK, lamp, 0.04, (-2.7, 3.6, -2.4), (1000.0, 600.0, 380.0)),
        sphere(BLACK, lamp, 0.12, (-1.05, 3.6, -2.4), (92.0, 76.0, 34.0)),
        sphere(BLACK, lamp, 0.3, (0.75, 3.6, -2.4), (8.6, 13.2, 10.4)),
        sphere(BLACK, lamp, 0.7, (2.9, 3.6, -2.4), (1.35, 2.15, 4.2)),
        panel((0.0, 12.0, 10.0), (0.0, -0.8, -0.6), 8.0, 5.0, BLACK, (8.0, 8.0, 8.5)),
        Shape("mesh", diffuse(0.4, 0.4, 0.4), mesh=meshes.read_flat_obj("backdrop", SCENES / "common/meshes/backdrop.obj")),
    ]
    for i, alpha in enumerate((0.005, 0.02, 0.06, 0.14), 1):
        plate = meshes.read_flat_obj(f"plate{i}", SCENES / f"veach_mi/meshes/plate{i}.obj")
        shapes.append(Shape("mesh", metal(alpha), mesh=plate))
    view = camera(origin=(0.0, 3.2, 13.0), target=(0.0, 1.7, 0.0), fov=38.0)
    return BenchScene(Scene("veach-mi", shapes, camera=view, what="Veach's plates"), {"luxcore": NO_BECKMANN})


def wood():
    """Rings of a trunk, cut along it."""
    rows = []
    for y in range(64):
        row = []
        for x in range(64):
            ring = 6.0 * math.hypot(x / 64 - 0.3, 0.15 * math.sin(y / 9.0) + 0.4)
            light = 0.6 + 0.4 * (ring - math.floor(ring))
            row.append(tuple(round(light * c, 4) for c in (0.55, 0.33, 0.17)))
        rows.append(row)
    return Image("wood", rows)


def table(camera, quick):
    def part(name, bsdf, *steps):
        return Shape("mesh", bsdf, mesh=meshes.read_flat_obj(name, SCENES / f"table/meshes/{name}.obj"), steps=list(steps))

    glass = ("translate", (-0.5, 0.002, 0.3))
    backdrop = meshes.read_flat_obj("backdrop", SCENES / "common/meshes/backdrop.obj")
    shapes = [
        panel((-2.6, 2.6, -1.8), (2.2, -2.3, 1.7), 2.0, 2.0, BLACK, (20.0, 16.0, 11.5)),
        panel((0.5, 5.0, 1.0), (0, -1, 0), 4.0, 3.0, BLACK, (4.8, 5.6, 6.6)),
        Shape("mesh", diffuse(0.42, 0.46, 0.5), mesh=backdrop, steps=[("translate", (0.0, -1.6, 0.0))]),
        part("table_top", diffuse(wood())),
        part("teapot", diffuse(0.03, 0.2, 0.22), ("rotate", (0, 1, 0), -25.0), ("translate", (0.45, 0.002, -0.3))),
        part("glass_air", dielectric(1.5), glass),
        part("water_air", dielectric(1.33), glass),
        part("glass_water", dielectric(1.33, 1.5), glass),
        part("straw", diffuse(0.75, 0.1, 0.06), ("rotate", (0, 0, 1), -27.0), ("translate", (-0.668, 0.112, 0.3))),
    ]
    view = camera(origin=(-0.35, 1.75, 3.9), target=(0.1, 0.42, 0.0), fov=33.0)
    return BenchScene(Scene("table", shapes, camera=view, what="Teapot and a glass of water"))


def sky():
    """A blue gradient with a glow around a low sun, dark below the horizon. The rows at the poles are alike all around."""
    rows = []
    for y in range(64):
        elevation = math.pi * (0.5 - (y + 0.5) / 64)
        row = []
        for x in range(128):
            azimuth = 2 * math.pi * (x + 0.5) / 128
            if elevation < 0.0:
                row.append((0.12, 0.1, 0.08))
                continue
            sun = math.cos(elevation) * math.cos(0.45) * math.cos(azimuth - 2.0) + math.sin(elevation) * math.sin(0.45)
            glow = 60.0 * math.exp(-120.0 * (1.0 - sun)) + 1.5 * math.exp(-4.0 * (1.0 - sun))
            base = (0.35 + 0.4 * math.exp(-3 * elevation), 0.5 + 0.3 * math.exp(-3 * elevation), 0.9)
            row.append(tuple(round(b + glow * g, 4) for b, g in zip(base, (1.0, 0.85, 0.6))))
        rows.append(row)
    return Image("sky", rows)


def bricks():
    rows = []
    for y in range(48):
        row = []
        for x in range(48):
            course = y // 8
            joint = y % 8 == 0 or (x + 8 * (course % 2)) % 16 == 0
            tone = 0.8 + 0.2 * math.sin(12.9898 * ((x + 8 * (course % 2)) // 16) + 78.233 * course)
            row.append((0.7, 0.68, 0.62) if joint else tuple(round(tone * c, 4) for c in (0.62, 0.35, 0.25)))
        rows.append(row)
    return Image("bricks", rows)


def room(camera, quick):
    """Four by three by four, with a window in the wall on the right that the sun shines through."""
    brick, plaster = diffuse(bricks()), diffuse(0.75, 0.73, 0.7)
    shapes = [
        panel((0.0, 0.0, 0.0), (0, 1, 0), 4.0, 4.0, diffuse(wood())),
        panel((0.0, 3.0, 0.0), (0, -1, 0), 4.0, 4.0, plaster),
        panel((0.0, 1.5, -2.0), (0, 0, 1), 4.0, 3.0, brick),
        panel((0.0, 1.5, 2.0), (0, 0, -1), 4.0, 3.0, plaster),
        panel((2.0, 1.5, 0.0), (-1, 0, 0), 4.0, 3.0, plaster),
        # The window: -0.8 < z < 0.8, 0.8 < y < 2.4. Width runs along z there.
        panel((-2.0, 0.4, 0.0), (1, 0, 0), 4.0, 0.8, plaster),
        panel((-2.0, 2.7, 0.0), (1, 0, 0), 4.0, 0.6, plaster),
        panel((-2.0, 1.6, -1.4), (1, 0, 0), 1.2, 1.6, plaster),
        panel((-2.0, 1.6, 1.4), (1, 0, 0), 1.2, 1.6, plaster),
        block((0.35, 0.6, 0.35), 25.0, (0.5, 0.6, -0.6)),
        sphere(diffuse(0.3, 0.45, 0.6), meshes.ball("ball-fine", 128), 0.45, (-0.6, 0.45, -0.9)),
    ]
    view = camera(origin=(1.2, 1.6, 1.85), target=(-0.5, 1.2, -1.5), fov=75.0)
    lights = [Light("environment", (1.0, 1.0, 1.0), image=sky())]
    return BenchScene(Scene("room", shapes, lights, camera=view, what="Textured room, environment map through a window"))


def thousand_lights(camera, quick):
    """Small lamps of many powers, colours and directions above a floor with blocks."""
    numbers = random.Random(1)
    lamp = Mesh("lamp", [(-0.5, 0.0, -0.5), (0.5, 0.0, -0.5), (0.5, 0.0, 0.5), (-0.5, 0.0, 0.5)], [(0, 1, 2), (0, 2, 3)])
    shapes = [panel((0.0, 0.0, 0.0), (0, 1, 0), 40.0, 40.0, diffuse(0.6, 0.6, 0.6))]
    for i in range(12):
        x, z = 1.9 * (i % 4) - 2.85, 2.2 * (i // 4) - 2.2
        shapes.append(block((0.3, 0.3 + 0.1 * (i % 3), 0.3), 20.0 * i, (x, 0.3 + 0.1 * (i % 3), z)))
    for i in range(1000):
        color = ((1.0, 0.5, 0.3), (0.4, 0.6, 1.0), (1.0, 0.9, 0.7), (0.5, 1.0, 0.5))[i % 4]
        power = round(4.0 * 30.0 ** numbers.random(), 3)
        size = round(0.05 + 0.05 * numbers.random(), 4)
        turn = round(-70.0 + 140.0 * numbers.random(), 2)
        x, z = 0.3 * (i % 40) - 5.85, 0.45 * (i // 40) - 5.4
        steps = [("scale", (size, 1.0, size)), ("rotate", (round(numbers.random(), 3) + 0.1, 0, round(numbers.random(), 3) + 0.1), turn),
                 ("translate", (round(x, 3), round(1.2 + 0.8 * numbers.random(), 3), round(z, 3)))]  # fmt: skip
        shapes.append(Shape("mesh", BLACK, mesh=lamp, steps=steps, radiance=tuple(power * c for c in color)))
    view = camera(origin=(0.0, 5.5, 9.0), target=(0.0, 0.3, 0.0), fov=50.0)
    return BenchScene(Scene("lights-1000", shapes, camera=view, what="1,000 small mesh lights"))


def large_mesh(camera, quick):
    triangles = 100_000 if quick else 4_000_000
    mesh = Mesh(f"waves-{triangles}", None, None)  # made when it is written
    ball = sphere(diffuse(0.6, 0.6, 0.7), mesh, 0.7, (0.0, 0.75, 0.0))
    what = f"Cornell box, mesh of {triangles:,} triangles"
    return BenchScene(Scene("mesh-4m", box_walls() + [ball], camera=camera(**BOX_CAMERA), what=what))


def kitchen(camera, quick):
    mitsuba_only = "a file of Mitsuba's"
    scene = Scene("kitchen", [], camera=camera(), what="Kitchen in Mitsuba's format: 36 materials, instances, environment map")
    return BenchScene(scene, {"cycles": mitsuba_only, "luxcore": mitsuba_only}, mitsuba_files.kitchen)


MAKERS = {
    "cornell-box": cornell_box,
    "cornell-glass": cornell_glass,
    "veach-mi": veach,
    "table": table,
    "room": room,
    "lights-1000": thousand_lights,
    "mesh-4m": large_mesh,
    "kitchen": kitchen,
}


def make(name, width, height, quick):
    def camera(**more):
        return Camera(width=width, height=height, **more)

    made = MAKERS[name](camera, quick)
    made.scene.max_depth = -1
    return made
