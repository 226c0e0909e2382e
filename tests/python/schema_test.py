#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Both schemas against the scenes of this project: schema_test.py RENDERER. Exits with 77, skipped, without xmllint."""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
RENDERER = sys.argv[1]

# What a message says that a schema can know: of RELAX NG, and of XML Schema, where parameters do not depend on the type.
KNOWN = {
    "rng": r"unknown parameter|unknown tag|unknown attribute|needs an attribute|is not a number|expected true or false"
           r"|unknown dialect|cannot contain|unknown \w+ '|must be a <",
    "xsd": r"unknown tag|unknown attribute|<(?!texture)\w+> needs an attribute|is not a number|expected true or false|unknown dialect"
           r"|unknown (bsdf|shape|mesh|emitter|camera|sampler|integrator|rfilter) '",
}
# Where the example of a kind stands in a scene.
PLACES = {"bsdf": '<shape type="sphere">%s</shape>', "rfilter": '<camera type="perspective">%s</camera>', "area": '<shape type="sphere">%s</shape>'}


def scenes():
    """Those in our own language; a version at the root makes it one of Mitsuba's."""
    for directory in ("scenes", "docs/example"):
        for path in sorted((ROOT / directory).rglob("*.xml")):
            if re.search(r"<scene(?![^>]*\bversion=)[ >]", path.read_text(encoding="utf-8")):
                yield path


def examples(types):
    """The samples of scene language in the manuals, each as a scene."""
    for each in types["types"]:
        blocks = re.findall(r"(?:^        .*\n?|^\n(?=        ))+", each["manual"], re.MULTILINE)
        for block in blocks:
            if not block.lstrip().startswith("<") or "<scene" in block:
                continue
            place = PLACES.get("area" if each["name"] == "area" else each["kind"], "%s")
            if each["kind"] == "bsdf" and "<shape" in block or each["kind"] == "rfilter" and "<camera" in block:
                place = "%s"
            if each["kind"] == "texture" and not re.match(r"\s*<(bsdf|shape|mesh|emitter)", block):
                place = '<shape type="sphere"><bsdf type="$any">%s</bsdf></shape>'
            yield each["name"], "<scene>" + place % block + "</scene>"


class SchemaTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        for language in ("rng", "xsd"):
            text = subprocess.run([RENDERER, "schema", language], check=True, capture_output=True).stdout
            (Path(cls.directory.name) / f"scene.{language}").write_bytes(text)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def problem(self, language, scene):
        """What the schema has against it; empty: nothing."""
        option = {"rng": "--relaxng", "xsd": "--schema"}[language]
        schema = str(Path(self.directory.name) / f"scene.{language}")
        done = subprocess.run(["xmllint", "--noout", option, schema, str(scene)], capture_output=True, text=True, check=False)
        return done.stderr if done.returncode else ""

    def test_every_shipped_scene_is_valid(self):
        found = list(scenes())
        self.assertGreater(len(found), 25)
        for scene in found:
            for language in ("rng", "xsd"):
                with self.subTest(scene=scene.name, language=language):
                    self.assertEqual(self.problem(language, scene), "")

    def test_every_example_of_a_manual_is_valid(self):
        types = json.loads(subprocess.run([RENDERER, "types", "--json", "-"], check=True, capture_output=True).stdout)
        found = list(examples(types))
        self.assertGreater(len(found), 60)
        for number, (name, text) in enumerate(found):
            scene = Path(self.directory.name) / f"{number}.xml"
            scene.write_text(text, encoding="utf-8")
            for language in ("rng", "xsd"):
                with self.subTest(type=name, language=language):
                    self.assertEqual(self.problem(language, scene), "")

    def test_parameters_of_the_scene(self):
        scene = Path(self.directory.name) / "layers.xml"
        for name, valid in (("aovs", True), ("aov", False)):
            scene.write_text(f'<scene><string name="{name}" value="albedo"/></scene>', encoding="utf-8")
            for language in ("rng", "xsd"):
                with self.subTest(name=name, language=language):
                    self.assertEqual(self.problem(language, scene) == "", valid)

    def test_wrong_scenes_are_not(self):
        rejected = {"rng": 0, "xsd": 0}
        for scene in sorted((ROOT / "tests/scenes/bad").glob("*.xml")):
            expected = scene.with_suffix(".expected").read_text(encoding="utf-8")
            # Of this file, not of one that it includes, nor of the value of a variable.
            lines = expected.splitlines()
            errors = [line for line, source in zip(lines, lines[1:] + [""])
                      if line.startswith(scene.name + ":") and "$" not in source]
            for language, pattern in KNOWN.items():
                if any(re.search(pattern, error) for error in errors):
                    with self.subTest(scene=scene.name, language=language):
                        self.assertNotEqual(self.problem(language, scene), "")
                    rejected[language] += 1
        self.assertGreater(rejected["rng"], 20)
        self.assertGreater(rejected["xsd"], 8)


if __name__ == "__main__":
    if not shutil.which("xmllint"):
        print("skipped: xmllint is not installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
