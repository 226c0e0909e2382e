#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks what every #include points to.

1. Layers: a file includes its own layer or a lower one.
2. One door: each third-party library is included by the file or files that wrap it, and nowhere else.

Prints `file:line: message` for each violation, and exits with 1 if there is one.
"""

import re
import sys
from pathlib import Path

# Rooms: the folders of include/plumb/ and of src/, from the bottom to the top. Rooms of one line are of one layer.
LAYERS = [
    ["base"],
    ["math"],
    ["sampling", "statistics"],
    ["image"],
    ["denoise"],
    ["model"],
    ["shapes", "textures", "bsdfs", "emitters", "cameras", "samplers", "filters"],
    ["scene"],
    ["integrators"],
    ["render"],
    ["settings"],
    ["check"],
    ["scene_file"],
    ["suite_file", "test_file"],
    ["estimator_checks"],
    ["compare"],
    ["display"],
    ["rendering"],
    ["experiments"],
    ["reports"],
    ["cli"],
]

# Library: what its includes look like, and the only files that have them (patterns as in pathlib's match).
DOORS = {
    "Embree": (r"embree[34]?/", ["src/scene/accel*"]),
    "OpenImageIO": (r"OpenImageIO/", ["src/image/oiio/*"]),
    "OpenEXR": (r"OpenEXR/|Imf|Iex|IlmThread", ["src/image/oiio/*.cpp"]),
    "tinyobjloader": (r"tiny_?obj", ["src/shapes/obj/mtl.cpp"]),
    "pugixml": (r"pugi", ["src/scene_file/document*.cpp"]),
    "oneTBB": (r"(oneapi/)?tbb(/|\.h)", ["src/render/render*.cpp", "src/base/parallel*.cpp"]),
    "OpenSSL": (r"openssl/", ["src/base/sha256.cpp"]),
    "zlib": (r"zlib\.h", ["src/shapes/serialized/inflated.cpp"]),
    "CLI11": (r"CLI/", ["src/cli/parse*.cpp"]),
    "Imath": (r"Imath", ["include/plumb/math/math.h", "include/plumb/math/transform.h"]),
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(path):
    """The room of a file (a Path relative to the root); None where there is none."""
    start = 2 if path.parts[:2] == ("include", "plumb") else 1
    return path.parts[start] if len(path.parts) > start + 1 else None


def layer_of(path):
    """The layer of a file, counted from the bottom; None if its folder is in none."""
    room = room_of(path)
    return next((i for i, rooms in enumerate(LAYERS) if room in rooms), None)


def resolve(root, source, name):
    """The file of ours that `source` means by #include "name" or <name>; None if it is none of ours."""
    for candidate in (source.parent / name, Path("include") / name, Path("src") / name):
        parts = []
        for part in candidate.parts:
            if part == ".." and parts:
                parts.pop()
            else:
                parts.append(part)
        candidate = Path(*parts)
        if (root / candidate).is_file():
            return candidate
    return None


def check_file(root, path):
    own = layer_of(path)
    if own is None:
        yield 1, "this file's folder is in no layer; add it to LAYERS in tools/check_layers.py"
    for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), start=1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quote, name = match.groups()

        for library, (pattern, doors) in DOORS.items():
            if re.match(pattern, name) and not any(path.match(door) for door in doors):
                yield number, f"{library} may be included only by {' and '.join(doors)}"

        target = resolve(root, path, name)
        if target is None:
            if quote == '"' or name.startswith("plumb/"):
                if not any(re.match(pattern, name) for pattern, _ in DOORS.values()):
                    yield number, f"there is no file '{name}' in include/, in src/ or beside this one"
            continue
        other = layer_of(target)
        if own is not None and other is not None and other > own:
            yield number, f"'{room_of(path)}' may not include '{name}' of the higher layer '{room_of(target)}'"


def main():
    root = Path(__file__).resolve().parent.parent
    files = sorted(
        path.relative_to(root)
        for folder in ("include", "src")
        for path in (root / folder).rglob("*")
        if path.suffix in (".h", ".cpp")
    )
    violations = 0
    for path in files:
        for number, message in check_file(root, path):
            print(f"{path}:{number}: {message}")
            violations += 1
    if violations:
        print(f"check_layers: {violations} violation(s) in {len(files)} files", file=sys.stderr)
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
