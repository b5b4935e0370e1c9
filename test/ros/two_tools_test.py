#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two instruments, each for itself: one may be late, or be lost, while the other goes on."""
import os
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import WrenchStamped

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import ABOVE, TOUCHING, Ear, Hand, diagnostics_ear, force, report_ear, status  # noqa: E402


class TwoTools(unittest.TestCase):
    def expect(self, left, right):
        """What diagnostics say within two seconds of the states of both."""
        def said(d):
            s = status(d, "input")
            values = {v.key: v.value for v in s.values} if s else {}
            return (values.get("state of left"), values.get("state of right")) == (left, right)

        self.diagnostics.clear()
        self.assertIsNotNone(self.diagnostics.wait(said, 3.0), self.diagnostics.last())

    def pressed(self, ear):
        time.sleep(0.5)
        return force(ear.last())

    def test_one_late_arm_and_one_lost_arm_leave_the_other_alone(self):
        rospy.wait_for_service("/palpate/reset", 30)
        self.diagnostics, reports = diagnostics_ear(), report_ear()
        left, right = [Ear(n + "/spatial/measured_cf", WrenchStamped) for n in ("left", "right")]
        hand = {n: Hand(n + "/measured_js") for n in ("left", "right")}

        # The right arm is late.
        hand["left"].hold(ABOVE)
        self.assertIsNotNone(reports.wait(lambda m: m.state == "RUNNING"))
        hand["left"].hold(TOUCHING)
        self.assertIsNotNone(left.wait(lambda m: force(m) > 0.02))
        alone = self.pressed(left)
        self.expect("LIVE", "WAITING")
        self.assertEqual(force(right.last()), 0.0)

        # It appears inside of the block, and waits there without a force.
        hand["right"].hold(TOUCHING)
        time.sleep(0.5)
        self.expect("LIVE", "OUTSIDE")
        self.assertEqual({force(m) for m in right.all()}, {0.0})
        self.assertAlmostEqual(force(left.last()), alone, delta=0.02 * alone)
        hand["right"].hold(ABOVE)
        time.sleep(0.3)
        hand["right"].hold(TOUCHING)
        self.assertIsNotNone(right.wait(lambda m: force(m) > 0.02))
        both = self.pressed(right)
        self.expect("LIVE", "LIVE")

        # The left arm is lost: it fades and leaves; the right one goes on.
        left.clear()
        hand["left"].stop()
        self.assertIsNotNone(left.wait(lambda m: force(m) == 0.0, 2.0))
        forces = [force(m) for m in left.all()]
        self.assertLess(max(abs(a - b) for a, b in zip(forces, forces[1:])), 0.2 * alone)
        self.expect("STALE", "LIVE")
        self.assertAlmostEqual(force(right.last()), both, delta=0.1 * both)
        self.assertEqual(reports.last().state, "RUNNING")

        # And comes back from above.
        hand["left"].hold(ABOVE)
        time.sleep(0.3)
        hand["left"].hold(TOUCHING)
        self.assertIsNotNone(left.wait(lambda m: force(m) > 0.9 * alone))
        self.expect("LIVE", "LIVE")


if __name__ == "__main__":
    rospy.init_node("two_tools_test")
    rostest.rosrun("palpate", "two_tools_test", TwoTools)
