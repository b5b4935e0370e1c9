#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live node under /use_sim_time: the clock goes back, as when a bag starts again."""
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


class SimTime(unittest.TestCase):
    def test_a_clock_that_goes_back_resets(self):
        now = [500.0]
        clock = rospy.Publisher("/clock", Clock, queue_size=1)

        def tick():
            while not rospy.is_shutdown():
                clock.publish(Clock(rospy.Time(now[0])))
                now[0] += 0.01
                time.sleep(0.01)

        threading.Thread(target=tick, daemon=True).start()
        rospy.wait_for_service("/palpate/reset", 30)
        reports, spatial, hand = report_ear(), wrench_ear(), Hand()
        hand.send(lambda: joint_state(ABOVE, rospy.Time(now[0])))
        self.assertIsNotNone(reports.wait(lambda m: m.state == "RUNNING", 5.0))
        hand.send(lambda: joint_state(TOUCHING, rospy.Time(now[0])))
        self.assertIsNotNone(spatial.wait(lambda m: force(m) > 0.02, 5.0))
        self.assertIsNotNone(reports.wait(lambda m: m.time > 0.5, 5.0))
        self.assertGreaterEqual(reports.last().header.stamp.to_sec(), 500.0)

        # Back without any input: the state of before is gone, and so is the force.
        hand.stop()
        time.sleep(0.05)
        now[0] = 20.0
        reports.clear()
        self.assertIsNotNone(reports.wait(lambda m: m.state == "WAITING", 3.0))
        spatial.clear()
        self.assertIsNotNone(spatial.wait(lambda m: force(m) == 0.0, 3.0))

        reports.clear()
        hand.send(lambda: joint_state(TOUCHING, rospy.Time(now[0])))
        again = reports.wait(lambda m: m.state == "RUNNING", 3.0)
        self.assertIsNotNone(again)
        self.assertLess(again.time, 0.5)
        self.assertLess(again.header.stamp.to_sec(), 100.0)


if __name__ == "__main__":
    rospy.init_node("sim_time_test")
    rostest.rosrun("palpate", "sim_time_test", SimTime)
