# SPDX-License-Identifier: MIT
"""Images as arrays (height, width, 3), and as the files that `renderer compare` reads."""

import json
import subprocess

import numpy as np
import OpenEXR

CHANNELS = ("R", "G", "B")


def read(path):
    channels = OpenEXR.File(str(path), separate_channels=True).channels()
    return np.stack([channels[name].pixels for name in CHANNELS], axis=2).astype(np.float64)


def write(path, image, variance=None, replicates=0):
    """variance: of the image, which is the mean of so many replicates."""
    channels = {name: np.ascontiguousarray(image[:, :, i], dtype=np.float32) for i, name in enumerate(CHANNELS)}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    if variance is not None:
        for i, name in enumerate(CHANNELS):
            channels["variance." + name] = np.ascontiguousarray(variance[:, :, i], dtype=np.float32)
        header["plumb:samplesPerPixel"] = replicates  # to the test, a sample is what is independent: a replicate
    OpenEXR.File(header, channels).write(str(path))


def compare(renderer, a, b, significance, undecided_percent):
    """What `renderer compare` says: "passes", "differs" or "undecided", and the bias that it would have found.

    So many pixels may stay undecided, and none may differ.
    """
    command = [renderer, "compare", a, b, "--flip", "none", "--json", "-", "--quiet",
               "--significance", significance, "--fail-percent", undecided_percent]  # fmt: skip
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if result.returncode not in (0, 3, 4):
        raise RuntimeError(result.stderr)
    found = json.loads(result.stdout)
    noise = found["noise"]
    return {
        "outcome": "differs" if noise["differing"] else found["outcome"],
        "p": noise["p"],
        "differing": noise["differing"],
        "undecided": noise["untested"],
        "pixels": noise["pixels"],
        "detectable_bias": noise["detectable_bias"],
        "means": [found["metrics"]["mean_luminance_a"], found["metrics"]["mean_luminance_b"]],
    }
