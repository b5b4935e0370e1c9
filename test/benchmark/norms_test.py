#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error norms, Pareto fronts, exponents, goals: what a wrong formula would get wrong."""

import json
import math
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

try:
    import numpy as np

    from work_precision import bracket, converged, jumps, norms, replays
    from work_precision.runs import P99_CYCLES, Config, Run
    from work_precision.suites.kernels import fastest
    from work_precision.suites.reach import Goal
except ModuleNotFoundError as missing:
    if missing.name.split(".")[0] in ("accuracy", "work_precision"):
        raise
    print(f"no Python module {missing.name}; run scripts/install_dependencies.sh test")
    sys.exit(77)


class ForceError(unittest.TestCase):
    times = np.array([0.1, 0.2, 0.3, 0.4])
    reference = np.array([[0, 0, 1.0], [0, 0, 2.0], [0, 0, -4.0], [0, 3.0, 0]])

    def test_none_against_itself(self):
        self.assertEqual(norms.force_error(self.times, self.reference, self.times, self.reference), (0, 0))

    def test_is_a_part_of_the_largest_reference_force(self):
        # Off by 0.4 in x at two of the run's two times; the largest force, 4 N, is not among them.
        run = self.reference[[1, 3]] + np.array([0.4, 0, 0])
        rms, largest = norms.force_error(self.times[[1, 3]], run, self.times, self.reference)
        self.assertAlmostEqual(rms, 0.1)
        self.assertAlmostEqual(largest, 0.1)

    def test_rms_and_maximum(self):
        run = self.reference + np.array([[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 2.0]])
        rms, largest = norms.force_error(self.times, run, self.times, self.reference)
        self.assertAlmostEqual(rms, 0.25)  # sqrt(2^2 / 4) / 4
        self.assertAlmostEqual(largest, 0.5)

    def test_times_that_rounding_moved_are_the_same(self):
        times = self.times + np.array([1e-16, -1e-16, 1e-12, 0])
        self.assertEqual(norms.force_error(times, self.reference, self.times, self.reference)[1], 0)

    def test_a_time_that_the_reference_lacks_is_refused(self):
        for time in (0.25, 0.5, 0.05):
            with self.assertRaises(ValueError):
                norms.force_error(np.array([time]), self.reference[:1], self.times, self.reference)

    def test_no_force_is_refused(self):
        with self.assertRaises(ValueError):
            norms.force_error(self.times, self.reference, self.times, 0 * self.reference)


class DisplacementError(unittest.TestCase):
    def test_relative_over_nodes_and_times(self):
        reference = np.zeros((2, 5, 3))
        reference[1, 2] = [3.0, 0, 4.0]
        run = reference.copy()
        run[0, 0, 1] = 0.5
        times = np.array([0.1, 0.2])
        self.assertAlmostEqual(norms.displacement_error(times, run, times, reference), 0.1)
        # A reference with more frames.
        more = np.concatenate([reference[:1], np.ones((1, 5, 3)), reference[1:]])
        self.assertAlmostEqual(
            norms.displacement_error(times, run, np.array([0.1, 0.15, 0.2]), more), 0.1)

    def test_a_reference_that_does_not_move_has_no_scale(self):
        still = np.zeros((1, 5, 3))
        self.assertTrue(math.isnan(norms.displacement_error(np.zeros(1), still, np.zeros(1), still)))


class ConvergedForce(unittest.TestCase):
    def run_of(self, times, forces, failed=False):
        return mock.Mock(failed=failed, forces=lambda: (times, forces))

    def test_is_judged_while_the_run_lasts(self):
        times = np.array([0.1, 0.2, 0.3])
        forces = np.array([[0, 0, 1.0], [0, 0, 2.0], [0, 0, 8.0]])
        limit = converged.Converged(times, forces, [], 8.0, 2.0, 0.0)
        rms, largest = limit.errors(self.run_of(times[:2], forces[:2] + [0, 0, 0.5]))
        self.assertAlmostEqual(rms, 0.25)  # of 2 N, not of the 8 N that come later
        self.assertAlmostEqual(largest, 0.25)
        self.assertTrue(math.isnan(limit.errors(self.run_of(times, forces, failed=True))[0]))

    def test_extrapolates_the_two_finest_at_each_time(self):
        times, exact = np.array([0.1, 0.2]), np.array([[0, 0, 3.0], [1.0, 0, 5.0]])

        def kept(config):
            grown = exact * (1 + 1e4 * config.finest ** 2)
            return mock.Mock(summary={"tets": 6}, forces=lambda: (times, grown))
        found = converged.converged(mock.Mock(kept=kept), "cube", 0.45)
        np.testing.assert_allclose(found.forces, exact, atol=1e-12)
        self.assertAlmostEqual(found.limit, norms.peak(exact))
        self.assertAlmostEqual(found.order, 2.0)
        self.assertGreater(found.unknown, 0.0)


