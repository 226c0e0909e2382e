# SPDX-License-Identifier: MIT
"""The command `renderer` that a wheel installs. A module of its own: `import plumb` takes numpy, which takes longer to load
than the program takes to start."""

import os
import sys

PROGRAM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "plumb", "bin", "renderer")


def main():
    """Becomes the program in the package."""
    try:
        os.execv(PROGRAM, [PROGRAM, *sys.argv[1:]])
    except OSError as error:
        sys.exit(f"error: cannot run '{PROGRAM}': {error.strerror}")
