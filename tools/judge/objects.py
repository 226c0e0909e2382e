# SPDX-License-Identifier: MIT
"""What the scenes of scenes.py are made of: meshes, images, materials, lamps."""

import math

from description import Bsdf, Light, Mesh, Image, Shape


def octahedron():
    """Without normals: faceted. Its corners lie at 1 from the origin."""
    p = [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    faces = [(2, 4, 0), (2, 0, 5), (2, 5, 1), (2, 1, 4), (3, 0, 4), (3, 5, 0), (3, 1, 5), (3, 4, 1)]
    return Mesh("octahedron", p, faces)


def cube():
    """[-1, 1]^3, faces of four corners."""
    p = [(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return Mesh("cube", p, quads)


def dome():
    """A shallow cap with the normals of its sphere: smooth, and hardly a difference to the facets."""
    positions, normals, faces = [], [], []
    rings, sectors, angle, radius = 6, 16, 50.0, 1.5
    for i in range(rings + 1):
        for j in range(sectors):
            theta = math.radians(angle) * i / rings
            phi = 2 * math.pi * j / sectors
            n = (math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi))
            n = tuple(round(x, 6) for x in n)
            normals.append(n)
            positions.append(tuple(round(radius * x, 6) for x in n))
    for i in range(rings):
        for j in range(sectors):
            a, b = i * sectors + j, i * sectors + (j + 1) % sectors
            c, d = a + sectors, b + sectors
            faces += [(a, d, c)] if i == 0 else [(a, b, d), (a, d, c)]
    return Mesh("dome", positions, faces, normals)


def sheet():
    """Two triangles with a bend and texture coordinates that are neither square nor within [0, 1]."""
    p = [(-1.2, 0.0, 0.5), (1.2, 0.0, 0.7), (1.1, 1.8, -0.4), (-1.3, 1.6, -0.6)]
    return Mesh("sheet", p, [(0, 1, 2), (0, 2, 3)], None, [(0.0, 0.0), (1.7, 0.1), (1.5, 1.3), (-0.3, 1.1)])


def panel():
    """A lamp that faces down: three triangles of different sizes."""
    p = [(-0.8, 0.0, -0.5), (0.8, 0.0, -0.5), (0.8, 0.0, 0.5), (-0.8, 0.0, 0.5), (0.3, 0.0, 0.5)]
    return Mesh("panel", p, [(0, 1, 2), (0, 2, 4), (0, 4, 3)])


PAINTING = Image(
    "painting",
    [
        [(0.9, 0.1, 0.1), (0.1, 0.7, 0.2), (0.2, 0.2, 0.9), (0.8, 0.8, 0.1)],
        [(0.1, 0.1, 0.1), (0.6, 0.3, 0.7), (0.5, 0.5, 0.5), (0.1, 0.8, 0.8)],
        [(0.3, 0.9, 0.4), (0.9, 0.6, 0.1), (0.05, 0.3, 0.6), (0.95, 0.95, 0.9)],
    ],
)


def sky_rows():
    """Brighter above than below, a bright patch on one side, no two pixels the same."""
    rows = []
    for y in range(4):
        row = []
        for x in range(8):
            base = 0.9 - 0.2 * y
            glow = 4.0 if (x, y) in ((1, 1), (2, 1)) else 0.0
            row.append((base + glow + 0.04 * x, base + 0.8 * glow + 0.03 * (7 - x), base * 1.2 + 0.5 * glow))
        rows.append([tuple(round(v, 4) for v in pixel) for pixel in row])
    return rows


SKY = Image("sky", sky_rows())


def diffuse(*color):
    return Bsdf("diffuse", {"albedo": tuple(map(float, color)) if len(color) == 3 else color[0]})


GREY = diffuse(0.5, 0.5, 0.5)
MIRROR = Bsdf("mirror")


def dielectric(interior=1.5, exterior=1.0):
    return Bsdf("dielectric", {"intIOR": interior, "extIOR": exterior})


def microfacet(alpha, kd, interior=1.5, exterior=1.0):
    return Bsdf("microfacet", {"alpha": alpha, "intIOR": interior, "extIOR": exterior, "kd": kd})


def metal(alpha, r0=(1.0, 1.0, 1.0)):
    return Bsdf("roughconductor", {"alpha": alpha, "R0": r0})


def frosted(alpha, interior=1.5, exterior=1.0, ka=(1.0, 1.0, 1.0)):
    return Bsdf("roughdielectric", {"alpha": alpha, "intIOR": interior, "extIOR": exterior, "ka": ka})


def substrate(alpha, kd, interior=1.5, exterior=1.0):
    return Bsdf("roughsubstrate", {"alpha": alpha, "intIOR": interior, "extIOR": exterior, "kd": kd})


def phong(kd, ks, exponent):
    return Bsdf(
        "phong", {"diffuse-coefficients": kd, "specular-coefficients": ks, "exponent": exponent}
    )


def floor(bsdf=None):
    return Shape(
        "rectangle", bsdf or diffuse(0.6, 0.5, 0.4), center=(0.0, 0.0, 0.0), width=9.0, height=8.0, normal=(0, 1, 0)
    )


def ball(bsdf, center=(0.0, 1.0, 0.0), radius=1.0):
    return Shape("sphere", bsdf, center=center, radius=radius)


def gem(bsdf, turn=25.0):
    return Shape(
        "mesh", bsdf, mesh=octahedron(), steps=[("rotate", (0, 1, 0), turn), ("translate", (0.0, 1.05, 0.0))]
    )


def board(bsdf):
    """A rectangle that leans back and faces the camera."""
    return Shape("rectangle", bsdf, center=(0.0, 1.0, -0.3), width=2.4, height=1.8, normal=(0.2, 0.5, 1.0))


def rectangle_lamp(radiance=(6.0, 5.0, 4.0)):
    return Shape(
        "rectangle", GREY, center=(1.2, 3.6, 1.0), width=1.8, height=1.4, normal=(-0.3, -1.0, -0.2), radiance=radiance
    )


def sphere_lamp(radiance=(9.0, 10.0, 12.0)):
    return Shape("sphere", GREY, center=(-1.8, 2.9, 1.2), radius=0.6, radiance=radiance)


def mesh_lamp(radiance=(8.0, 9.0, 7.0)):
    steps = [("scale", (1.2, 1.0, 1.3)), ("rotate", (1, 0, 0), -15.0), ("translate", (0.3, 3.4, 0.6))]
    return Shape("mesh", GREY, mesh=panel(), steps=steps, radiance=radiance)


def point_light(position=(1.5, 3.5, 2.5), intensity=(20.0, 22.0, 25.0)):
    return Light("point", intensity, position=position)


def sun(towards=(1.0, 2.0, 1.5), irradiance=(3.0, 2.8, 2.5)):
    return Light("directional", irradiance, towards=towards)


def sky(*radiance):
    return Light("environment", tuple(map(float, radiance)))


def painted_sky(factor=(1.0, 1.0, 1.0)):
    return Light("environment", factor, image=SKY)