class Pareto(unittest.TestCase):
    def test_front_by_cost(self):
        errors = [1.0, 0.5, 0.7, 0.1, 0.4, math.nan]
        costs = [1.0, 2.0, 3.0, 5.0, 5.0, 0.1]
        self.assertEqual(norms.pareto(errors, costs), [0, 1, 3])

    def test_of_equals_one(self):
        self.assertEqual(len(norms.pareto([1.0, 1.0], [2.0, 2.0])), 1)

    def test_empty(self):
        self.assertEqual(norms.pareto([], []), [])


class CostAt(unittest.TestCase):
    def test_along_a_power_law(self):
        errors = [0.4, 0.2, 0.1, 0.05]
        self.assertAlmostEqual(norms.cost_at(0.08, errors, [3.0 * e ** -2 for e in errors]), 3.0 * 0.08 ** -2)

    def test_all_better_or_all_worse(self):
        self.assertEqual(norms.cost_at(0.5, [0.4, 0.2], [1.0, 2.0]), 1.0)
        self.assertTrue(math.isnan(norms.cost_at(0.08, [0.4, 0.1], [1.0, 2.0])))
        self.assertTrue(math.isnan(norms.cost_at(0.08, [], [])))

    def test_a_failed_mesh_is_no_neighbour(self):
        self.assertEqual(norms.cost_at(0.08, [0.4, math.nan, 0.05], [1.0, 2.0, 4.0]), 4.0)


class Brackets(unittest.TestCase):
    force = np.array([[0, 0, 0.0], [0, 0, 1.3], [0, 0, 2.4], [0, 0, 1.3]])
    truth = np.array([[0, 0, 0.0], [0, 0, 1.0], [0, 0, 2.0], [0, 0, 1.0]])

    def test_at_the_largest_true_force_and_over_all_cycles_that_touch(self):
        found = bracket.bracket(self.force, np.array([0.0, 0.2, 0.5, 0.31]), self.truth)
        self.assertAlmostEqual(found.force, 2.4)
        self.assertAlmostEqual(found.estimate, 0.5)
        self.assertAlmostEqual(found.error, 0.4)
        self.assertTrue(found.holds)
        self.assertAlmostEqual(found.share, 2 / 3)
        self.assertFalse(bracket.bracket(self.force, np.array([0, 0.4, 0.3, 0.4]), self.truth).holds)

    def test_a_force_that_points_elsewhere_is_wrong_too(self):
        found = bracket.bracket(self.truth[:, [2, 1, 0]], np.full(4, 0.5), self.truth)
        self.assertAlmostEqual(found.error, 2.0 * math.sqrt(2.0))
        self.assertFalse(found.holds)


class Jumps(unittest.TestCase):
    def played(self, forces, changes):
        columns = {"mesh_changes": np.array(changes)}
        return mock.MagicMock(forces=np.array([[0, 0, f] for f in forces]), peak=max(forces),
                              __getitem__=lambda _, key: columns[key])

    def test_steps_of_a_steady_push_are_its_own(self):
        np.testing.assert_allclose(jumps.steps(np.array([[0, 0, 0.5 * k] for k in range(4)])), [0, 0.5, 0.5, 0.5])

    def test_those_at_changes_are_compared_with_the_others_near_them(self):
        forces = [1.0 + k + 0.5 * (k >= 6) + 0.2 * (k >= 8) + 7.0 * (k >= 30) for k in range(40)]
        found = jumps.Jumps(self.played(forces, [int(k in (6, 20)) for k in range(40)]))
        peak = forces[-1]
        self.assertEqual(found.changes, 2)
        self.assertAlmostEqual(found.largest * peak, 1.5)
        self.assertAlmostEqual(found.elsewhere * peak, 8.0)
        self.assertAlmostEqual(found.excess * peak, 0.3)  # over the 1.2 near it, not the 8 far away
        self.assertAlmostEqual(found.rms * peak, math.sqrt((1.5 ** 2 + 1.0) / 2))
        self.assertEqual(found.above, 0)
        self.assertEqual(found.added, 0.0)

    def test_what_does_not_touch_does_not_count(self):
        found = jumps.Jumps(self.played([0.0, 0.0, 2.0, 2.0, 2.0], [1, 1, 1, 0, 0]))
        self.assertEqual((found.changes, found.largest), (0, 0.0))


