"""Errors of computed values against a reference, and the time at which a goal is reached."""

import math

import numpy as np

# A point darker than this share of the mean is compared with that share: its own value would divide by nothing.
DARKEST_SHARE = 0.01


def compared_with(reference):
    """What the error of each point is relative to."""
    return np.maximum(reference, DARKEST_SHARE * np.mean(reference))


def relative_errors(values, reference):
    values, reference = np.asarray(values, float), np.asarray(reference, float)
    return (values - reference) / compared_with(reference)


def errors(values, reference, reference_noise=0.0):
    """@param reference_noise  relative standard error of a point of the reference, subtracted in quadrature
    @return  mean bias, RMS as found and without that noise, 95th percentile and largest of the absolute errors"""
    relative = relative_errors(values, reference)
    size = np.abs(relative)
    found = math.sqrt(float(np.mean(relative ** 2)))
    return {"mbe": float(relative.mean()), "rms_found": found,
            "rms": math.sqrt(max(found ** 2 - reference_noise ** 2, 0.0)),
            "p95": float(np.quantile(size, 0.95)), "max": float(size.max())}


def median_errors(runs):
    """Each measure's median over the seeds."""
    return {name: float(np.median([run[name] for run in runs])) for name in runs[0]}


def bias_and_noise(values_by_seed, reference):
    """Bias from the mean over the seeds, noise from their spread, both RMS over the points."""
    table = np.array([relative_errors(values, reference) for values in values_by_seed])
    noise = math.sqrt(float(np.mean(table.var(axis=0, ddof=1)))) if len(table) > 1 else 0.0
    bias = math.sqrt(max(float(np.mean(table.mean(axis=0) ** 2)) - noise ** 2 / len(table), 0.0))
    return {"bias_rms": bias, "noise_rms": noise}


def seconds_to_reach(goal, ladder):
    """Time at which the error falls below a goal, between measured settings on logarithmic axes; never extrapolated.

    @param ladder  (seconds, RMS error) of each setting
    @return  (seconds, "") or (None, why not)"""
    steps = sorted(ladder)
    below = [index for index, (_, error) in enumerate(steps) if error <= goal]
    if not below:
        return None, f"not reached: {100 * min(error for _, error in steps):.2f} % at best"
    index = below[0]
    if index == 0:
        return steps[0][0], "or less"
    (t0, e0), (t1, e1) = steps[index - 1], steps[index]
    share = math.log(e0 / goal) / math.log(e0 / max(e1, 1e-9))
    return t0 * (t1 / t0) ** share, ""
