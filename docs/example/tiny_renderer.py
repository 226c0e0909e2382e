#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Stands for your renderer: a diffuse floor below a square light, direct light by light sampling. Python alone.

    tiny_renderer.py -o IMAGE.exr [--seed N] [--spp N] [--albedo A]
"""

import argparse
import math
import random
import struct

WIDTH, HEIGHT = 64, 48
EYE = (0.0, 1.5, 4.0)
FIELD_OF_VIEW = 40.0  # degrees, across
LIGHT_HEIGHT, LIGHT_SIDE, RADIANCE = 2.0, 0.8, 8.0
FLOOR_SIDE = 6.0


def floor_point(x, y):
    """Where the ray through a point of the image meets the floor, or None. The camera looks at the origin."""
    length = math.hypot(EYE[1], EYE[2])
    forward = (0.0, -EYE[1] / length, -EYE[2] / length)
    up = (0.0, EYE[2] / length, -EYE[1] / length)
    half = math.tan(math.radians(FIELD_OF_VIEW) / 2)
    u = (2 * x / WIDTH - 1) * half
    v = (1 - 2 * y / HEIGHT) * half * HEIGHT / WIDTH
    direction = (u, forward[1] + v * up[1], forward[2] + v * up[2])
    if direction[1] >= 0:
        return None
    t = -EYE[1] / direction[1]
    px, pz = EYE[0] + t * direction[0], EYE[2] + t * direction[2]
    return (px, pz) if max(abs(px), abs(pz)) <= FLOOR_SIDE / 2 else None


def sample(rng, x, y, albedo):
    point = floor_point(x + rng.random(), y + rng.random())
    if point is None:
        return 0.0
    dx = (rng.random() - 0.5) * LIGHT_SIDE - point[0]
    dz = (rng.random() - 0.5) * LIGHT_SIDE - point[1]
    squared = dx * dx + LIGHT_HEIGHT**2 + dz * dz
    cosines = LIGHT_HEIGHT**2 / squared  # of the floor times that of the light
    return albedo / math.pi * RADIANCE * cosines / squared * LIGHT_SIDE**2


def write_exr(path, rows):
    """32-bit floats in B, G and R, without compression (openexr.com, "OpenEXR File Layout")."""
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value

    window = struct.pack("<4i", 0, 0, WIDTH - 1, HEIGHT - 1)
    channels = b"".join(name + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    header = struct.pack("<ii", 20000630, 2)
    for name, kind, value in ((b"channels", b"chlist", channels), (b"compression", b"compression", b"\0"),
                              (b"dataWindow", b"box2i", window), (b"displayWindow", b"box2i", window),
                              (b"lineOrder", b"lineOrder", b"\0"), (b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
                              (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
                              (b"screenWindowWidth", b"float", struct.pack("<f", 1))):
        header += attribute(name, kind, value)
    header += b"\0"
    size = 12 * WIDTH
    with open(path, "wb") as file:
        file.write(header)
        for y in range(HEIGHT):
            file.write(struct.pack("<Q", len(header) + 8 * HEIGHT + y * (8 + size)))
        for y, row in enumerate(rows):
            file.write(struct.pack("<ii", y, size) + 3 * struct.pack(f"<{WIDTH}f", *row))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--spp", type=int, default=32)
    parser.add_argument("--albedo", type=float, default=0.5)
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    write_exr(arguments.output, [[sum(sample(rng, x, y, arguments.albedo) for _ in range(arguments.spp)) / arguments.spp
                                  for x in range(WIDTH)] for y in range(HEIGHT)])


if __name__ == "__main__":
    main()
