# SPDX-License-Identifier: MIT
"""The files of scenes/gallery: chess pieces, a garden of raked sand; see make_scenes.py for the conventions."""

import math

from scene_parts import (Mesh, add, box, combine, cross, hdr, image, lattice, linear_png, mix, noise, normalize, png, revolve, rounded,
                         scale, smoothstep, spline, subtract)

# ---------------------------------------------------------------------------------------------------------------------
# endgame: a square of the board is one unit wide


def foot(radius):
    """The bottom of every piece: a plate, a step and a hollow."""
    return rounded([(0, 0, 0), (radius, 0, 0.02), (radius, 0.09, 0.035), (0.88 * radius, 0.12, 0.01),
                    (0.88 * radius, 0.16, 0.03), (0.74 * radius, 0.2, 0)], 5)


def collar(y, inner, outer, above):
    return rounded([(inner, y, 0), (outer, y + 0.02, 0.012), (outer, y + 0.06, 0.012), (above, y + 0.085, 0)], 4)


def ball(y, radius, below):
    """From the radius `below` up over a sphere around height y."""
    start = -math.acos(below / radius)
    return [(radius * math.cos(a), y + radius * math.sin(a), math.cos(a), math.sin(a))
            for a in (start + (math.pi / 2 - start) * i / 24 for i in range(25))][:-1] + [(0.0, y + radius, 0.0, 1.0)]


def pawn():
    stem = spline([(0.222, 0.2), (0.15, 0.31), (0.108, 0.47), (0.105, 0.56)], 7)
    return revolve(foot(0.3) + stem + collar(0.56, 0.105, 0.19, 0.1) + ball(0.79, 0.17, 0.1), 56)


def rook():
    stem = spline([(0.252, 0.2), (0.205, 0.32), (0.18, 0.55), (0.185, 0.72)], 7)
    tower = rounded([(0.185, 0.72, 0), (0.27, 0.77, 0.02), (0.27, 1.02, 0.012), (0.2, 1.02, 0.012), (0.2, 0.94, 0.01), (0, 0.94, 0)], 4)
    return revolve(foot(0.34) + stem + tower, 56)


def bishop():
    stem = spline([(0.237, 0.2), (0.16, 0.34), (0.11, 0.6), (0.105, 0.76)], 7)
    head = spline([(0.1, 0.845), (0.165, 0.96), (0.16, 1.08), (0.085, 1.21), (0.04, 1.25)], 8)
    return revolve(foot(0.32) + stem + collar(0.76, 0.105, 0.2, 0.1) + head + ball(1.285, 0.055, 0.04), 56)


def queen():
    stem = spline([(0.266, 0.2), (0.18, 0.36), (0.12, 0.72), (0.115, 1.0)], 8)
    head = spline([(0.115, 1.085), (0.15, 1.25), (0.235, 1.44)], 8)
    rim = rounded([(0.235, 1.44, 0), (0.245, 1.465, 0.008), (0.205, 1.475, 0.008), (0.13, 1.44, 0.02), (0.09, 1.5, 0)], 4)
    return revolve(foot(0.36) + stem + collar(1.0, 0.115, 0.23, 0.115) + head + rim + ball(1.55, 0.075, 0.05), 64)


def king():
    stem = spline([(0.281, 0.2), (0.19, 0.38), (0.13, 0.75), (0.125, 1.06)], 8)
    head = spline([(0.125, 1.145), (0.16, 1.3), (0.225, 1.48)], 8)
    crown = rounded([(0.225, 1.48, 0), (0.235, 1.51, 0.01), (0.15, 1.57, 0.02), (0.06, 1.6, 0.02), (0, 1.6, 0)], 4)
    return revolve(foot(0.38) + stem + collar(1.06, 0.125, 0.24, 0.125) + head + crown, 64)


def faceted(mesh):
    """The same with flat faces."""
    flat = Mesh()
    for face in mesh.faces:
        corners = [mesh.vertices[k][0] for k in face]
        normal = normalize(cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0])))
        first = len(flat.vertices)
        flat.vertices += [(corner, normal, None) for corner in corners]
        flat.faces.append(tuple(range(first, len(flat.vertices))))
    return flat


