# SPDX-License-Identifier: MIT
"""Writes references/independent/README.md."""

import numpy as np

TEXT = """# What others say

Images that Plumb has no part in: most are rendered by [Mitsuba 3](https://www.mitsuba-renderer.org), the others are
integrated numerically in double precision. The test `plumb_tests "[independent]"` holds Plumb to them.

Each scene is described once, in [tools/judge/scenes.py](../../tools/judge/scenes.py); from that description come
Plumb's scene file in [tests/scenes/independent/](../../tests/scenes/independent), Mitsuba's dictionary, and the
integral. The channels `variance.R`, `variance.G`, `variance.B` are the variance of each pixel's mean: estimated from
32 renders with seeds of their own (`judge:replicates` in the header), or, of a quadrature, the square of
what a coarser rule differs by. Where a filter is wider than a pixel, neighbouring pixels of Mitsuba share samples;
their variances are scaled up so that their sum is that of the whole image.

## Making them again

    python3 -m venv ~/judge && ~/judge/bin/pip install mitsuba=={version} numpy
    export DRJIT_LIBLLVM_PATH=...        # libLLVM.so of LLVM 16 or newer
    ~/judge/bin/python tools/judge/make.py [NAME...]

Made with Mitsuba {version}; each header names variant and samples per pixel (`judge`, `judge:samples`). All of them take
about ten minutes on two cores. `--scenes-only` writes only the scene files, which needs no LLVM; `--variant scalar_rgb`
needs none either.

Scenes whose names begin with `file-` are files of Mitsuba, kept by hand: both programs read the same file.

## Where the two renderers mean different things

None of these is a bug of Plumb; the translation or the choice of judge takes them into account.

- *Schlick's metal, `roughsubstrate`, `phong`*: Mitsuba has none of them. The judge is quadrature, and Mitsuba with
  these models as plugins in Python (`tools/judge/mitsuba_models.py`; "Mitsuba, plugin" below), both written from the
  papers. Where `R0` is 1, Schlick's formula is 1 at every angle, and Mitsuba's own metal is the judge.
- *`microfacet`* is a blend, in Mitsuba, of `diffuse` and a `roughconductor` with a real index of refraction.
- *Rough metal and plastic* are sampled with `sample_visible=false` in Mitsuba: its visible normals follow the exact
  shadowing function, the density Walter's rational fit of it, and the two differ by up to 0.35 %.
- *Rough glass*: with `sample_visible=false`, Mitsuba {version}'s `roughdielectric` takes normals from a rougher surface,
  and the weights of its samples are up to 2 % off the integral of its own `eval()`. So its `eval()` is the judge,
  sampled by a plugin in Python.
- *Environment images*: Mitsuba's first and last row lie at the poles, Plumb's half a row away from them. Mitsuba gets
  an image with a row between each two, which interpolates to the same light. Its u runs from another axis.
- *Checkerboards of numbers*: Mitsuba {version} begins with `color1` where a texture is asked for a number, with
  `color0` where it is asked for a colour. The translation swaps them.
- *Rotations*: Mitsuba takes the axis for a unit vector without saying so; the translation makes it one.
- *Depth*: Mitsuba counts the ray from the camera, so its `max_depth` is one more.
- *Wide boxes*: Mitsuba's box filter has no radius; the judge is quadrature.

## The scenes

`error` is the reference's own: the root of the mean variance, relative to the mean.

| scene | what | judge | mean | error |
| --- | --- | --- | ---: | ---: |
"""


def text(scenes, directory, read, version):
    """read(path) gives mean and variance, each (height, width, 3)."""
    rows = []
    for scene in scenes:
        path = directory / (scene.name + ".exr")
        if not path.exists():
            continue
        mean, variance = read(path)
        error = 100.0 * np.sqrt(variance.mean()) / abs(mean.mean())
        rows.append(f"| {scene.name} | {scene.what} | {scene.judge} | {mean.mean():.4f} | {error:.2g} % |")
    return TEXT.format(version=version) + "\n".join(rows) + "\n"
