#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""docs/example, as a new user goes through it: example_test.py RENDERER. pytest is tried where it and numpy are installed."""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
RENDERER = sys.argv[1]


def run(directory, words, code, **variables):
    done = subprocess.run([str(word) for word in words], cwd=directory, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, env={**os.environ, **variables})
    if done.returncode != code:
        raise SystemExit(f"{words} gave {done.returncode}, not {code}:\n{done.stdout}{done.stderr}")
    return done.stdout


def expect(condition, what):
    if not condition:
        raise SystemExit(f"not so: {what}")


def try_suite(directory):
    batch = [RENDERER, "batch", "suite.xml"]
    run(directory, [*batch, "--allow-commands"], 1)  # no references yet
    run(directory, [*batch, "--update"], 0)
    out = run(directory, [*batch, "--allow-commands"], 0)
    expect("2 pass" in out, f"both images pass: {out}")
    out = run(directory, [*batch, "--allow-commands", "-D", "albedo=0.55"], 3)
    expect("2 differ" in out, f"the bug is found twice: {out}")
    expect((directory / "batch/suite/plate_32_significant.png").exists(), "there is a map of what is significant")
    expect("2 pass" in run(directory, [*batch, "--allow-commands"], 0), "the mended renderer passes")


def try_pytest(directory):
    if not all(importlib.util.find_spec(name) for name in ("numpy", "pytest")):
        print("pytest or numpy is not installed: skipped that part")
        return
    words = [sys.executable, "-m", "pytest", "-q", "-p", "plumb.pytest_plugin", "-p", "no:cacheprovider"]
    variables = {"PYTHONPATH": str(ROOT / "src/python"), "PLUMB_RENDERER": RENDERER}
    run(directory, words, 0, **variables)
    run(directory, words, 1, ALBEDO="0.55", **variables)


def try_ctest(directory):
    if not shutil.which("cmake") or not shutil.which("ctest"):
        print("CMake is not installed: skipped that part")
        return
    # What find_package() gives of an installed Plumb; tests/install has that.
    (directory / "package").mkdir()
    (directory / "package/plumbConfig.cmake").write_text(
        f'include("{ROOT}/tools/cmake/PlumbRenderTest.cmake")\nset(plumb_testing_FOUND TRUE)\n')
    for albedo, code in (("0.5", 0), ("0.55", 8)):
        run(directory, ["cmake", "-S", ".", "-B", "build", f"-Dplumb_DIR={directory / 'package'}",
                        f"-DPLUMB_RENDERER={RENDERER}", f"-DALBEDO={albedo}"], 0)
        run(directory, ["ctest", "--test-dir", "build"], code)


def main():
    with tempfile.TemporaryDirectory(prefix="plumb-test-") as temporary:
        directory = Path(temporary) / "example"
        shutil.copytree(ROOT / "docs/example", directory)
        try_suite(directory)
        try_pytest(directory)
        try_ctest(directory)


if __name__ == "__main__":
    main()