def cross_of_king():
    return faceted(combine(box((0, 1.69, 0), (0.032, 0, 0), (0, 0.11, 0), (0, 0, 0.032)),
                           box((0, 1.715, 0), (0.09, 0, 0), (0, 0.03, 0), (0, 0, 0.03))))


def board(u, v):
    """Squares of maple and walnut, each from another plank; a1 is dark."""
    x, y = u * 8, v * 8
    i, j = min(int(x), 7), min(int(y), 7)
    dark = (i + j) % 2 == 0
    along, across = (x - i, y - j) if lattice(i, j, 11) < 0.5 else (y - j, x - i)
    offset = 40 * lattice(i, j, 12)
    ring = 0.5 + 0.5 * math.sin(2 * math.pi * (2.5 * across + 1.5 * noise(0.7 * along + offset, 1.6 * across + offset, 4)))
    fibre = noise(3 * along + offset, 26 * across + offset, 5)
    grain = 0.55 * ring ** 2 + 0.45 * fibre
    colour = mix((0.16, 0.075, 0.035), (0.075, 0.033, 0.017), grain) if dark else mix((0.62, 0.43, 0.24), (0.47, 0.30, 0.15), grain)
    gap = smoothstep(0.0, 0.012, min(x - i, 1 - x + i, y - j, 1 - y + j))
    return scale(colour, (0.9 + 0.2 * lattice(i, j, 13)) * (0.35 + 0.65 * gap))


def weave(u, v):
    """Normals of linen: threads that go over and under each other, eight each way."""
    x, y = u * 8, v * 8
    over = (int(x) + int(y)) % 2 == 0
    a, b = x % 1 - 0.5, y % 1 - 0.5
    across, along = (a, b) if over else (b, a)
    tilt, bend = 1.3 * across, 0.5 * along
    n = normalize((tilt, bend, 1.0) if over else (bend, tilt, 1.0))
    return tuple(0.5 + 0.5 * c for c in n)


def window(u, v):
    """A dark room with one tall window of six panes at u = 0.62 and a faint lamp opposite."""
    wall = mix((0.028, 0.023, 0.019), (0.012, 0.011, 0.011), smoothstep(0.3, 0.8, v))
    x, y = (u - 0.62) / 0.055, (v - 0.67) / 0.15
    if abs(x) < 1 and abs(y) < 1:
        bar = min(abs((x + 1) % 1 - 0.5) - 0.5 + 0.5, 1)
        frame = min(abs(abs(x) - 0.0), 1) < 0.06 or min(abs(abs(y) - 1 / 3), 1) < 0.04
        sky = mix((9.0, 9.6, 11.0), (15.0, 16.5, 19.5), smoothstep(-1, 1, y))
        return wall if frame or bar < 0 else sky
    lamp = math.exp(-(((u - 0.13) / 0.02) ** 2 + ((v - 0.6) / 0.03) ** 2))
    return add(wall, scale((5.0, 2.6, 1.0), lamp))


# ---------------------------------------------------------------------------------------------------------------------
# garden


def noise3(p, seed):
    """Smooth value noise in [0, 1) with features one unit large."""
    cell = [math.floor(c) for c in p]
    t = [smoothstep(0, 1, c - i) for c, i in zip(p, cell)]
    total = 0.0
    for corner in range(8):
        bits = [corner >> k & 1 for k in range(3)]
        weight = 1.0
        for k in range(3):
            weight *= t[k] if bits[k] else 1 - t[k]
        total += weight * lattice(*(c + b for c, b in zip(cell, bits)), seed)
    return total


