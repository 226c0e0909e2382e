# SPDX-License-Identifier: MIT
"""The virtual environment that the peers live in. Standard library only: it runs before there is one."""

import glob
import os
import re
import subprocess
import sys
import venv
from pathlib import Path

# What the bench itself needs, and one package a peer. Blender's Python module comes for one version of Python each.
COMMON = ["numpy<2.5", "OpenEXR", "matplotlib"]
PEERS = {"mitsuba": "mitsuba==3.9.1", "cycles": "bpy==4.5.15", "luxcore": "pyluxcore==2.11.2"}
MODULES = {"mitsuba": "mitsuba", "cycles": "bpy", "luxcore": "pyluxcore"}


def default_directory():
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "plumb" / "bench-venv"


def python_of(directory):
    return Path(directory) / "bin" / "python"


def install(directory):
    """Makes the environment. A peer that cannot be had for this Python and machine is said to be so, no more."""
    if not python_of(directory).exists():
        venv.create(directory, with_pip=True)
    pip = [str(python_of(directory)), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, *COMMON, PEERS["mitsuba"]], check=True)
    for name, package in PEERS.items():
        if subprocess.run([*pip, package, *COMMON], check=False).returncode != 0:
            print(f"bench: {package} could not be installed; {name} is left out", file=sys.stderr)
    if not llvm_library():
        print("bench: no libLLVM; in Debian: apt-get install libllvm19. Mitsuba's llvm_ad_rgb is left out", file=sys.stderr)


def installed(directory):
    """The peers whose Python module is there."""
    test = "import importlib.util, sys; print(*(m for m in sys.argv[1:] if importlib.util.find_spec(m)))"
    words = subprocess.run([str(python_of(directory)), "-c", test, *MODULES.values()],
                           capture_output=True, text=True, check=True).stdout.split()  # fmt: skip
    return [name for name, module in MODULES.items() if module in words]


def llvm_library():
    """The newest libLLVM, which Mitsuba's llvm variants load; None if there is none."""
    if os.environ.get("DRJIT_LIBLLVM_PATH"):
        return os.environ["DRJIT_LIBLLVM_PATH"]
    found = glob.glob("/usr/lib/*/libLLVM*.so*") + glob.glob("/usr/lib/llvm-*/lib/libLLVM*.so*")

    def version(path):
        return [int(x) for x in re.findall(r"\d+", Path(path).name)]

    return max(found, key=version, default=None)
