#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The manual pages through mandoc's lint: man_test.py RENDERER. Exits with 77, skipped, without mandoc."""

import shutil
import subprocess
import sys

# The program does not know when its pages were written.
ALLOWED = "missing date"


def main(renderer):
    if not shutil.which("mandoc"):
        print("skipped: mandoc is not installed")
        return 77
    pages = subprocess.run([renderer, "man", "--list"], check=True, capture_output=True, text=True).stdout.split()
    if len(pages) < 15:
        print(f"there are only {len(pages)} pages")
        return 1
    problems = []
    for page in pages:
        text = subprocess.run([renderer, "man", page], check=True, capture_output=True).stdout
        lint = subprocess.run(["mandoc", "-T", "lint", "-W", "warning"], input=text, capture_output=True, check=False)
        problems += [f"{page}: {line}" for line in lint.stdout.decode().splitlines() if ALLOWED not in line]
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
