# SPDX-License-Identifier: MIT
"""Errors of images, and what time a renderer would need for an error.

MSE: the mean squared difference to the reference over pixels and channels. relMSE: the same over (reference^2 + 0.01), without the
thousandth of pixels where the reference's noise is largest in this measure, as a few fireflies may outweigh all else. Trimmed
MSE: without the 2 % of pixels where the reference is noisiest, which are the edges of lamps in scenes that show some. To leave out
those pixels where the image errs most would be to choose by what is measured. The reference's own noise is subtracted from all.
"""

import statistics

import numpy as np

OFFSET = 0.01
LEFT_OUT = 0.001
TRIMMED = 0.02
ERRORS = ("mse", "relmse", "trimmed")


def mean_and_variance(replicates):
    """Of their mean."""
    stack = np.array(replicates)
    return stack.mean(axis=0), stack.var(axis=0, ddof=1) / len(stack)


def combine(converged):
    """One reference of several (mean, variance), each weighted by how little noise it has."""
    weights = np.array([1.0 / variance.mean() for _, variance in converged])
    weights /= weights.sum()
    mean = sum(w * m for w, (m, _) in zip(weights, converged))
    return mean, sum(w * w * v for w, (_, v) in zip(weights, converged))


def mean_without(largest, values, by):
    """The mean over pixels, without the fraction of them where `by` is largest."""
    order = np.argsort(by.mean(axis=2).ravel(), kind="stable")
    kept = order[: len(order) - int(largest * len(order))]
    return float(values.mean(axis=2).ravel()[kept].mean())


def errors(image, reference, variance):
    squared = (image - reference) ** 2 - variance
    unit = reference**2 + OFFSET
    return {"mse": float(squared.mean()), "relmse": mean_without(LEFT_OUT, squared / unit, variance / unit),
            "trimmed": mean_without(TRIMMED, squared, variance)}  # fmt: skip


def by_samples(runs):
    """[(samples, [runs])] in the order of their number."""
    return [(n, [run for run in runs if run["spp"] == n]) for n in sorted({run["spp"] for run in runs})]


class Convergence:
    """error = scale samples^-falls, seconds = overhead + each samples, fitted to medians and means over the rounds.

    Where it is not known how the error falls (low-discrepancy sequences), it is fitted, too, between 1/2 and 2.
    """

    def __init__(self, runs, error, falls):
        groups = by_samples(runs)
        self.samples = np.array([n for n, _ in groups], dtype=float)
        self.seconds = np.array([statistics.median(run["seconds"] for run in group) for _, group in groups])
        self.errors = np.array([max(statistics.fmean(run[error] for run in group), 1e-30) for _, group in groups])
        x, y = np.log(self.samples), np.log(self.errors)
        if falls is None:
            falls = float(np.clip(-np.polyfit(x, y, 1)[0], 0.5, 2.0)) if len(x) > 1 else 1.0
        self.falls = falls
        self.scale = float(np.exp(np.mean(y + falls * x)))
        # Least squares of relative deviations, and nothing takes less than no time.
        design = np.stack([np.ones_like(self.samples), self.samples], axis=1) / self.seconds[:, None]
        overhead, each = np.linalg.lstsq(design, np.ones_like(self.seconds), rcond=None)[0]
        if overhead < 0.0 or each <= 0.0:
            overhead, each = 0.0, float(np.mean(self.seconds / self.samples))
        self.overhead, self.each = float(overhead), float(each)

    def samples_to(self, error):
        return (self.scale / error) ** (1.0 / self.falls)

    def seconds_to(self, error):
        """It may need less than one sample of each pixel: that is taken for what it would cost, to tell how much less."""
        return self.overhead + self.each * self.samples_to(error)

    def error_at_samples(self, samples):
        return self.scale * samples**-self.falls

    @property
    def middle_error(self):
        return self.error_at_samples(float(np.sqrt(self.samples[0] * self.samples[-1])))

    def error_after(self, seconds):
        return self.error_at_samples(max(seconds - self.overhead, 1e-9) / self.each)
