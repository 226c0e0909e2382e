# SPDX-License-Identifier: MIT
"""A pytest fixture that compares images with references.

    def test_box(assert_same_light):
        assert_same_light(my_renderer.render("box"), "refs/box.exr")

    pytest --plumb-update        # makes the references that are missing, and no other
    pytest --plumb-update-all    # also replaces those that are there
"""

import os
import shutil
from pathlib import Path

import pytest

from .comparison import compare
from .image import as_image, write


def pytest_addoption(parser):
    group = parser.getgroup("plumb")
    group.addoption("--plumb-update", action="store_true", help="make references that are missing")
    group.addoption("--plumb-update-all", action="store_true", help="make all references, also those that are there")


def _store(image, reference):
    reference.parent.mkdir(parents=True, exist_ok=True)
    unfinished = reference.with_name("." + reference.name + ".new")
    if isinstance(image, (str, os.PathLike)):
        shutil.copyfile(image, unfinished)
    else:
        write(unfinished, as_image(image))
    os.replace(unfinished, reference)


@pytest.fixture
def assert_same_light(request, tmp_path):
    """assert_same_light(image, reference, **settings): fails unless the image equals the reference but for their noise.

    image:     a file, a plumb.Image or an array; or a list of them: replicas with other seeds
    reference: a file, seen from the directory of the test
    settings:  those of plumb.compare()
    """
    replaces = request.config.getoption("--plumb-update-all")
    makes = replaces or request.config.getoption("--plumb-update")

    def check(image, reference, **settings):
        __tracebackhide__ = True
        file = Path(request.path).parent / reference
        if replaces or (makes and not file.exists()):
            _store(image[0] if isinstance(image, list) else image, file)
            return None
        if not file.exists():
            pytest.fail(f"the reference '{file}' does not exist; 'pytest --plumb-update' makes it", pytrace=False)
        difference = tmp_path / "difference.png"
        verdict = compare(image, file, diff=difference, **settings)
        if not verdict:
            pytest.fail(f"the image {verdict.outcome if verdict.outcome == 'differs' else 'is undecided'}: "
                        f"{reference}\n\n{verdict.text}\nthe difference: {difference}", pytrace=False)
        return verdict

    return check
