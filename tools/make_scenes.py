#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the meshes and the images that the scenes in scenes/ use.

    tools/make_scenes.py            write every file
    tools/make_scenes.py --check    write nothing; exit 1 if a file is missing or differs

Everything is computed here from a few numbers, with nothing but the standard library, and is the same on every run.

Conventions. The y axis points up; units are arbitrary. Faces are counter-clockwise seen from outside, so their normals
point out of solids, into rooms, and from a lamp to what it lights. Curved meshes carry vertex normals, flat ones none.
Sizes that two parts of a scene must agree on (a glass and its water) are given once.
"""

import argparse
import math
import pathlib
import sys

import gallery_parts
from scene_parts import (add, backdrop, box, combine, cross, dusk, extrude, from_above, glaze, hdr, image, normalize,
                         png, png_content, quad, revolve, rounded, scale, smoothstep, sphere, spline, subtract, tube,
                         upright_box, wood)

SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"


# ---------------------------------------------------------------------------------------------------------------------
# The scenes' files: path below scenes/ -> bytes

def room(half_width, height, half_depth):
    """Five walls that face inwards, open towards +z: the white ones, the left one, the right one."""
    x, y, z = half_width, height, half_depth
    white = combine(quad((-x, 0, z), (x, 0, z), (x, 0, -z), (-x, 0, -z)),
                    quad((-x, y, z), (-x, y, -z), (x, y, -z), (x, y, z)),
                    quad((-x, 0, -z), (x, 0, -z), (x, y, -z), (-x, y, -z)))
    left = quad((-x, 0, z), (-x, 0, -z), (-x, y, -z), (-x, y, z))
    right = quad((x, 0, -z), (x, 0, z), (x, y, z), (x, y, -z))
    return white, left, right


def ceiling_lamp(half_width, height, half_depth):
    """A rectangle that shines downwards."""
    x, z = half_width, half_depth
    return quad((-x, height, z), (-x, height, -z), (x, height, -z), (x, height, z))


def common():
    return {"sphere": sphere(64, 128), "backdrop": backdrop(8, 5, 12, 3, 14),
            "unit_square": quad((-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0))}


def cbox():
    white, left, right = room(1.3, 2, 1.2)
    return {"white": white, "left": left, "right": right, "lamp": ceiling_lamp(0.4, 1.99, 0.3)}


def hw4():
    white, left, right = room(1, 2, 1)
    return {
        "white": white, "left": left, "right": right,
        "tall_box": upright_box((-0.36, 0.6, -0.32), (0.56, 1.2, 0.56), 18),
        "short_box": upright_box((0.36, 0.29, 0.34), (0.58, 0.58, 0.58), -20),
    }


def veach_mi():
    """Four plates, each tilted so that the camera sees the middle of the row of lamps mirrored in its centre."""
    camera, lamps = (0, 3.2, 13), (0, 3.6, -2.4)
    meshes = {}
    for k, centre in enumerate(((0, 2.05, -1.7), (0, 1.3, -0.6), (0, 0.75, 0.9), (0, 0.4, 2.7))):
        normal = normalize(add(normalize(subtract(camera, centre)), normalize(subtract(lamps, centre))))
        x = (1, 0, 0)
        meshes[f"plate{k + 1}"] = box(centre, scale(x, 3.1), scale(normal, 0.03), scale(cross(x, normal), 0.58))
    return meshes


def glass_of_water():
    """Three surfaces that meet in the water line: glass against air, water against air, glass against water."""
    outer, inner, top, base, water, fillet = 0.30, 0.275, 0.92, 0.09, 0.66, 0.06
    taper = 0.05  # the glass is that much narrower at its foot

    def wall(radius, y):
        return radius - taper * (1 - y / top)

    segments = 96
    outside = [(0, 0, 0), (wall(outer, 0), 0, 0.035), (wall(outer, top), top, 0.0115), (wall(inner, top), top, 0.0115)]
    inside = [(wall(inner, base), base, fillet), (0, base, 0)]
    # The wall is straight between the rim and the fillet, so both halves can end at the water line on their own.
    line = (wall(inner, water), water, 0)
    return {
        "glass_air": revolve(rounded(outside + [line]), segments),
        "water_air": revolve(rounded([line, (0, water, 0)]), segments),
        "glass_water": revolve(rounded(inside[::-1] + [line]), segments),
    }


def teapot():
    """One opaque mesh of four parts that run into each other: body, lid, handle and hollow spout."""
    body = revolve(spline([(0, 0.0), (0.30, 0.0), (0.34, 0.025), (0.46, 0.18), (0.50, 0.34), (0.43, 0.52),
                           (0.29, 0.62), (0.265, 0.645)], 7), 72)
    lid = revolve(spline([(0.285, 0.64), (0.285, 0.655), (0.25, 0.68), (0.13, 0.725), (0.05, 0.75), (0.036, 0.775),
                          (0.07, 0.81), (0.075, 0.845), (0.045, 0.875), (0, 0.882)], 6), 56)
    grip = spline([(-0.37, 0.56), (-0.56, 0.61), (-0.73, 0.54), (-0.74, 0.38), (-0.62, 0.24), (-0.44, 0.17)], 8)
    handle = tube([(p, 0.036) for p in grip], 20)
    way = spline([(0.38, 0.20), (0.55, 0.24), (0.66, 0.40), (0.72, 0.54), (0.80, 0.62)], 8)
    width = [0.115 - 0.075 * smoothstep(0, 0.85, k / (len(way) - 1)) for k in range(len(way))]
    walls = list(zip(way, width))
    lining = [(p, 0.75 * r) for p, r in reversed(walls)]
    spout = tube(walls + lining[:12], 24)
    return combine(body, lid, handle, spout)


def table():
    top = revolve(rounded([(0, -0.12, 0), (2.2, -0.12, 0.05), (2.2, 0, 0.05), (0, 0, 0)]), 128, from_above(5))
    # Out along the outside of the straw, over the rim, and back down the inside; the dense rings keep the rim sharp.
    straw = tube([((0, y, 1, 0), 0.022) for y in (0.0, 1.076, 1.079)] + [((0, 1.08, 1, 0), 0.0195)] +
                 [((0, y, 1, 0), 0.017) for y in (1.079, 1.076, 0.0)], 24)
    return {"table_top": top, "teapot": teapot(), "straw": straw, **glass_of_water()}


def plumb_bob():
    """The instrument that the project is named after: a brass body, a steel point, a cord. Its tip is the origin."""
    point = revolve(spline([(0, 0.0), (0.012, 0.03), (0.062, 0.19)], 8) +
                    rounded([(0.062, 0.19, 0), (0.07, 0.20, 0.004), (0.07, 0.225, 0)], 3), 64)
    body = revolve(rounded([(0.06, 0.225, 0), (0.085, 0.225, 0.006), (0.085, 0.25, 0)], 3) +
                   spline([(0.085, 0.25), (0.16, 0.40), (0.245, 0.60), (0.265, 0.74), (0.225, 0.86), (0.14, 0.93)], 8) +
                   rounded([(0.14, 0.93, 0), (0.10, 0.945, 0), (0.10, 0.975, 0.006), (0.135, 0.975, 0.012),
                            (0.135, 1.07, 0.012), (0.075, 1.075, 0.01), (0.05, 1.14, 0.01), (0.0, 1.15, 0)], 4), 80)
    strands = []
    for k in range(241):  # a twisted cord: a tube whose radius and centre wobble along the way
        y = 1.13 + 4.0 * k / 240
        strands.append(((0.004 * math.sin(30 * y), y, 1, 0), 0.0145 + 0.003 * math.sin(60 * y)))
    return {"bob_point": point, "bob_body": body, "cord": tube(strands, 12)}


def vase():
    """A painted vase: the foot, up the outside, over the rim, and down the inside as far as one can see."""
    profile = (rounded([(0.0, 0.0, 0), (0.21, 0.0, 0)]) +
               spline([(0.21, 0.0), (0.31, 0.13), (0.39, 0.33), (0.39, 0.54), (0.29, 0.77), (0.165, 0.92), (0.155, 1.0),
                       (0.205, 1.065)], 7) +
               rounded([(0.205, 1.065, 0), (0.205, 1.085, 0.0085), (0.187, 1.085, 0.0085), (0.187, 1.065, 0)], 4) +
               spline([(0.187, 1.065), (0.138, 1.0), (0.148, 0.92), (0.25, 0.78)], 4))
    return revolve(profile, 72, lambda turn, p: (turn, p[1] / 1.085))


def interesting():
    desk = extrude(rounded([(-6, 0, 0), (10, 0, 0)]), 9, from_above(6))
    ring = revolve(rounded([(0.40, 0.0, 0), (0.43, 0.0, 0.012), (0.43, 0.10, 0.012), (0.40, 0.10, 0.012),
                            (0.40, 0.0, 0)], 4), 128)
    target = revolve(rounded([(0.0, 0.0, 0), (0.46, 0.0, 0), (0.46, 0.05, 0.012), (0.0, 0.05, 0)], 4), 96,
                     from_above(1))
    plinth = revolve(rounded([(0, 0, 0), (0.36, 0, 0), (0.36, 0.16, 0.02), (0, 0.16, 0)], 4), 64)
    return {"desk": desk, "ring": ring, "target": target, "vase": vase(), "plinth": plinth, **plumb_bob()}


def all_files():
    files = {}
    for directory in (common, cbox, veach_mi, table, hw4, interesting):
        for name, mesh in directory().items():
            files[f"{directory.__name__}/meshes/{name}.obj"] = mesh.to_obj()
    files["common/textures/wood.png"] = png(image(320, 320, wood))
    files["interesting/textures/glaze.png"] = png(image(384, 192, glaze))
    files["interesting/textures/dusk.hdr"] = hdr(image(256, 128, dusk))
    files |= {f"gallery/{name}": data for name, data in gallery_parts.files().items()}
    return files


def main():
    parser = argparse.ArgumentParser(description="Writes the meshes and the images that the scenes in scenes/ use.")
    parser.add_argument("--check", action="store_true", help="compare with the files on disk and write nothing")
    check = parser.parse_args().check
    differing = []
    for name, data in all_files().items():
        path = SCENES / name
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        elif not path.is_file():
            differing.append(f"{path}: missing")
        elif path.read_bytes() != data:
            if not (name.endswith(".png") and png_content(path.read_bytes()) == png_content(data)):
                differing.append(f"{path}: differs from what tools/make_scenes.py writes")
    print("\n".join(differing), end="\n" if differing else "", file=sys.stderr)
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
