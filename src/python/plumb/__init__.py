# SPDX-License-Identifier: MIT
"""Plumb from Python: a thin layer over the program `renderer` and its JSON. It needs numpy, and nothing else.

    import plumb
    image = plumb.render("scene.xml", spp=64, seed=7)
    verdict = plumb.compare(image, "reference.exr")
    assert verdict, verdict.text

The program is the one that the environment variable PLUMB_RENDERER names, else the one in this package, if it is a wheel's,
else `renderer` in PATH.
"""

from .comparison import Verdict, compare
from .errors import Diagnostic, Error, UsageError
from .image import Image, read, write
from .program import find_renderer
from .rendering import render

__all__ = ["Diagnostic", "Error", "Image", "UsageError", "Verdict", "compare", "find_renderer", "read", "render", "write"]
