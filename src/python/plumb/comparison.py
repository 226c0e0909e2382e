# SPDX-License-Identifier: MIT
"""Verdicts on images."""

import os
import tempfile
from pathlib import Path

from .image import as_image, write
from .program import option_words, run

OUTCOMES = {0: "passes", 3: "differs", 4: "undecided"}


class Verdict:
    """Are two images the same but for their noise? True only if they pass: undecided is no agreement.

    outcome: "passes", "differs" or "undecided"
    text:    what `renderer compare` prints
    report:  its JSON (docs/json.md)
    """

    def __init__(self, outcome, text, report):
        self.outcome = outcome
        self.text = text
        self.report = report

    def __bool__(self):
        return self.outcome == "passes"

    @property
    def p(self):
        """Of the test; None if there was none."""
        return self.report["noise"].get("p")

    @property
    def detectable_bias(self):
        """A relative bias of the whole image that would have been found with 90 % probability; None if it is not known."""
        return self.report["noise"].get("detectable_bias")

    @property
    def rmse(self):
        return self.report["metrics"]["rmse"]

    def __repr__(self):
        return f"<plumb.Verdict: {self.outcome}, p {self.p}>"


def compare(a, b, *, diff=None, **settings):
    """Compares the image `a` with the reference `b`.

    a, b:     a file, an Image or an array; or a list of them: replicas, which differ in their seeds
    diff:     write the difference in false colours to this file
    settings: the options of `renderer compare`, with _ for -: significance=0.001, max={"rmse": 0.01}, exact="B"
    """
    with tempfile.TemporaryDirectory(prefix="plumb-") as directory:
        words = ["compare", *_files(a, Path(directory), "a")]
        for file in _files(b, Path(directory), "b"):
            words += ["--against", file]
        if diff is not None:
            words += ["--diff", diff]
        code, report, text = run(words + option_words(settings), accepted=OUTCOMES)
    return Verdict(OUTCOMES[code], text, report)


def _files(images, directory, name):
    """The names of image files; what is in memory is written."""
    replicas = images if isinstance(images, (list, tuple)) else [images]
    files = []
    for i, image in enumerate(replicas):
        if isinstance(image, (str, os.PathLike)):
            files.append(image)
        else:
            files.append(directory / f"{name}{i + 1}.exr")
            write(files[-1], as_image(image))
    return files
