#!/usr/bin/python3
"""The arithmetic of intervals on made-up runs whose coverage is known."""

import pathlib
import random
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from intervals import Quantity, least_hits

TRUTH, SIGMA, RUNS = 100.0, 2.0, 200


def runs_of(narrow=1.0, shift=0.0, seed=1):
    """A quantity from 200 runs of eight normal replicates, stated errors times `narrow`, values off by `shift`."""
    generator = random.Random(seed)
    quantity = Quantity("made up", TRUTH)
    for _ in range(RUNS):
        replicates = [generator.gauss(TRUTH + shift, SIGMA) for _ in range(8)]
        mean = sum(replicates) / 8
        variance = sum((value - mean) ** 2 for value in replicates) / 7
        quantity.add(mean, narrow * (variance / 8) ** 0.5)
    return quantity


class Intervals(unittest.TestCase):
    def test_an_honest_count_is_182_of_200_at_one_in_a_hundred(self):
        self.assertEqual(least_hits(200, false_alarm=0.01), 182)
        self.assertEqual(least_hits(400, false_alarm=0.01), 369)

    def test_honest_intervals_hold_and_are_hardly_wider_than_needed(self):
        for seed in range(1, 6):
            quantity = runs_of(seed=seed)
            self.assertGreaterEqual(quantity.hits(), least_hits(RUNS, false_alarm=1e-5))
            self.assertLess(quantity.width_ratio(), 1.5)  # expected: 2.365 x 0.965 / 1.960 = 1.16
            self.assertGreater(quantity.width_ratio(), 1.0)

    def test_intervals_that_are_too_narrow_are_found(self):
        # Half as wide: Student's t with 7 degrees of freedom lies within 1.18 in 72 of 100 runs.
        self.assertLess(runs_of(narrow=0.5).hits(), least_hits(RUNS))

    def test_a_bias_that_is_not_stated_is_found(self):
        # 1.5 standard errors of a run (0.707).
        quantity = runs_of(shift=1.06)
        self.assertLess(quantity.hits(), least_hits(RUNS))
        bias, error = quantity.bias()
        self.assertLess(abs(bias - 1.06), 5 * error)

    def test_a_stated_bias_widens_only_the_interval_that_is_said_to_hold_it(self):
        quantity = Quantity("off by 3 with an error of 1", TRUTH)
        quantity.add(TRUTH + 3, 1.0, 1.0)
        quantity.add(TRUTH + 3, 1.0, 0.1)
        self.assertEqual((quantity.hits(), quantity.hits_with_bias()), (0, 1))

    def test_intervals_that_are_too_wide_are_found(self):
        self.assertGreater(runs_of(narrow=2.0).width_ratio(), 1.5)


if __name__ == "__main__":
    unittest.main()