def stone(seed, rings, segments, roughness):
    """A boulder: a sphere with broad facets, cracks and grain. Its lower part lies below the ground."""
    def radius(d):
        r = 1.0
        for k in range(5):  # flat faces, as if it had split there
            n = normalize(tuple(lattice(seed, k, axis, 21) - 0.5 for axis in range(3)))
            along = sum(a * b for a, b in zip(d, n))
            if along > 0:
                r = min(r, (0.74 + 0.16 * lattice(seed, k, 22)) / along)
        bumps = sum((noise3(scale(d, f), seed + f) - 0.5) / f ** 1.1 for f in (2, 4, 8, 16))  # finer ones would miss vertices
        return r * (1 + roughness * bumps)

    points = [[scale(d, radius(d)) for d in (
        (math.cos(a) * math.cos(p), math.sin(a), math.cos(a) * math.sin(p))
        for p in (2 * math.pi * (j % segments) / segments for j in range(segments + 1)))]
        for a in (math.pi * (i / rings - 0.5) for i in range(rings + 1))]
    return closed_grid(points, lambda i, j: (j / segments, i / rings))


def closed_grid(points, uv=None):
    """A mesh over rows of points; each row ends where it begins. uv maps the number of the row and of the point in it to (u, v)."""
    rows = []
    segments = len(points[0]) - 1
    for i, row in enumerate(points):
        before, after = points[max(i - 1, 0)], points[min(i + 1, len(points) - 1)]
        out = []
        for j, p in enumerate(row):
            around = subtract(row[(j + 1) % segments], row[(j - 1) % segments])
            normal = cross(subtract(after[j], before[j]), around)
            up = (0, -1 if i == 0 else 1, 0)  # where a row is a point
            out.append((p, normalize(normal) if math.hypot(*normal) > 1e-9 else up, uv(i, j) if uv else None))
        rows.append(out)
    mesh = Mesh()
    mesh.add_grid(rows)
    return mesh


def granite(u, v):
    """Of a stone: grey with dark grains, and lichen in patches, more of it above."""
    a, p = math.pi * (v - 0.5), 2 * math.pi * u
    d = (math.cos(a) * math.cos(p), math.sin(a), math.cos(a) * math.sin(p))
    tone = 0.6 * noise3(scale(d, 3), 41) + 0.4 * noise3(scale(d, 9), 42)
    grain = smoothstep(0.55, 0.8, noise3(scale(d, 50), 43))
    colour = scale(mix((0.23, 0.215, 0.2), (0.12, 0.12, 0.125), tone), 1 - 0.45 * grain)
    patch = 0.65 * noise3(scale(d, 5), 44) + 0.35 * noise3(scale(d, 19), 45) + 0.1 * d[1]
    return mix(colour, (0.27, 0.27, 0.15), 0.75 * smoothstep(0.58, 0.66, patch))


def leaf():
    """A maple leaf of five lobes, curled up at its edge; its front is above, its stalk behind."""
    segments, rings = 120, 8

    def reach(angle):
        lobe = abs(math.cos(2.5 * angle)) ** 0.8
        ahead = 0.5 + 0.5 * math.cos(angle)  # the lobes in front are the longer ones
        teeth = 1 + 0.06 * math.cos(30 * angle)
        return (0.16 + (0.34 + 0.5 * ahead) * lobe) * teeth * (1 - 0.75 * smoothstep(2.75, 3.14, abs(angle)))

    points = []
    for i in range(rings + 1):
        row = []
        for j in range(segments + 1):
            angle = 2 * math.pi * (j % segments) / segments
            r = reach(math.remainder(angle, 2 * math.pi)) * (1 - i / rings)
            vein = 0.05 * r * abs(math.cos(2.5 * angle))
            row.append((r * math.cos(angle), 0.28 * r * r * (0.6 + 0.4 * math.sin(2 * angle + 1)) - vein, r * math.sin(angle)))
        points.append(row)
    return closed_grid(points)


# Where stones stand in the sand: x, z, and how far the rings around them reach.
STONES = ((-1.5, -1.2, 1.75), (1.9, -2.6, 1.25), (2.5, 0.9, 0.85))


