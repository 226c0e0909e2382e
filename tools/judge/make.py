#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the scenes and references of the independent judge.

    tools/judge/make.py [--scenes-only] [--replicates N] [--samples N] [--variant NAME] [NAME...]

Scene files, meshes and textures go to tests/scenes/independent/, references to references/independent/: channels
R, G, B and variance.R, variance.G, variance.B, the variance of each mean. Without names, all of them, and the README
of the references. Needs Mitsuba 3, NumPy and LLVM (references/independent/README.md says how).
"""

import argparse
import os
import sys
import time
from pathlib import Path

import mitsuba as mi
import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SCENE_DIRECTORY = ROOT / "tests" / "scenes" / "independent"
REFERENCE_DIRECTORY = ROOT / "references" / "independent"
VARIANT = "llvm_ad_rgb"
CHANNELS = ["R", "G", "B", "variance.R", "variance.G", "variance.B"]


def write_image(path, data, names, attributes):
    data = np.ascontiguousarray(data, dtype=np.float32)
    bitmap = mi.Bitmap(data, mi.Bitmap.PixelFormat.MultiChannel if len(names) > 3 else mi.Bitmap.PixelFormat.RGB, names)
    for name, value in attributes.items():
        bitmap.metadata()[name] = value
    bitmap.write(str(path))


def write_scene(scene):
    import plumb_xml
    from description import MitsubaFile

    if isinstance(scene, MitsubaFile):
        return
    for mesh in plumb_xml.meshes(scene):
        (SCENE_DIRECTORY / (mesh.name + ".obj")).write_text(plumb_xml.mesh_text(mesh))
    for image in plumb_xml.images(scene):
        write_image(SCENE_DIRECTORY / (image.name + ".exr"), image.rows, ["R", "G", "B"], {})
    (SCENE_DIRECTORY / (scene.name + ".xml")).write_text(plumb_xml.scene_text(scene))


def read_reference(path):
    data = np.array(mi.Bitmap(str(path)), dtype=np.float64)
    names = [field.name for field in mi.Bitmap(str(path)).struct_()]
    order = [names.index(name) for name in CHANNELS]
    return data[:, :, order[:3]], data[:, :, order[3:]]


def judge(scene, replicates, samples):
    """Mean, variance and attributes."""
    if scene.judge == "quadrature":
        import quadrature

        mean, variance = quadrature.render(scene)
        return mean, variance, {"judge": f"quadrature, numpy {np.__version__}", "judge:replicates": "0"}
    import mitsuba_scene
    from description import MitsubaFile

    if isinstance(scene, MitsubaFile):
        path = SCENE_DIRECTORY / (scene.name + ".xml")
        mean, variance = mitsuba_scene.render_file(path, replicates, samples)
    else:
        mean, variance = mitsuba_scene.render(scene, SCENE_DIRECTORY, replicates, samples)
    return mean, variance, {
        "judge": f"Mitsuba {mi.__version__} {mi.variant()}",
        "judge:replicates": str(replicates),
        "judge:samples": str(replicates * samples),
    }


def main():
    parser = argparse.ArgumentParser(description="Writes the scenes and references of the independent judge.")
    parser.add_argument("--scenes-only", action="store_true")
    parser.add_argument("--replicates", type=int, default=32)
    parser.add_argument("--samples", type=int, default=1024, help="per pixel and replicate")
    parser.add_argument("--variant", default=VARIANT, help="of Mitsuba; scalar_rgb needs no LLVM and is slower")
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()

    mi.set_variant("scalar_rgb" if options.scenes_only else options.variant)
    sys.path.insert(0, str(HERE))
    import readme
    from scenes import SCENES

    unknown = set(options.names) - {scene.name for scene in SCENES}
    if unknown:
        parser.error("unknown scene " + ", ".join(sorted(unknown)))
    chosen = [scene for scene in SCENES if not options.names or scene.name in options.names]
    SCENE_DIRECTORY.mkdir(parents=True, exist_ok=True)
    REFERENCE_DIRECTORY.mkdir(parents=True, exist_ok=True)
    for scene in chosen:
        write_scene(scene)
        if options.scenes_only:
            continue
        start = time.time()
        mean, variance, attributes = judge(scene, options.replicates, options.samples)
        attributes |= {"judge:scene": scene.name, "judge:script": "tools/judge/make.py"}
        path = REFERENCE_DIRECTORY / (scene.name + ".exr")
        write_image(path, np.concatenate([mean, variance], axis=2), CHANNELS, attributes)
        error = np.sqrt(variance.mean()) / mean.mean()
        print(f"{scene.name}: mean {mean.mean():.5f}, RMSE {100 * error:.3f} %, {time.time() - start:.1f} s, "
              f"{os.path.getsize(path)} bytes", flush=True)  # fmt: skip
    if not options.scenes_only:
        text = readme.text(SCENES, REFERENCE_DIRECTORY, read_reference, mi.__version__)
        (REFERENCE_DIRECTORY / "README.md").write_text(text)


if __name__ == "__main__":
    main()
