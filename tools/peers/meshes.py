# SPDX-License-Identifier: MIT
"""The meshes of the bench's scenes, which belong to no renderer. Standard library only.

Conventions of description.py: y is up, faces are counter-clockwise seen from the front.
"""

import math

from description import Mesh


def ball(name, rows):
    """A unit sphere of flat triangles, as large in area as the round one."""
    columns = 2 * rows
    positions = [(0.0, 1.0, 0.0), (0.0, -1.0, 0.0)]
    for i in range(1, rows):
        theta = math.pi * i / rows
        for j in range(columns):
            phi = 2 * math.pi * j / columns
            positions.append((math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)))
    faces = []
    for j in range(columns):
        a, b = 2 + j, 2 + (j + 1) % columns
        faces.append((0, b, a))
        for _ in range(rows - 2):
            c, d = a + columns, b + columns
            faces += [(a, b, c), (b, d, c)]
            a, b = c, d
        faces.append((1, a, b))
    size = math.sqrt(4.0 * math.pi / sum(area(*(positions[i] for i in face)) for face in faces))
    return Mesh(name, [tuple(round(size * x, 6) for x in p) for p in positions], faces)


def area(a, b, c):
    x, y = [[q - p for p, q in zip(a, corner)] for corner in (b, c)]
    return 0.5 * math.hypot(x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0])


def waves(name, triangles):
    """A unit sphere with waves, so that rays scatter, of about so many flat triangles."""
    rows = max(3, round(math.sqrt(triangles / 4)))
    columns = 2 * rows
    turns = [(math.cos(2 * math.pi * j / columns), math.sin(2 * math.pi * j / columns), math.cos(22 * math.pi * j / columns))
             for j in range(columns)]  # fmt: skip
    positions, faces = [], []
    for i in range(rows + 1):
        theta = math.pi * (i + 1e-3) / (rows + 2e-3)
        height, sine, wave = math.cos(theta), math.sin(theta), 0.03 * math.sin(9 * theta)
        for x, z, across in turns:
            r = 0.97 + wave * across
            positions.append((round(r * sine * x, 6), round(r * height, 6), round(r * sine * z, 6)))
    for i in range(rows):
        for j in range(columns):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            faces += [(a, b, a + columns), (b, b + columns, a + columns)]
    return Mesh(name, positions, faces)


def read_flat_obj(name, path):
    """An OBJ without its normals: shading normals are where renderers differ."""
    positions, uvs, corners, vertices, faces = [], [], {}, [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            positions.append(tuple(map(float, words[1:4])))
        elif words[0] == "vt":
            uvs.append(tuple(map(float, words[1:3])))
        elif words[0] == "f":
            face = []
            for word in words[1:]:
                place, uv = (word.split("/") + [""])[:2]
                key = (int(place), int(uv) if uv else 0)
                face.append(corners.setdefault(key, len(corners)))
                if len(vertices) < len(corners):
                    vertices.append(key)
            faces += [(face[0], face[i], face[i + 1]) for i in range(1, len(face) - 1)]  # flat in every renderer
    has_uvs = all(uv for _, uv in vertices)
    return Mesh(name, [positions[p - 1] for p, _ in vertices], faces, None, [uvs[t - 1] for _, t in vertices] if has_uvs else None)
