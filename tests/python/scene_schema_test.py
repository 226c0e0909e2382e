#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The schema of the scene language, over every scene of the tree: scene_schema_test.py RENDERER. Exits with 77, skipped, where
xmllint is missing."""

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
if not shutil.which("xmllint"):
    print("skipped: xmllint is not installed")
    sys.exit(77)


def is_scene(path):
    return re.search(r"<scene[\s>]", path.read_text(encoding="utf-8")) is not None


class SceneSchemaTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="plumb-test-")
        cls.addClassCleanup(cls.temporary.cleanup)
        directory = Path(cls.temporary.name)
        types = directory / "types.json"
        subprocess.run([RENDERER, "types", "--json", types], check=True, stdout=subprocess.DEVNULL)
        cls.schema = directory / "scene.rng"
        with open(cls.schema, "w", encoding="utf-8") as file:
            subprocess.run([sys.executable, ROOT / "tools/scene_schema", types], check=True, stdout=file)

    def problems(self, scene):
        result = subprocess.run(["xmllint", "--noout", "--relaxng", self.schema, scene], capture_output=True, text=True)
        return "" if result.returncode == 0 else result.stderr

    def problems_of_text(self, text):
        scene = Path(self.temporary.name) / "scene.xml"
        scene.write_text(text)
        return self.problems(scene)

    def test_the_scenes_of_the_tree_are_valid(self):
        scenes = [path for path in sorted((ROOT / "scenes").rglob("*.xml")) if is_scene(path)]
        scenes.append(ROOT / "docs/example/plate.xml")
        self.assertGreater(len(scenes), 25)
        for scene in scenes:
            with self.subTest(scene=scene.relative_to(ROOT)):
                self.assertEqual(self.problems(scene), "")

    def test_what_does_not_exist_is_invalid(self):
        def scene(integrator):
            return f'<scene><camera type="perspective"/>{integrator}</scene>'

        self.assertEqual(self.problems_of_text(scene('<integrator type="path_mis"/>')), "")
        self.assertEqual(self.problems_of_text(scene('<integrator type="$method"/>')), "")
        self.assertNotEqual(self.problems_of_text(scene('<integrator type="path_miss"/>')), "")
        self.assertNotEqual(self.problems_of_text(scene('<integrater type="path_mis"/>')), "")
        depth = '<integrator type="{}"><integer name="{}" value="3"/></integrator>'
        self.assertEqual(self.problems_of_text(scene(depth.format("path_mis", "maxDepth"))), "")
        self.assertEqual(self.problems_of_text(scene(depth.format("$method", "maxDepth"))), "")
        self.assertNotEqual(self.problems_of_text(scene(depth.format("path_mis", "maxDepht"))), "")


if __name__ == "__main__":
    RENDERER = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
