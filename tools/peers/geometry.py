# SPDX-License-Identifier: MIT
"""What renderers need that take neither rectangles nor the steps of transforms.

Conventions of description.py: y is up, faces are counter-clockwise seen from the front, matrices act on columns.
"""

import math

import numpy as np


def steps_matrix(steps):
    result = np.eye(4)
    for step in steps:
        one = np.eye(4)
        if step[0] == "translate":
            one[:3, 3] = step[1]
        elif step[0] == "scale":
            one[:3, :3] = np.diag(step[1])
        else:  # Rodrigues
            axis = np.array(step[1], dtype=float) / np.linalg.norm(step[1])
            angle = math.radians(step[2])
            k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
            one[:3, :3] += math.sin(angle) * k + (1 - math.cos(angle)) * (k @ k)
        result = one @ result  # the first step is applied first
    return result


def rectangle(shape):
    """Positions and uvs of the corners. Width runs along x, projected onto the plane, or along z."""
    normal = np.array(shape.normal, dtype=float)
    normal /= np.linalg.norm(normal)
    along = np.array([1.0, 0.0, 0.0]) - normal * normal[0]
    along = along / np.linalg.norm(along) if np.linalg.norm(along) > 1e-6 else np.array([0.0, 0.0, 1.0])
    across = np.cross(normal, along)
    uvs = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    corners = [np.array(shape.center) + along * shape.width * (u - 0.5) + across * shape.height * (v - 0.5) for u, v in uvs]
    return [tuple(map(float, corner)) for corner in corners], uvs


def write_ply(path, mesh):
    """Binary; LuxCore reads no other kind of mesh."""
    columns = [np.array(mesh.positions, dtype="<f4")]
    names = ["x", "y", "z"]
    if mesh.uvs:
        columns.append(np.array(mesh.uvs, dtype="<f4"))
        names += ["s", "t"]
    triangles = np.array([(f[0], f[i], f[i + 1]) for f in mesh.faces for i in range(1, len(f) - 1)], dtype="<i4")
    records = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    records["count"] = 3
    records["corners"] = triangles
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh.positions)}"]
    head += [f"property float {name}" for name in names]
    head += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(head).encode())
        file.write(np.hstack(columns).tobytes())
        file.write(records.tobytes())