class Scenes(unittest.TestCase):
    def test_copies_change_nothing_else(self):
        scene = replays.shipped("liver_palpation")
        before = json.dumps(scene)
        other = replays.but(replays.adapted(scene, 0.002, 1.0), solver={"step": 0.005, "threads": None})
        self.assertEqual(json.dumps(scene), before)
        self.assertEqual(other["organs"][0]["adapt"], {"finest": 0.002, "growth": 1.0})
        self.assertEqual(other["solver"]["step"], 0.005)
        self.assertNotIn("threads", other["solver"])
        self.assertNotIn("adapt", replays.adapted(other, None)["organs"][0])

    def test_paths_are_whole(self):
        scene = replays.shipped("kidney_grasper")
        for file in (scene["organs"][0]["surface"], scene["instruments"][0]["urdf"]):
            self.assertTrue(pathlib.Path(file).is_file(), file)

    def test_viscous_terms_are_left_out_of_files_too(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "m.yaml"
            file.write_text("law: neo_hookean\nmu: 1.0e3\nsources: []\nviscoelastic:\n- {g: 0.5, tau: 1.0}\n")
            scene = {"organs": [{"material": {"file": str(file), "density": 1000.0}}]}
            found, was = replays.elastic(scene)
            self.assertTrue(was)
            self.assertEqual(found["organs"][0]["material"], {"law": "neo_hookean", "mu": "1.0e3", "density": 1000.0})
            self.assertEqual(replays.elastic(found), (found, False))


class Exponent(unittest.TestCase):
    def test_power_law(self):
        sizes = np.array([1e3, 5e3, 5e4])
        self.assertAlmostEqual(norms.exponent(sizes, 3.0 * sizes ** 1.25), 1.25)

    def test_needs_two_sizes(self):
        with self.assertRaises(ValueError):
            norms.exponent([1.0], [1.0])


class Goals(unittest.TestCase):
    def test_at_most(self):
        self.assertTrue(Goal("a", 1.0, 1.0, "ms").reached)
        missed = Goal("a", 3.0, 1.5, "ms")
        self.assertFalse(missed.reached)
        self.assertIn("2.00", missed.verdict())

    def test_at_least(self):
        self.assertTrue(Goal("a", 1.6, 1.5, "x", least=True).reached)
        self.assertIn("1.50", Goal("a", 1.0, 1.5, "x", least=True).verdict())

    def test_an_aim_of_later_says_so(self):
        self.assertEqual(Goal("a", 1.0, 1.0, "ms", later="added after measuring").verdict(),
                         "reached; added after measuring")

    def test_nothing_measured_reaches_nothing(self):
        for least in (False, True):
            goal = Goal("a", math.nan, 1.0, "ms", least=least)
            self.assertFalse(goal.reached)
            self.assertIn("not measured", goal.verdict())


class Configs(unittest.TestCase):
    def test_arguments_and_names(self):
        config = Config("cube", tets=6, poisson_ratio=0.45, sets=("solver.step=0.01", "contact.smoothing=1"))
        self.assertEqual(config.arguments(), ["--scene", "cube", "--tets", "6", "--poisson-ratio", "0.45",
                                              "--set", "solver.step=0.01", "--set", "contact.smoothing=1"])
        self.assertNotEqual(config.name(), config.but(poisson_ratio=0.49).name())
        self.assertEqual(config.name(), config.but(tets=6).name())


class Percentile(unittest.TestCase):
    def test_needs_enough_cycles_in_all_repeats(self):
        for repeats, text in ((P99_CYCLES // 50, "3.50"), (P99_CYCLES // 50 - 1, "-")):
            with tempfile.TemporaryDirectory() as folder:
                summary = {"cycles": 50, "repeats": repeats, "fastest": {"p99_ms": 1.0}, "pooled": {"p99_ms": 3.5}}
                (pathlib.Path(folder) / "summary.json").write_text(json.dumps(summary))
                self.assertEqual(Run(None, pathlib.Path(folder)).p99_text, text)


class Kernels(unittest.TestCase):
    def test_fastest_of_the_repetitions_in_nanoseconds(self):
        entry = {"name": "a/real_time", "run_type": "iteration", "time_unit": "us"}
        mean = {**entry, "name": "a/real_time_mean", "run_type": "aggregate", "real_time": 0.1}
        found = fastest([{**entry, "real_time": 3.0}, {**entry, "real_time": 2.0}, mean])
        self.assertEqual(list(found), ["a"])
        self.assertEqual(found["a"]["ns"], 2000.0)


if __name__ == "__main__":
    unittest.main()
