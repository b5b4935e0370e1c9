#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live node's states are those of a replay of the inputs that its cycles used, to the bit, of each shipped scene.

The first cycles that touch; all of the trajectories if PALPATE_WHOLE_TRAJECTORIES is set.
"""
import os
import sys
import tempfile
import unittest

import rospkg
import rospy
import rostest

sys.path.insert(0, os.path.join(rospkg.RosPack().get_path("palpate"), "scripts"))
import compare_live  # noqa: E402

TOUCHING = None if os.environ.get("PALPATE_WHOLE_TRAJECTORIES") else 40  # cycles from the first contact on
ENOUGH = 10.0  # [s] of touching in a scene whose cycles are long


class SameBits(unittest.TestCase):
    def test_scenes_with_trajectories_are_found(self):
        self.assertGreaterEqual(len(compare_live.shipped_scenes()), 15)


def add(name):
    def test(self):
        scene = compare_live.Scene(name)
        with tempfile.TemporaryDirectory() as folder:
            cycles, forces, replayed = compare_live.run(scene, folder, touching=TOUCHING, alone=True, until=ENOUGH)
        self.assertIsNone(compare_live.first_apart(cycles, replayed))
        told = [c for c in cycles if c.report]
        touching = [c for c in told if c.report.contacts > 0]
        self.assertGreaterEqual(len(touching), 10)
        self.assertGreater(len({c.report.state_hash for c in touching}), 5)
        self.assertGreater(max(float(abs(f).max()) for f in forces), 0.0)
        self.assertLessEqual({c.report.state for c in told}, {"RUNNING", "FAULT"})

    setattr(SameBits, "test_" + name, test)


for shipped in compare_live.shipped_scenes():
    add(shipped)

if __name__ == "__main__":
    rospy.init_node("same_bits_test")
    rostest.rosrun("palpate", "same_bits_test", SameBits)
