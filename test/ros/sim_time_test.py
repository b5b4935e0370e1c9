#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live node under /use_sim_time: the clock goes back, as when a bag starts again, leaps and stands still."""
import os
import sys
import threading
import time
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Clock

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import ABOVE, TOUCHING, Hand, force, joint_state, report_ear, wrench_ear  # noqa: E402
from limits import Limits  # noqa: E402

LIMITS = Limits(0.4, 0.01, 4.0)
TICK = 0.01


class SimTime(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.now, cls.speed = 500.0, 1.0
        publisher = rospy.Publisher("/clock", Clock, queue_size=1)

        def run():
            while not rospy.is_shutdown():
                publisher.publish(Clock(rospy.Time(cls.now)))
                cls.now += cls.speed * TICK
                time.sleep(TICK)

        threading.Thread(target=run, daemon=True).start()
        rospy.wait_for_service("/palpate/reset", 30)
        cls.reports, cls.spatial, cls.hand = report_ear(), wrench_ear(), Hand()

    def setUp(self):
        self.hold(ABOVE)
        self.reports.clear()
        self.assertIsNotNone(self.reports.wait(lambda m: m.state == "RUNNING", 5.0))
        time.sleep(0.3)
        self.spatial.clear()
        self.hold(TOUCHING)
        self.assertIsNotNone(self.spatial.wait(lambda m: abs(force(m) - 0.4) < 1e-6, 5.0))

    def tearDown(self):
        LIMITS.check(self, self.spatial.all())

    def hold(self, z):
        self.hand.send(lambda: joint_state(z, rospy.Time(self.now)))

    def set_clock(self, now=None, speed=None):
        if now is not None:
            type(self).now = now
        if speed is not None:
            type(self).speed = speed

    def goes_on(self, seconds):
        """Force, state and simulated time of before go on."""
        self.reports.clear()
        first = self.reports.wait(lambda m: m.newton_iterations >= 0, 3.0)
        self.assertIsNotNone(first)
        time.sleep(seconds)
        reports = self.reports.all()
        self.assertEqual({m.state for m in reports}, {"RUNNING"})
        self.assertGreater(reports[-1].time, first.time + 0.2 * seconds)
        self.assertAlmostEqual(force(self.spatial.last()), 0.4, delta=1e-6)

    def test_a_clock_that_goes_back_resets(self):
        self.assertIsNotNone(self.reports.wait(lambda m: m.time > 0.5, 5.0))
        self.assertGreaterEqual(self.reports.last().header.stamp.to_sec(), 500.0)

        # Back without any input: the state of before is gone, and so is the force.
        self.hand.stop()
        time.sleep(0.05)
        self.set_clock(20.0)
        self.reports.clear()
        self.assertIsNotNone(self.reports.wait(lambda m: m.state == "WAITING", 3.0))
        self.assertIsNotNone(self.spatial.wait(lambda m: force(m) == 0.0, 3.0))

        self.reports.clear()
        self.hold(TOUCHING)
        again = self.reports.wait(lambda m: m.state == "RUNNING", 3.0)
        self.assertIsNotNone(again)
        self.assertLess(again.time, 0.5)
        self.assertLess(again.header.stamp.to_sec(), 100.0)

    def test_a_clock_that_stands_still_changes_nothing(self):
        self.set_clock(speed=0.0)
        self.goes_on(1.0)
        self.set_clock(speed=1.0)
        self.goes_on(0.2)

    def test_a_clock_that_leaps_forward_changes_nothing(self):
        for leap in 0.05, 0.5, 1.0e3, 1.0e6, 2.0e9:
            self.set_clock(self.now + leap)
            self.goes_on(0.3)

    def test_a_clock_that_goes_back_a_little_resets_once(self):
        self.assertIsNotNone(self.reports.wait(lambda m: m.time > 0.5, 5.0))
        self.hand.stop()
        time.sleep(0.05)
        self.set_clock(speed=0.0)
        time.sleep(0.05)
        self.reports.clear()
        self.set_clock(self.now - 0.001)
        self.hold(TOUCHING)  # where the tool cannot come back
        again = self.reports.wait(lambda m: m.state == "RUNNING" and m.time < 0.5, 3.0)
        self.assertIsNotNone(again)
        self.assertIsNotNone(self.spatial.wait(lambda m: force(m) == 0.0, 3.0))
        self.set_clock(speed=1.0)
        later = self.reports.wait(lambda m: m.time > again.time + 0.5, 5.0)
        self.assertIsNotNone(later)
        times = [m.time for m in self.reports.all() if m.time < later.time]
        self.assertEqual(times[times.index(again.time):], sorted(times[times.index(again.time):]))

    def test_a_clock_that_goes_to_and_fro_lets_no_force_leap(self):
        for k in range(100):
            self.set_clock(self.now + (1.0 if k % 2 else -0.9))
            time.sleep(TICK)
        self.reports.clear()
        self.assertIsNotNone(self.reports.wait(lambda m: m.state == "RUNNING", 3.0))


if __name__ == "__main__":
    rospy.init_node("sim_time_test")
    rostest.rosrun("palpate", "sim_time_test", SimTime)
