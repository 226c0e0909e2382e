# SPDX-License-Identifier: MIT
"""tools/bench --limit: how far is Plumb from what the machine can do?

In one run, in turn, so that a machine whose speed drifts does not favour one side:

  loop      rays per second of path_mis in the Cornell box over those of the bare Embree loop (tools/embree_loop.cpp),
            with a mesh of 8 k triangles and with one of 4 M triangles
  embree    the share of CPU time inside Embree, by samples of `perf`, if that is there
  threads   rays per second with two threads over one
  loading   seconds to parse and build an OBJ of 1 M triangles

Every figure is the median over the runs, ratios pair by pair. Standard library only.
"""

import argparse
import json
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILD = ROOT / "build"
sys.path[:0] = [str(HERE), str(HERE.parent / "judge")]

import meshes  # noqa: E402
import plumb_xml  # noqa: E402
from description import Camera, Scene, Shape  # noqa: E402
from objects import GREY, diffuse  # noqa: E402


def box_with_mesh(directory, triangles):
    """A grey Cornell box with one mesh of about so many triangles in it; the scene file and their number."""
    def panel(center, normal, size=2.0, **more):
        return Shape("rectangle", more.pop("bsdf", GREY), center=center, normal=normal, width=size, height=size, **more)

    mesh = meshes.waves("mesh", triangles)
    shapes = [
        panel((0.0, 0.0, 0.0), (0, 1, 0)),
        panel((0.0, 2.0, 0.0), (0, -1, 0)),
        panel((-1.0, 1.0, 0.0), (1, 0, 0)),
        panel((1.0, 1.0, 0.0), (-1, 0, 0)),
        panel((0.0, 1.0, -1.0), (0, 0, 1)),
        panel((0.0, 1.99, 0.0), (0, -1, 0), 0.5, bsdf=diffuse(0.0, 0.0, 0.0), radiance=(15.0, 15.0, 15.0)),
        Shape("mesh", GREY, mesh=mesh, steps=[("scale", (0.6, 0.6, 0.6)), ("translate", (0.0, 0.7, 0.0))]),
    ]
    camera = Camera(origin=(0.0, 1.0, 4.2), target=(0.0, 1.0, 0.0), fov=40.0, width=400, height=300)
    scene = Scene("box", shapes, camera=camera, max_depth=-1)
    directory.mkdir()
    (directory / "mesh.obj").write_text(plumb_xml.mesh_text(mesh))
    (directory / "box.xml").write_text(plumb_xml.scene_text(scene))
    return directory / "box.xml", len(mesh.faces)


def run_json(command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed:\n{result.stderr}")
    return json.loads(result.stdout)


def renderer(scene, *options, before=()):
    with tempfile.TemporaryDirectory() as directory:
        return run_json([*before, BUILD / "renderer", scene, "-o", Path(directory) / "out.exr", "--json", "-", "--quiet", *options])


def share_inside_embree(scene, spp, directory):
    """Of the CPU time, sampled while rendering; None without `perf`."""
    if not shutil.which("perf"):
        return None
    data = directory / "perf.data"
    renderer(scene, "--spp", spp, before=["perf", "record", "--quiet", "--event", "cpu-clock", "--output", data])
    report = subprocess.run(["perf", "report", "--stdio", "--input", str(data), "--sort", "dso", "--percent-limit", "0"],
                            capture_output=True, text=True, check=False)  # fmt: skip
    lines = [line.split() for line in report.stdout.splitlines() if line.strip() and not line.startswith("#")]
    if not lines:
        return None
    return sum(float(words[0].rstrip("%")) for words in lines if "libembree" in words[-1]) / 100.0


def median_line(name, values, unit, target=""):
    print(f"{name:<44} {statistics.median(values):8.3f} {unit:<12} (from {min(values):.3f} to {max(values):.3f}){target}")


def main(words):
    parser = argparse.ArgumentParser(prog="tools/bench --limit")
    parser.add_argument("--json", metavar="FILE", help="write all raw timings")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--quick", action="store_true", help="small meshes, one run: only to see that it works")
    arguments = parser.parse_args(words)
    runs = 1 if arguments.quick else arguments.runs
    spp = 4 if arguments.quick else 128

    raw = {"machine": platform.machine(), "runs": runs, "spp": spp}
    with tempfile.TemporaryDirectory() as temporary:
        directory = Path(temporary)
        small, small_count = box_with_mesh(directory / "small", 8_000)
        large, large_count = box_with_mesh(directory / "large", 40_000 if arguments.quick else 4_000_000)
        for name, scene, count in (("loop_8k", small, small_count), ("loop_4m", large, large_count)):
            rows = []
            for _ in range(runs):
                bare = run_json([BUILD / "embree_loop", scene, "--spp", spp])
                ours = renderer(scene, "--spp", spp)
                rows.append({"bare": bare["rays_per_second"], "plumb": ours["rays_per_second"]})
            raw[name] = rows
            print(f"Cornell box, {count} triangles, path_mis, {spp} spp, all threads:")
            median_line("  bare Embree loop", [row["bare"] / 1e6 for row in rows], "Mrays/s")
            median_line("  plumb", [row["plumb"] / 1e6 for row in rows], "Mrays/s")
            median_line("  plumb / bare loop", [row["plumb"] / row["bare"] for row in rows], "", "  target: at least 0.85, 0.9 at 4 M")

        share = share_inside_embree(small, 2 * spp, directory)
        raw["inside_embree"] = share
        print(f"{'share of CPU time inside Embree (8 k)':<44} " + ("no perf here" if share is None else f"{share:8.3f}"))

        rows = []
        for _ in range(runs):
            rows.append({str(n): renderer(small, "--spp", spp, "--threads", n)["rays_per_second"] for n in (1, 2)})
        raw["threads"] = rows
        median_line("two threads / one thread", [row["2"] / row["1"] for row in rows], "", "  target: at least 1.95")

        million, count = box_with_mesh(directory / "million", 10_000 if arguments.quick else 1_000_000)
        rows = [renderer(million, "--spp", 1)["seconds"] for _ in range(runs)]
        raw["loading"] = rows
        median_line(f"parse and build {count} triangles", [row["parsing"] + row["building"] for row in rows], "s")
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(raw, indent=1) + "\n")
