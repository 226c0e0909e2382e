# SPDX-License-Identifier: MIT
"""Rendering."""

import tempfile
from pathlib import Path

from .image import read
from .program import option_words, run


def render(scene, *, output=None, **settings):
    """Renders a scene file, and returns an Image.

    settings: the options of `renderer`, with _ for -: spp=64, seed=7, size=(320, 240), integrator="path_mis",
              aov=["normal"], define={"albedo": "0.3"}, no_variance=True
    output:   also keep the image in this file
    Raises Error, with file, line and column of what is wrong in the scene.
    """
    with tempfile.TemporaryDirectory(prefix="plumb-") as directory:
        image = Path(directory) / "image.exr"
        outputs = ["-o", image] + (["-o", output] if output is not None else [])
        _, report, _ = run([_as_file(scene), *outputs, "--quiet", *option_words(settings)])
        rendered = read(image)
    rendered.report = report
    return rendered


def _as_file(scene):
    """A file that is called like a verb or an option is none to the program."""
    path = str(scene)
    return path if "/" in path else "./" + path
