#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks what every #include points to, or draws it.

    tools/check_layers.py                    the check
    tools/check_layers.py --svg FILE         writes the picture of docs/architecture.md

1. Layers: a file includes its own layer or a lower one.
2. One door: each third-party library is included by the file or files that wrap it, and nowhere else.
3. One type of a name: outside of unnamed namespaces, two types of one name are one to the linker, which takes the functions
   of either.

The check prints `file:line: message` for each violation, and exits with 1 if there is one.
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
    "OpenEXR": (r"OpenEXR/|Imf|Iex|IlmThread", ["src/image/lean/exr*"]),
    "libpng": (r"png\.h", ["src/image/lean/png.cpp"]),
    "libjpeg": (r"(jpeglib|jerror|turbojpeg)\.h", ["src/image/lean/jpeg.cpp"]),
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


UNNAMED = re.compile(r"^namespace \{.*?^\} // namespace$", re.MULTILINE | re.DOTALL)
TYPE = re.compile(r"^(?:class|struct|enum class) (\w+)(?: final)?(?: : [^\n;{]*)?\s*\{", re.MULTILINE)


def check_names(root, files):
    """(path, line, message) for each type whose name another file has, too."""
    first = {}
    for path in files:
        text = (root / path).read_text(encoding="utf-8")
        text = UNNAMED.sub(lambda match: "\n" * match.group(0).count("\n"), text)
        for match in TYPE.finditer(text):
            other = first.setdefault(match.group(1), path)
            if other != path:
                yield path, text.count("\n", 0, match.start()) + 1, f"'{match.group(1)}' is also a type of {other}"


def includes_between_rooms(root, files):
    """How many includes point from one room to another: {(from, to): count}."""
    counts = {}
    for path in files:
        for line in (root / path).read_text(encoding="utf-8").splitlines():
            match = INCLUDE.match(line)
            target = resolve(root, path, match.group(2)) if match else None
            if target is not None and room_of(target) and room_of(path) not in (None, room_of(target)):
                pair = (room_of(path), room_of(target))
                counts[pair] = counts.get(pair, 0) + 1
    return counts


def svg(root, files):
    """A row for each layer, the highest on top. A line is as wide as there are includes; those to base and math are left out."""
    counts = includes_between_rooms(root, files)
    lines_of = {}
    for path in files:
        text = (root / path).read_text(encoding="utf-8")
        lines_of[room_of(path)] = lines_of.get(room_of(path), 0) + text.count("\n")
    width, row, box, gap = 960, 56, 30, 14
    place = {}
    for number, rooms in enumerate(reversed(LAYERS)):
        size = (width - gap * (len(rooms) + 1)) / max(len(rooms), 4)
        left = (width - len(rooms) * size - (len(rooms) - 1) * gap) / 2
        # Alternating, so that lines between neighbours of a column do not hide each other.
        shift = 0 if len(rooms) > 1 else (-1) ** number * 150
        for i, room in enumerate(rooms):
            place[room] = (left + shift + i * (size + gap), 20 + number * row, size)
    height = 20 + len(LAYERS) * row
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">',
             "<title>Includes between the rooms of Plumb, from the higher layers down</title>",
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for (source, target), count in sorted(counts.items()):
        if target in ("base", "math") or source not in place or target not in place:
            continue
        x1, y1, size1 = place[source]
        x2, y2, size2 = place[target]
        x1, x2, y1 = x1 + size1 / 2, x2 + size2 / 2, y1 + box
        middle = (y1 + y2) / 2
        parts.append(f'<path d="M{x1:.0f} {y1:.0f} C{x1:.0f} {middle:.0f} {x2:.0f} {middle:.0f} {x2:.0f} {y2:.0f}" fill="none" '
                     f'stroke="#4477aa" stroke-opacity="0.35" stroke-width="{min(1 + count / 12, 6):.1f}"/>')
    for room, (x, y, size) in place.items():
        parts.append(f'<rect x="{x:.0f}" y="{y:.0f}" width="{size:.0f}" height="{box}" rx="5" fill="#eef3f8" stroke="#4477aa"/>')
        thousand = lines_of.get(room, 0) / 1000
        parts.append(f'<text x="{x + size / 2:.0f}" y="{y + 20:.0f}" text-anchor="middle">{room} '
                     f'<tspan fill="#777">{thousand:.1f}k</tspan></text>')
    return "\n".join(parts + ["</svg>"]) + "\n"


def main(arguments):
    root = Path(__file__).resolve().parent.parent
    files = sorted(
        path.relative_to(root)
        for folder in ("include", "src")
        for path in (root / folder).rglob("*")
        if path.suffix in (".h", ".cpp")
    )
    if len(arguments) == 2 and arguments[0] == "--svg":
        Path(arguments[1]).write_text(svg(root, files), encoding="utf-8")
        return 0
    if arguments:
        sys.stderr.write("usage: tools/check_layers.py [--svg FILE]\n")
        return 2
    violations = 0
    for path in files:
        for number, message in check_file(root, path):
            print(f"{path}:{number}: {message}")
            violations += 1
    for path, number, message in check_names(root, files):
        print(f"{path}:{number}: {message}")
        violations += 1
    if violations:
        print(f"check_layers: {violations} violation(s) in {len(files)} files", file=sys.stderr)
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
