#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The Python module: plumb_test.py RENDERER [unittest's words]. Exits with 77, skipped, where numpy is missing."""

import os
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "src/python"))
try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
import plumb  # noqa: E402

SCENE = """<scene dialect="plumb"><integrator type="path_mis"/>
  <sampler type="independent"><integer name="sampleCount" value="16"/></sampler>
  <camera type="perspective">
    <transform name="toWorld"><lookat origin="0,0,-0.9" target="0,0,1" up="0,1,0"/></transform>
    <float name="fov" value="60"/><integer name="width" value="24"/><integer name="height" value="18"/>
  </camera>
  <shape type="rectangle"><vector name="normal" value="0,1,0"/><point name="center" value="0,-0.5,0"/>
    <float name="width" value="9"/><float name="height" value="9"/>
    <bsdf type="diffuse"><color name="albedo" value="{albedo}"/></bsdf></shape>
  <shape type="sphere"><point name="center" value="0,3,0"/><float name="radius" value="2"/>
    <emitter type="area"><color name="radiance" value="1,1,1"/></emitter></shape>
</scene>
"""


class PlumbTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="plumb-test-")
        self.addCleanup(temporary.cleanup)
        self.directory = Path(temporary.name)
        self.scene = self.directory / "scene.xml"
        self.scene.write_text(SCENE.replace("{albedo}", "0.7,0.6,0.5"))

    def test_a_rendering_is_arrays_and_a_header(self):
        image = plumb.render(self.scene, spp=4, seed=3, size=(16, 12), aov=["normal"])
        self.assertEqual(image.pixels.shape, (12, 16, 3))
        self.assertEqual(image.pixels.dtype, np.float32)
        self.assertEqual(image.variance.shape, (12, 16, 3))
        self.assertEqual(sorted(image.layer("normal")), ["X", "Y", "Z"])
        self.assertEqual(image.header["plumb:seed"], "3")
        self.assertEqual(image.header["plumb:samplesPerPixel"], 4)
        self.assertEqual(image.report["kind"], "render")
        again = plumb.render(self.scene, spp=4, seed=3, size="16x12", threads=1)
        np.testing.assert_array_equal(image.pixels, again.pixels)
        # The lower half of the image sees the floor, whose normal is +y.
        self.assertAlmostEqual(float(image.layer("normal")["Y"][-1].mean()), 1.0, places=5)

    def test_the_program_is_the_named_one_or_that_of_the_package_or_one_in_the_path(self):
        def program(name):
            file = self.directory / name / "renderer"
            file.parent.mkdir()
            file.write_text("#!/bin/sh\n")
            file.chmod(0o755)
            return str(file)
        named, packaged, in_path = program("named"), program("packaged"), program("path")
        found = plumb.find_renderer
        path = {"PATH": str(Path(in_path).parent)}
        with unittest.mock.patch("plumb.program.IN_PACKAGE", Path(packaged)):
            with unittest.mock.patch.dict(os.environ, {**path, "PLUMB_RENDERER": named}):
                self.assertEqual(found(), named)
            with unittest.mock.patch.dict(os.environ, {**path, "PLUMB_RENDERER": ""}):
                self.assertEqual(found(), packaged)
                Path(packaged).unlink()
                self.assertEqual(found(), in_path)
                Path(in_path).unlink()
                with self.assertRaises(plumb.Error):
                    found()

    def test_parts_of_the_light_add_up_to_the_image(self):
        image = plumb.render(self.scene, spp=8, split=["depth:3", "technique"])
        for family in ("by_depth.", "by_technique."):
            for color in "RGB":
                parts = [values for name, values in image.channels.items()
                         if name.startswith(family) and name.endswith("." + color)]
                self.assertEqual(len(parts), 4 if family == "by_depth." else 3)
                total = sum(values.astype(float) for values in parts).astype(np.float32)
                np.testing.assert_array_equal(total, image.channels[color])

    def test_what_is_written_is_what_is_read(self):
        rng = np.random.default_rng(1)
        channels = {name: rng.random((7, 5), dtype=np.float32) for name in ("R", "G", "B", "variance.R", "a.very.long.name.of.a.layer.X")}
        channels["R"][2, 3] = np.inf
        plumb.write(self.directory / "a.exr", plumb.Image(channels, {"plumb:seed": "8", "other": "x"}))
        back = plumb.read(self.directory / "a.exr")
        self.assertEqual(sorted(back.channels), sorted(channels))
        for name, values in channels.items():
            np.testing.assert_array_equal(back.channels[name], values)
        self.assertEqual(back.header["plumb:seed"], "8")

    def test_the_top_row_comes_first(self):
        array = np.zeros((3, 4, 3))
        array[0, 1] = (0.25, 0.5, 1.0)
        plumb.write(self.directory / "a.exr", array)
        np.testing.assert_array_equal(plumb.read(self.directory / "a.exr").pixels, array.astype(np.float32))

    def test_verdicts(self):
        reference = plumb.render(self.scene, spp=256, seed=1)
        same = plumb.compare(plumb.render(self.scene, spp=64, seed=2), reference)
        self.assertTrue(same, same.text)
        self.assertEqual(same.outcome, "passes")
        self.assertGreater(same.detectable_bias, 0)
        self.scene.write_text(SCENE.replace("{albedo}", "0.8,0.7,0.6"))
        brighter = plumb.render(self.scene, spp=64, seed=2)
        differs = plumb.compare(brighter, reference, diff=self.directory / "diff.png")
        self.assertFalse(differs)
        self.assertEqual(differs.outcome, "differs")
        self.assertLess(differs.p, 0.01)
        self.assertTrue((self.directory / "diff.png").exists())
        # Plain arrays, which have no error bars, and replicas.
        arrays = [plumb.render(self.scene, spp=16, seed=seed).pixels for seed in range(10, 14)]
        self.assertEqual(plumb.compare(arrays, reference).outcome, "differs")
        self.assertIn(plumb.compare(brighter.pixels, reference).outcome, ("differs", "undecided"))
        limited = plumb.compare(brighter, reference, no_verdict=True, max={"rmse": 100})
        self.assertTrue(limited)

    def test_errors_have_a_place(self):
        self.scene.write_text(SCENE.replace("{albedo}", "1,1,1").replace('name="albedo"', 'name="albdo"'))
        with self.assertRaises(plumb.Error) as caught:
            plumb.render(self.scene)
        self.assertEqual(caught.exception.file, str(self.scene))
        self.assertEqual((caught.exception.line, caught.exception.column), (9, 39))
        self.assertEqual(caught.exception.message, "unknown parameter 'albdo' for bsdf 'diffuse'")
        self.assertEqual(caught.exception.suggestion, "did you mean 'albedo'?")
        self.assertIn(f"{self.scene}:9:39: error: ", str(caught.exception))
        with self.assertRaises(plumb.UsageError) as caught:
            plumb.render(self.scene, sppp=4)
        self.assertEqual(caught.exception.suggestion, "did you mean '--spp'?")
        self.assertIsNone(caught.exception.line)
        with self.assertRaisesRegex(plumb.Error, "does not exist|cannot read"):
            plumb.compare(self.directory / "none.exr", self.directory / "none.exr")
        for wrong in (np.zeros(3), np.zeros((0, 4, 3)), np.zeros((2, 2, 5)), np.zeros((2, 2, 3), dtype=np.uint8)):
            with self.assertRaises(plumb.Error):
                plumb.write(self.directory / "wrong.exr", wrong)

    def test_a_program_that_is_not_there(self):
        with unittest.mock.patch.dict(os.environ, PLUMB_RENDERER=str(self.directory / "none")):
            with self.assertRaisesRegex(plumb.Error, "PLUMB_RENDERER"):
                plumb.render(self.scene)

    def test_the_pytest_plugin(self):
        try:
            import pytest  # noqa: F401
        except ImportError:
            self.skipTest("pytest is not installed")
        plumb.render(self.scene, spp=64, seed=1, output=self.directory / "good.exr")
        self.scene.write_text(SCENE.replace("{albedo}", "0.8,0.7,0.6"))
        plumb.render(self.scene, spp=64, seed=2, output=self.directory / "bad.exr")
        (self.directory / "test_it.py").write_text(
            "import os\n"
            "def test_it(assert_same_light):\n"
            "    assert_same_light(os.environ['IMAGE'], 'refs/it.exr', significance=0.001)\n")

        def run(image, *words):
            done = subprocess.run([sys.executable, "-m", "pytest", "-p", "plumb.pytest_plugin", "-q", "-p",
                                   "no:cacheprovider", *words], cwd=self.directory, capture_output=True, text=True,
                                  env={**os.environ, "PYTHONPATH": str(ROOT / "src/python"),
                                       "IMAGE": str(self.directory / image)})
            return done.returncode, done.stdout

        code, out = run("good.exr")
        self.assertEqual(code, 1)
        self.assertIn("'pytest --plumb-update' makes it", out)
        self.assertEqual(run("good.exr", "--plumb-update")[0], 0)
        self.assertEqual(run("good.exr")[0], 0)
        code, out = run("bad.exr", "--plumb-update")  # replaces nothing
        self.assertEqual(code, 1, out)
        self.assertIn("the image differs: refs/it.exr", out)
        self.assertIn("difference.png", out)
        self.assertEqual(run("bad.exr", "--plumb-update-all")[0], 0)
        self.assertEqual(run("bad.exr")[0], 0)


if __name__ == "__main__":
    os.environ["PLUMB_RENDERER"] = os.path.abspath(sys.argv.pop(1))
    unittest.main()
