#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A light hand holds the tool by a device that pushes back: it comes to rest in the tissue."""
import os
import sys
import time
import unittest

import rospy
import rostest
from sensor_msgs.msg import JointState

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import Ear, diagnostics_ear, force, report_ear, status, wrench_ear  # noqa: E402


WINDOW = 1.5  # [s]
AT_REST = 2e-4  # [m], four steps of its encoders
# A machine that stops all programs for a third of a second moves the hand by a millimetre, for the force
# was held that long; it then has to come to rest again. A loop that swings never does.
WINDOWS = 8


class FreeHand(unittest.TestCase):
    def watch(self, joints, spatial):
        """How far the hand moves in a window [m], and the least force [N]."""
        for ear in (joints, spatial):
            ear.clear()
        time.sleep(WINDOW)
        z = [m.position[2] for m in joints.all()]
        self.assertGreater(len(z), 500)
        return max(z) - min(z), min(force(m) for m in spatial.all())

    def test_it_rests(self):
        rospy.wait_for_service("/palpate/reset", 30)
        spatial, reports, diagnostics = wrench_ear(), report_ear(), diagnostics_ear()
        joints = Ear("probe/measured_js", JointState)
        self.assertIsNotNone(spatial.wait(lambda m: force(m) > 0.05, 20.0))
        time.sleep(4.0)  # on the way, and three seconds after it
        moved = []
        while len(moved) < WINDOWS and (not moved or moved[-1] >= AT_REST):
            way, least = self.watch(joints, spatial)
            moved.append(way)
        self.assertLess(way, AT_REST, "in windows of %g s: %s mm" % (WINDOW, ["%.3g" % (1e3 * m) for m in moved]))
        self.assertGreater(least, 0.05)
        self.assertEqual({m.state for m in reports.all()[-100:]}, {"RUNNING"})
        said = diagnostics.wait(lambda d: status(d, "haptic loop") is not None, 3.0)
        values = {v.key: v.value for v in status(said, "haptic loop").values}
        self.assertLess(float(values["energy out of a port, at most [mJ]"]), 1.0)


if __name__ == "__main__":
    rospy.init_node("free_hand_test")
    rostest.rosrun("palpate", "free_hand_test", FreeHand)
