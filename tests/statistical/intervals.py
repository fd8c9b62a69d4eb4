"""The arithmetic of stated intervals: Student's factor, how often they hold the truth, how wide they had to be."""

import math
import statistics

REPLICATES = 8  # independent runs behind each stated standard error (engine/simulate/replicates.h)
STUDENT_95 = {4: 2.776, 7: 2.365, 15: 2.131, 31: 2.040}  # two-sided 95 % by degrees of freedom (any table)
NORMAL_95 = 1.960


def half_width(standard_error, replicates=REPLICATES):
    return STUDENT_95[replicates - 1] * standard_error


def least_hits(runs, chance=0.95, false_alarm=0.01):
    """The smallest number of hits that an honest interval undercuts with at most `false_alarm`.

    182 of 200 at 0.01: exact coverage gives 190 +- 3."""
    cumulated = 0.0
    for hits in range(runs + 1):
        cumulated += math.comb(runs, hits) * chance ** hits * (1 - chance) ** (runs - hits)
        if cumulated > false_alarm:
            return hits
    return runs


class Quantity:
    """One number that every seed estimates: its values, what each run stated, and the truth."""

    def __init__(self, name, truth, truth_error=0.0):
        self.name, self.truth, self.truth_error = name, truth, truth_error
        self.values, self.half_widths, self.bias_estimates = [], [], []

    def add(self, value, standard_error, bias_estimate=0.0):
        self.values.append(value)
        self.half_widths.append(half_width(standard_error))
        self.bias_estimates.append(bias_estimate)

    def hits(self):
        """Runs whose statistical interval holds the truth; that one is known to `truth_error` and not better."""
        return self._hits(0.0)

    def hits_with_bias(self):
        """The same for intervals that are widened by the stated bias."""
        return self._hits(1.0)

    def _hits(self, bias_share):
        return sum(abs(value - self.truth) <= width + bias_share * abs(bias) + NORMAL_95 * self.truth_error
                   for value, width, bias in zip(self.values, self.half_widths, self.bias_estimates))

    def spread(self):
        return statistics.stdev(self.values)

    def width_ratio(self):
        """Mean half width to the one that an interval of exact coverage needs, 1.96 standard deviations."""
        return statistics.fmean(self.half_widths) / max(NORMAL_95 * self.spread(), 1e-300)

    def bias(self):
        """(true bias, its standard error), of the mean over the runs."""
        error = math.hypot(self.spread() / math.sqrt(len(self.values)), self.truth_error)
        return statistics.fmean(self.values) - self.truth, error

    def summary(self):
        bias, bias_error = self.bias()
        return {"quantity": self.name, "runs": len(self.values), "hits": self.hits(),
                "hits_with_bias": self.hits_with_bias(), "truth": self.truth,
                "truth_error": self.truth_error, "relative_spread": self.spread() / self.truth,
                "width_ratio": self.width_ratio(), "relative_bias": bias / self.truth,
                "relative_bias_error": bias_error / self.truth,
                "stated_relative_bias": statistics.fmean(self.bias_estimates) / self.truth}
