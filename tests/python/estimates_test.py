#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The errors that tools/bench computes are unbiased: their mean over images with made-up noise is that of the noise.

No argument. Exit status 77 if numpy is missing: skipped.
"""

import sys
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("numpy is not installed")
    sys.exit(77)

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "tools" / "peers"))

import estimates  # noqa: E402

SHAPE = (50, 60, 3)  # of which a thousandth is left out: three pixels
IMAGES = 1500


class Errors(unittest.TestCase):
    def test_mean(self):
        numbers = np.random.default_rng(1)
        truth = numbers.random(SHAPE) ** 3
        deviation = np.broadcast_to(0.05 * np.exp(2.0 * numbers.standard_normal(SHAPE[:2])), (3, *SHAPE[:2])).transpose(1, 2, 0)
        variance = deviation**2 / 50.0  # of the reference
        found = {name: [] for name in estimates.ERRORS}
        for _ in range(IMAGES):
            reference = truth + np.sqrt(variance) * numbers.standard_normal(SHAPE)
            image = truth + deviation * numbers.standard_normal(SHAPE)
            # The weights of relMSE are the reference's, too: take them as they are.
            unit = reference**2 + estimates.OFFSET
            expected = {
                "mse": (deviation**2).mean(),
                "relmse": estimates.mean_without(estimates.LEFT_OUT, ((truth - reference) ** 2 + deviation**2 - variance) / unit, variance / unit),
                "trimmed": estimates.mean_without(estimates.TRIMMED, deviation**2, variance),
            }
            for name, value in estimates.errors(image, reference, variance).items():
                found[name].append(value - expected[name])
        for name, differences in found.items():
            error = np.std(differences, ddof=1) / np.sqrt(IMAGES)
            self.assertLess(abs(np.mean(differences)), 4.0 * error, name)

    def test_without(self):
        values = np.arange(60.0).reshape(4, 5, 3)
        self.assertEqual(estimates.mean_without(0.0, values, values), values.mean())
        # Of 20 pixels, the two with the largest second argument.
        self.assertEqual(estimates.mean_without(0.1, values, -values), values.reshape(20, 3)[2:].mean())


if __name__ == "__main__":
    unittest.main()
