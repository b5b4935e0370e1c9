#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bounds from coarser meshes: what a wrong formula would get wrong."""

import math
import sys
import unittest

try:
    from accuracy import axisymmetric, bounds, report
    from accuracy.rows import Row, Section
except ModuleNotFoundError as missing:
    if missing.name.split(".")[0] == "accuracy":
        raise
    print(f"no Python module {missing.name}; run scripts/install_dependencies.sh test")
    sys.exit(77)


class Refined(unittest.TestCase):
    sizes = (4.0, 2.0, 1.0)

    def values(self, order, limit=10.0):
        return [limit + 0.5 * h ** order for h in self.sizes]

    def test_is_the_error_and_a_quarter_where_the_order_is_right(self):
        for order in (1, 2):
            self.assertAlmostEqual(bounds.refined(self.sizes, self.values(order), 10.0, order), 1.25 * 0.05)

    def test_two_meshes_are_trusted_less(self):
        self.assertAlmostEqual(bounds.refined(self.sizes[1:], self.values(1)[1:], 10.0, 1), 3 * 0.05)

    def test_does_not_know_the_error(self):
        # The same changes about a wrong limit give the same bound, which the error then misses.
        wrong = self.values(1, limit=12.0)
        bound = bounds.refined(self.sizes, wrong, -10.0, 1)
        self.assertAlmostEqual(bound, 1.25 * 0.05)
        self.assertFalse(Row("", "", "anp", "", wrong[-1], 10.0, "", bound).passed)


class Extrapolated(unittest.TestCase):
    def test_finds_limit_and_order(self):
        for order in (0.7, 1.0, 2.0, 3.5):
            limit, found = bounds.extrapolated((3.0, 2.0, 1.4), [7.0 - 0.1 * h ** order for h in (3.0, 2.0, 1.4)])
            self.assertAlmostEqual(limit, 7.0)
            self.assertAlmostEqual(found, order)

    def test_says_nothing_of_values_that_do_not_close_in(self):
        for values in ((1.0, 1.1, 1.05), (1.0, 1.0, 1.0), (1.0, 1.1, 1.5)):
            self.assertTrue(math.isnan(bounds.extrapolated((3.0, 2.0, 1.4), values)[0]))


class Page(unittest.TestCase):
    def test_names_who_is_near_to_its_bound(self):
        rows = [Row("a", f"mesh {k}", "anp", "force", 1.0 + e, 1.0, "theory", 0.1) for k, e in enumerate((0.05, 0.095))]
        text = report.page({"a": Section("A case", "", rows)}, {}, "Commit 0")
        self.assertIn("within 10 % of its bound", text)
        near = text[text.index("within 10 % of its bound"):text.index("How to read")]
        self.assertIn("mesh 1", near)
        self.assertNotIn("mesh 0", near)
        self.assertIn("No figure is within 10 % of its bound", report.page(
            {"a": Section("A case", "", rows[:1])}, {}, "Commit 0"))


class Axis(unittest.TestCase):
    def test_is_even_near_the_ball_and_ends_where_it_should(self):
        x = axisymmetric.axis(0.010, 0.002, 0.2, 0.060)
        steps = [b - a for a, b in zip(x, x[1:])]
        self.assertEqual((x[0], round(x[-1], 12)), (0.0, 0.060))
        for step in steps[:5]:
            self.assertAlmostEqual(step, 0.002)
        self.assertTrue(all(0.99 < b / a < 1.4 or k < 5 for k, (a, b) in enumerate(zip(steps, steps[1:]))))


if __name__ == "__main__":
    unittest.main()
