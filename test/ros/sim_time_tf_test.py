#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live node with tf frames as input and simulated time that goes back."""
import os
import sys
import threading
import time
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import force, report_ear, transform, wrench_ear  # noqa: E402

TICK = 0.005  # [s]


class SimTimeTf(unittest.TestCase):
    now, height = 500.0, None

    @classmethod
    def setUpClass(cls):
        clock = rospy.Publisher("/clock", Clock, queue_size=1)
        tf = rospy.Publisher("/tf", TFMessage, queue_size=1, tcp_nodelay=True)

        def run():
            while not rospy.is_shutdown():
                clock.publish(Clock(rospy.Time(cls.now)))
                if cls.height is not None:
                    tf.publish(TFMessage([transform("world", "tool/tip", cls.height, rospy.Time(cls.now))]))
                cls.now += TICK
                time.sleep(TICK)

        threading.Thread(target=run, daemon=True).start()
        rospy.wait_for_service("/palpate/reset", 30)

    def hold(self, height):
        type(self).height = height

    def test_poses_of_a_time_to_come_count_no_more(self):
        """They are in the listener's buffer until another transform comes, and none does."""
        reports, spatial = report_ear(), wrench_ear()
        self.hold(0.05)
        self.assertIsNotNone(reports.wait(lambda m: m.state == "RUNNING", 5.0))
        self.hold(0.032)
        self.assertIsNotNone(spatial.wait(lambda m: force(m) > 0.02, 5.0))
        self.hold(None)
        time.sleep(0.05)
        reports.clear()
        type(self).now = 20.0
        self.assertIsNotNone(reports.wait(lambda m: m.state == "WAITING", 3.0))
        self.assertIsNotNone(spatial.wait(lambda m: force(m) == 0.0, 3.0))
        time.sleep(0.5)
        states = [m.state for m in reports.all()]
        self.assertEqual(set(states[states.index("WAITING"):]), {"WAITING"})

        self.hold(0.05)
        self.assertIsNotNone(reports.wait(lambda m: m.state == "RUNNING" and m.time < 0.5, 3.0))


if __name__ == "__main__":
    rospy.init_node("sim_time_tf_test")
    rostest.rosrun("palpate", "sim_time_tf_test", SimTimeTf)
