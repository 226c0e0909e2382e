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

# From the bottom to the top.
LAYERS = ["math", "core", "interfaces", "plugins", "scene", "integrators", "render", "settings", "check", "scene_file",
          "course_tests", "compare", "cli"]

# include/plumb/NAME.h, and src/**/NAME.cpp beside it, belong to a layer by name.
HEADERS = {
    "math": "math color direction_cone elementary frame ray transform",
    "core": "dialect distribution error fixed_point fresnel hash image intersection mean_and_variance mesh microfacet "
            "sampling statistics version",
    "interfaces": "bsdf camera emitter filter integrator params sampler shape surface texture",
    "scene": "instruction_set light_tree scene tracer",
    "render": "evidence film render sample_set state_file stop_rules",
    "settings": "compare_settings render_settings settings settings_header",
    "check": "check",
    "scene_file": "load scene_file suite test_file",
    "course_tests": "course_test",
    "compare": "compare flip",
}

# Files below src/ belong to a layer by folder. An inner folder goes before the one around it.
FOLDERS = {
    "src/core": "core",
    "src/io": "core",
    "src/interfaces": "interfaces",
    "src/shapes": "plugins",
    "src/textures": "plugins",
    "src/bsdfs": "plugins",
    "src/emitters": "plugins",
    "src/cameras": "plugins",
    "src/samplers": "plugins",
    "src/filters": "plugins",
    "src/scene": "scene",
    "src/integrators": "integrators",
    "src/render": "render",
    "src/settings": "settings",
    "src/scene_file": "scene_file",
    "src/course_tests": "course_tests",
    "src/check": "check",
    "src/compare": "compare",
    "src/cli": "cli",
    "src/math": "math",
}

# Library: what its includes look like, and the only files that have them (patterns as in pathlib's match).
DOORS = {
    "Embree": (r"embree[34]?/", ["src/scene/accel*.cpp"]),
    "OpenImageIO": (r"OpenImageIO/", ["src/io/oiio/*"]),
    "OpenEXR": (r"OpenEXR/|Imf|Iex|IlmThread", ["src/io/oiio/*.cpp"]),
    "tinyobjloader": (r"tiny_?obj", ["src/io/obj*.cpp"]),
    "pugixml": (r"pugi", ["src/scene_file/document*.cpp"]),
    "oneTBB": (r"(oneapi/)?tbb(/|\.h)", ["src/render/render*.cpp", "src/core/parallel*.cpp"]),
    "OpenSSL": (r"openssl/", ["src/core/sha256.cpp"]),
    "CLI11": (r"CLI/", ["src/cli/options*.cpp"]),
    "Imath": (r"Imath", ["include/plumb/math.h", "include/plumb/transform.h"]),
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of_header(name):
    for layer, names in HEADERS.items():
        if name in names.split():
            return layer
    return None


def layer_of(path):
    """The layer of a file (a Path relative to the root); None if the tables do not know it."""
    if path.parts[:2] == ("include", "plumb"):
        return layer_of_header(path.stem) if len(path.parts) == 3 else None
    folders = [folder for folder in FOLDERS if path.is_relative_to(folder)]
    return FOLDERS[max(folders, key=len)] if folders else None


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
        yield 1, ("this file is in no layer; add it to HEADERS or FOLDERS in tools/check_layers.py")
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
        if own and other and LAYERS.index(other) > LAYERS.index(own):
            yield number, f"layer '{own}' may not include '{name}' of the higher layer '{other}'"


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
