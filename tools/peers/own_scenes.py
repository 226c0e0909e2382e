# SPDX-License-Identifier: MIT
"""How long our own scenes take to an error, by the estimator that `renderer race` finds best: see tools/bench --own."""

import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))

import reference_table  # noqa: E402

PLUMB = ROOT / "build" / "renderer"

SCENES = ("cbox/cbox_mis", "cbox/cbox_glossy_mis", "cbox/cbox_caustics_mis", "veach_mi/veach_mis", "table/table_mis", "hw4/cornellbox",
          "interesting/interesting_1", "interesting/interesting_2", "gallery/endgame", "gallery/garden")  # fmt: skip
ERRORS = (0.01, 0.001)
ESTIMATORS = ("--integrators", "path,path_nee,path_mis", "--samplers", "independent,sobol")


def report(*words):
    result = subprocess.run([str(PLUMB), *map(str, words), "--json", "-", "--quiet"], capture_output=True, text=True, check=False)
    if result.returncode in (1, 2):
        raise SystemExit(f"bench: {result.stderr.strip()}")
    return json.loads(result.stdout)


def mean_of(image):
    _, channels = reference_table.read(PLUMB, image)
    return math.fsum(math.fsum(channels[c]) / len(channels[c]) for c in "RGB") / 3


def duration(seconds):
    for unit, length in (("d", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 2 * length:
            return f"{seconds / length:.1f} {unit}"
    return f"{seconds:.1f} s"


def row(name, options, directory):
    scene = ROOT / "scenes" / (name + ".xml")
    image = directory / "image.exr"
    whole = report(scene, "--spp", 1, "-o", image)["resolution"]
    width = min(options.width, whole[0])
    size = f"{width}x{max(1, round(width * whole[1] / whole[0]))}"
    pixels = width * int(size.split("x")[1])
    report(scene, "--spp", options.spp, "--size", size, "-o", image)
    mean = mean_of(image)
    race = report("race", scene, "--size", size, "--spp", options.spp, "--rounds", options.rounds, *ESTIMATORS)
    best = race["estimators"][0]
    seconds = best["seconds_per_sample"] * whole[0] * whole[1] / pixels  # of one sample of every pixel
    relative = math.sqrt(best["variance"]) / mean
    times = [duration(seconds * options.spp * (relative / error) ** 2) for error in ERRORS]
    verdict = "" if race["verdict"] == "agree" else f" ({race['verdict']})"
    print(f"| `{name}` | {whole[0]}x{whole[1]} | {best['name']}{verdict} | {100 * relative:.2g} % | {' | '.join(times)} |", flush=True)


def main(words):
    parser = argparse.ArgumentParser(prog="tools/bench --own")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--rounds", type=int, default=8)
    parser.add_argument("--width", type=int, default=160)
    options = parser.parse_args(words)
    errors = " | ".join(f"to {100 * error:g} %" for error in ERRORS)
    print(f"| scene | pixels | best of `race` | expected RMSE at {options.spp} samples | {errors} |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as directory:
        for name in SCENES:
            row(name, options, Path(directory))
