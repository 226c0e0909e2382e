# SPDX-License-Identifier: MIT
"""Running the program."""

import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from .errors import Diagnostic, Error, UsageError

SCHEMA = 1  # of the program's JSON: docs/json.md
USAGE = 2  # exit code


IN_PACKAGE = Path(__file__).resolve().parent / "bin" / "renderer"  # of a wheel


def find_renderer():
    """The program's path: what PLUMB_RENDERER names, else the one in this package, else `renderer` in PATH. Raises Error if
    there is none."""
    named = os.environ.get("PLUMB_RENDERER")
    if not named and os.access(IN_PACKAGE, os.X_OK):
        return str(IN_PACKAGE)
    found = shutil.which(named or "renderer")
    if found is None:
        raise Error([Diagnostic(f"there is no program '{named or 'renderer'}'",
                                suggestion="put Plumb's renderer into PATH, or name it in PLUMB_RENDERER")])
    return found


def option_words(settings):
    """Keywords as options: spp=4 is --spp 4, no_variance=True is --no-variance, define={"a": 1} is --define a=1."""
    words = []
    for name, value in settings.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif isinstance(value, dict):
            for key, one in value.items():
                words += [option, f"{key}={one}"]
        elif name == "size" and not isinstance(value, str):
            words += [option, "x".join(str(one) for one in value)]
        elif isinstance(value, (list, tuple)):
            words += [option, ",".join(str(one) for one in value)]
        elif value is not None and value is not False:
            words += [option, str(value)]
    return words


def _diagnostics(report, stderr):
    if report and report.get("kind") == "error":
        return [Diagnostic(one["message"], one["file"], one["line"], one["column"], one["severity"], one["suggestion"])
                for one in report["errors"]]
    return [Diagnostic(stderr.strip() or "the program printed nothing")]


def run(words, accepted=(0,)):
    """Runs the program with --json. Returns the exit code, the report and what it printed; raises Error for any other exit code."""
    with tempfile.TemporaryDirectory(prefix="plumb-") as directory:
        file = Path(directory) / "report.json"
        done = subprocess.run([find_renderer(), *[str(word) for word in words], "--json", str(file)],
                              stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", errors="replace")
        report = json.loads(file.read_text(encoding="utf-8")) if file.exists() else None
    if done.returncode not in accepted:
        kind = UsageError if done.returncode == USAGE else Error
        raise kind(_diagnostics(report, done.stderr))
    if not report or report.get("schema") != SCHEMA:
        raise Error([Diagnostic(f"the program's JSON has schema {report.get('schema') if report else None}, not {SCHEMA}",
                                suggestion="use a program and a module of the same version")])
    return done.returncode, report, done.stdout
