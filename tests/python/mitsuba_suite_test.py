#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""batch over Mitsuba 3 and its own scene file: mitsuba_suite_test.py RENDERER. Exits with 77, skipped, where Mitsuba is missing."""

import importlib.util
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
if not importlib.util.find_spec("mitsuba"):
    print("skipped: Mitsuba is not installed")
    sys.exit(77)

PROGRAM = """import sys
import mitsuba
mitsuba.set_variant("scalar_rgb")
scene, image, seed, spp, albedo = sys.argv[1:]
scene = mitsuba.load_file(scene, albedo=albedo)
mitsuba.Bitmap(mitsuba.render(scene, seed=int(seed), spp=int(spp))).write(image)
"""

# docs/example/plate.xml in Mitsuba's words.
SCENE = """<scene version="3.0.0">
  <default name="albedo" value="0.5"/>
  <integrator type="path"/>
  <sensor type="perspective">
    <float name="fov" value="40"/><string name="fov_axis" value="x"/>
    <transform name="to_world"><lookat origin="0,1.5,4" target="0,0,0" up="0,1,0"/></transform>
    <film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="48"/><rfilter type="box"/></film>
  </sensor>
  <shape type="rectangle">
    <transform name="to_world"><scale value="3"/><rotate x="1" angle="-90"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="$albedo"/></bsdf>
  </shape>
  <shape type="rectangle">
    <transform name="to_world"><scale value="0.4"/><rotate x="1" angle="90"/><translate y="2"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="8"/></emitter>
  </shape>
</scene>
"""

# Name, albedo, exit code: 0.5 is right.
CASES = [("right", 0.5, 0), ("wrong", 0.55, 3)]


def main():
    with tempfile.TemporaryDirectory(prefix="plumb-test-") as temporary:
        directory = Path(temporary)
        shutil.copy(ROOT / "docs/example/plate.xml", directory)
        (directory / "program.py").write_text(PROGRAM)
        (directory / "scene.xml").write_text(SCENE)
        entries = "".join(f'<render scene="plate.xml" name="{name}" command="{sys.executable} {{directory}}/program.py '
                          f'{{input}} {{image}} {{seed}} {{spp}} {albedo}"/>\n' for name, albedo, _ in CASES)
        (directory / "suite.xml").write_text('<suite spp="32" replicas="4" inputs="scene.xml" reference="plate.exr" '
                                             f'reference-spp="1024" reference-seed="1">\n{entries}</suite>\n')
        batch = [sys.argv[1], "batch", "suite.xml"]
        subprocess.run([*batch, "--update", "--quiet"], cwd=directory, check=True)
        for name, _, code in CASES:
            done = subprocess.run([*batch, "--allow-commands", "--filter", name], cwd=directory, capture_output=True, text=True)
            if done.returncode != code:
                raise SystemExit(f"{name} gave {done.returncode}, not {code}:\n{done.stdout}{done.stderr}")


if __name__ == "__main__":
    main()