def sand_height(x, z):
    """Raked straight along x, and in rings around the stones."""
    period, depth = 0.16, 0.034
    wobble = 0.03 * (noise(0.5 * x, 0.5 * z, 31) - 0.5)
    phase, flat = z + wobble, 0.0
    for sx, sz, reach in STONES:
        distance = math.hypot(x - sx, z - sz)
        if distance < reach:
            phase = distance + wobble
        flat = max(flat, 1 - smoothstep(0.0, 0.06, abs(distance - reach)))  # a smooth path where the directions meet
    wave = 0.5 - 0.5 * math.cos(2 * math.pi * phase / period)
    height = depth * wave * (1 - flat)
    return height + 0.006 * noise(9 * x, 9 * z, 32)


def sand(u, v):
    """Normals of the raked sand over 10 x 10 units around the origin: u along x, v along -z."""
    x, z, step = 10 * (u - 0.5), 10 * (0.5 - v), 0.004
    dx = (sand_height(x + step, z) - sand_height(x - step, z)) / (2 * step)
    dz = (sand_height(x, z + step) - sand_height(x, z - step)) / (2 * step)
    return tuple(0.5 + 0.5 * c for c in normalize((-dx, dz, 1.0)))


def lantern():
    """A stone lantern of six sides, and the paper in its windows."""
    def hexagon(*profile):
        return faceted(revolve(rounded([(*point, 0) for point in profile]), 6))

    lower = combine(hexagon((0, 0), (0.44, 0), (0.44, 0.1), (0.3, 0.16), (0, 0.16)),
                    hexagon((0, 0.86), (0.24, 0.86), (0.4, 0.96), (0.4, 1.04), (0, 1.04)),
                    hexagon((0, 1.4), (0.36, 1.4), (0.36, 1.44), (0, 1.44)),
                    hexagon((0, 1.44), (0.64, 1.44), (0.66, 1.5), (0.44, 1.58), (0.2, 1.72), (0.09, 1.82), (0, 1.82)))
    posts = combine(*(box((0.31 * math.cos(a), 1.22, 0.31 * math.sin(a)), scale((math.cos(a), 0, math.sin(a)), 0.035), (0, 0.18, 0),
                          scale((-math.sin(a), 0, math.cos(a)), 0.035))
                      for a in (math.pi * k / 3 for k in range(6))))
    round_parts = combine(revolve(spline([(0.19, 0.16), (0.14, 0.3), (0.13, 0.5), (0.14, 0.7), (0.19, 0.86)], 8), 48),
                          revolve([(0.06, 1.8, 1, 0)] + ball(1.9, 0.09, 0.06), 32))
    return {"lantern_flat": combine(lower, faceted(posts)), "lantern_round": round_parts,
            "lantern_paper": faceted(revolve(rounded([(0.27, 1.04, 0), (0.27, 1.4, 0)]), 6))}


def bamboo():
    """A stem of one unit's radius 0.045, 2.2 high, with nodes."""
    profile = []
    y = 0.0
    for k in range(5):
        top = 2.2 * (k + 1) / 5
        profile += rounded([(0.045, y, 0), (0.045, top - 0.03, 0.01), (0.052, top - 0.012, 0.004), (0.041, top, 0.004)], 3)
        y = top
    return revolve(profile, 28)


def files():
    """Path below scenes/gallery -> bytes."""
    meshes = {"pawn": pawn(), "rook": rook(), "bishop": bishop(), "queen": queen(), "king": king(), "cross": cross_of_king()}
    for number in range(3):
        meshes[f"stone{number + 1}"] = stone(number + 5, 72, 128, 0.5)
    meshes |= {**lantern(), "bamboo": bamboo(), "leaf": leaf()}
    result = {f"meshes/{name}.ply": mesh.to_ply() for name, mesh in meshes.items()}
    result["textures/board.png"] = png(image(512, 512, board))
    result["textures/weave.png"] = linear_png(image(64, 64, weave))
    result["textures/granite.png"] = png(image(512, 256, granite))
    result["textures/sand.png"] = linear_png(image(896, 896, sand))
    result["textures/window.hdr"] = hdr(image(256, 128, window))
    return result
