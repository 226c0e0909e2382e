# SPDX-License-Identifier: MIT
"""The table of references/README.md, from the headers and the error bars of the images, and from the suite that makes
them; `tools/docs` writes and checks it.
"""

import array
import json
import math
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

SUITE = "tests/regression/suite.xml"


def entries(element, inherited):
    """The reference and the name of each image of a suite; attributes of groups apply to what is inside."""
    attributes = {**inherited, **element.attrib}
    if element.tag == "render":
        stem = Path(attributes["scene"]).stem
        name = element.attrib.get("name", stem)
        yield attributes["reference"].replace("$references/", "").replace("*", name), name
        return
    group = element.attrib.get("name", "") if element.tag == "group" else ""
    for child in element:
        if child.tag in ("group", "render"):
            for reference, name in entries(child, attributes):
                # The * of a reference is the whole name, with those of the groups.
                if "/" not in reference and group:
                    reference = f"{group}/{reference}"
                yield reference, name


def shares(root):
    """Of each reference, in the order of the suite, the names of the images that converge to it."""
    found = {}
    for reference, name in entries(xml.etree.ElementTree.parse(root / SUITE).getroot(), {}):
        found.setdefault(reference.removesuffix(".exr"), []).append(name)
    return found


def read(renderer, file):
    """Header, size, and the channels as arrays of floats."""
    with tempfile.TemporaryDirectory() as directory:
        pixels = Path(directory) / "pixels.npy"
        text = subprocess.run([renderer, "info", file, "--json", "-", "--pixels", pixels], check=True, capture_output=True,
                              encoding="utf-8").stdout
        report = json.loads(text)
        data = pixels.read_bytes()
    # The format of numpy, version 1: magic number, version, length of the description, description, values.
    length = int.from_bytes(data[8:10], "little")
    if b"'<f4'" not in data[10:10 + length]:
        raise SystemExit(f"tools/docs: '{file}' has no 32-bit floats")
    values = array.array("f", data[10 + length:])
    if sys.byteorder == "big":
        values.byteswap()
    count = len(report["channels"])
    return report, {name: values[i::count] for i, name in enumerate(report["channels"])}


def errors(channels):
    """The expected RMSE over the mean of the image: of all pixels, and of the 99 % with the least variance."""
    mean = sum(math.fsum(channels[c]) for c in "RGB")
    variances = sorted(map(sum, zip(*(channels[f"variance.{c}"] for c in "RGB"))))
    pixels = len(variances)
    quiet = variances[:pixels - pixels // 100]

    def relative(some):
        return math.sqrt(math.fsum(some) / (3 * len(some))) / (mean / (3 * pixels)) if mean else 0.0

    return relative(variances), relative(quiet)


def percent(value):
    return f"{100 * value:.2g} %"


def options(header, width, height):
    words = []
    if "plumb:set.size" in header or "--size" in header.get("plumb:arguments", ""):
        words.append(f"--size {width}x{height}")
    if "plumb:set.sampler" in header:
        words.append(f"--sampler {header['plumb:set.sampler']}")
    words += [f"-D {word}" for word in header.get("plumb:definitions", "").split()]
    return f"`{' '.join(words)}`" if words else ""


def row(renderer, root, name, images):
    report, channels = read(renderer, root / f"references/{name}.exr")
    header = report["header"]
    whole, quiet = errors(channels)
    width, height = report["resolution"]
    scene = re.sub(r"^.*scenes/", "", header["plumb:scene"])
    others = ", ".join(images) if images != [Path(name).name] else "itself"
    return (f"| `{name}` | `{scene}` | {options(header, width, height)} | {width}x{height} | {header['plumb:samplesPerPixel']} | "
            f"{header['plumb:seed']} | {percent(whole)} | {percent(quiet)} | {others} |")


def table(renderer, root):
    lines = ["| image | scene | options | pixels | samples per pixel | seed | expected RMSE | of 99 % of the pixels | what converges to it |",
             "|---|---|---|---|---|---|---|---|---|"]
    lines += [row(renderer, root, name, images) for name, images in shares(root).items()]
    return "".join(line + "\n" for line in lines)
