#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live node with tf frames as input, with tf that never comes, and with tf of strangers."""
import math
import os
import sys
import threading
import time
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Log
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import (  # noqa: E402
    Ear, bytes_of, diagnostics_ear, force, memory, numbers, report_ear, status, transform, wrench_ear)
from tcpros import Speaker, slave  # noqa: E402


class Tf(unittest.TestCase):
    height, moves = 0.05, False

    @classmethod
    def setUpClass(cls):
        tf = rospy.Publisher("/tf", TFMessage, queue_size=1, tcp_nodelay=True)

        def move():
            while not rospy.is_shutdown():
                if cls.moves:
                    tf.publish(TFMessage([transform("world", "tool/tip", cls.height)]))
                time.sleep(0.01)

        threading.Thread(target=move, daemon=True).start()

    def hold(self, height):
        type(self).height, type(self).moves = height, height is not None

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

        self.hold(0.05)
        self.assertIsNotNone(reports.wait(lambda m: m.state == "RUNNING", 5.0))
        self.hold(0.032)
        self.assertIsNotNone(spatial.wait(lambda m: force(m) > 0.02, 5.0))
        time.sleep(0.3)
        self.assertEqual(body.last().header.frame_id, "tool/tip")
        f = body.last().wrench.force
        self.assertAlmostEqual(f.x / f.z, -math.tan(0.6), delta=0.1)

        # It stops: paused, and the force goes.
        reports.clear()
        spatial.clear()
        self.hold(None)
        self.assertIsNotNone(reports.wait(lambda m: m.state == "PAUSED", 3.0))
        self.assertIsNotNone(spatial.wait(lambda m: force(m) == 0.0, 3.0))
        for m in spatial.all() + body.all():
            self.assertTrue(all(math.isfinite(x) for x in numbers(m)))

    def test_what_strangers_say_changes_nothing(self):
        """After the other one, in the order of their names."""
        reports, spatial, diagnostics = report_ear(), wrench_ear(), diagnostics_ear()
        pid = slave("/palpate").getPid("/stranger")[2]
        self.hold(0.05)
        self.assertIsNotNone(reports.wait(lambda m: m.state == "RUNNING", 5.0))
        self.hold(0.032)
        self.assertIsNotNone(spatial.wait(lambda m: force(m) > 0.02, 5.0))
        time.sleep(0.5)
        held, before = force(spatial.last()), memory(pid)
        stranger = Speaker("/tf", TFMessage)
        fixed = Speaker("/tf_static", TFMessage, "/fixed_stranger")
        for ear in reports, spatial, diagnostics:
            ear.clear()
        now, late, never = rospy.Time.now(), rospy.Time.now() + rospy.Duration(1000.0), rospy.Time(0xffffffff)
        nan = float("nan")
        for k in range(30):
            stranger.send(bytes_of(TFMessage([
                transform("world", "tool/tip", 0.05, late), transform("world", "tool/tip", 0.05, never),
                transform("world", "tool/tip", nan), transform("world", "tool/tip", 1e308),
                transform("tool/tip", "world", 1.0), transform("world", "other", 1.0, never),
                transform("a", "b", 1.0, now), transform("b", "a", 1.0, now), transform("", "n" * 100000, 1.0)])))
            stranger.send(bytes_of(TFMessage([transform("world", "f%d" % (1000 * k + i), 1.0) for i in range(1000)])))
            fixed.send(bytes_of(TFMessage([transform("elsewhere", "tool/tip", 1.0),
                                           transform("elsewhere", "s%d" % k, 1.0)])))
            time.sleep(0.02)
        said = diagnostics.wait(lambda d: status(d, "input") and "both publish it" in status(d, "input").message, 3.0)
        self.assertIsNotNone(said)
        self.assertEqual(status(said, "input").level, 2)  # ERROR
        time.sleep(0.3)
        self.assertEqual({m.state for m in reports.all()}, {"RUNNING"})
        for m in spatial.all():
            self.assertAlmostEqual(force(m), held, delta=0.05 * held)
        self.assertLess(memory(pid) - before, 10e6)
        stranger.close()
        fixed.close()


if __name__ == "__main__":
    rospy.init_node("tf_test")
    rostest.rosrun("palpate", "tf_test", Tf)
