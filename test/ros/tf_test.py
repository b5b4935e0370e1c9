#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live node with tf frames as input, and with tf that never comes."""
import math
import os
import sys
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from rosgraph_msgs.msg import Log
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import (  # noqa: E402
    Ear, diagnostics_ear, force, numbers, report_ear, status, wrench_ear)


class Tf(unittest.TestCase):
    def test_waits_by_name_then_follows_the_frames(self):
        rospy.wait_for_service("/palpate/reset", 30)
        log, diagnostics = Ear("/rosout", Log), diagnostics_ear()
        reports, spatial, body = report_ear(), wrench_ear("spatial"), wrench_ear("body")

        # Nothing comes: it says for what it waits, and the force is none.
        said = diagnostics.wait(
            lambda d: status(d, "simulation") and status(d, "simulation").message == "WAITING" and
            status(d, "input").level > 0, 5.0)
        self.assertIsNotNone(said)
        waiting = status(said, "input")
        self.assertGreater(waiting.level, 0)
        self.assertIn("tool/tip", waiting.message)
        self.assertIsNotNone(reports.wait(lambda m: m.state == "WAITING", 3.0))
        warned = log.wait(lambda m: m.level == Log.WARN and "tool/tip" in m.msg, 7.0)
        self.assertIsNotNone(warned)
        self.assertGreater(len(spatial.all()), 100)
        self.assertEqual({force(m) for m in spatial.all()}, {0.0})

        height = [0.05]
        stop = threading.Event()

        def move():
            tf = rospy.Publisher("/tf", TFMessage, queue_size=1, tcp_nodelay=True)
            while not stop.is_set():
                t = TransformStamped()
                t.header.stamp = rospy.Time.now()
                t.header.frame_id, t.child_frame_id = "world", "tool/tip"
                t.transform.translation.z = height[0]
                t.transform.rotation.y, t.transform.rotation.w = math.sin(0.3), math.cos(0.3)
                tf.publish(TFMessage([t]))
                time.sleep(0.01)

        threading.Thread(target=move, daemon=True).start()
        self.assertIsNotNone(reports.wait(lambda m: m.state == "RUNNING", 5.0))
        height[0] = 0.032
        self.assertIsNotNone(spatial.wait(lambda m: force(m) > 0.02, 5.0))
        time.sleep(0.3)
        self.assertEqual(body.last().header.frame_id, "tool/tip")
        f = body.last().wrench.force
        self.assertAlmostEqual(f.x / f.z, -math.tan(0.6), delta=0.1)

        # It stops: paused, and the force goes.
        reports.clear()
        spatial.clear()
        stop.set()
        self.assertIsNotNone(reports.wait(lambda m: m.state == "PAUSED", 3.0))
        self.assertIsNotNone(spatial.wait(lambda m: force(m) == 0.0, 3.0))
        for m in spatial.all() + body.all():
            self.assertTrue(all(math.isfinite(x) for x in numbers(m)))


if __name__ == "__main__":
    rospy.init_node("tf_test")
    rostest.rosrun("palpate", "tf_test", Tf)
