# SPDX-License-Identifier: MIT
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
ALBEDO = os.environ.get("ALBEDO", "0.5")  # what a bug would change


def render(path, seed):
    subprocess.run([sys.executable, HERE / "tiny_renderer.py", "-o", path, "--seed", str(seed), "--albedo", ALBEDO],
                   check=True)
    return path


def test_one_image(assert_same_light, tmp_path):
    assert_same_light(render(tmp_path / "plate.exr", 1), "references/plate.exr")


def test_replicas(assert_same_light, tmp_path):
    assert_same_light([render(tmp_path / f"plate{seed}.exr", seed) for seed in range(4)], "references/plate.exr")
