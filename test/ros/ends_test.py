#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""However the node ends, the last wrench that a device has heard is zero."""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from geometry_msgs.msg import WrenchStamped

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import ABOVE, TOUCHING, Ear, Hand, Programs, force, wrench_ear  # noqa: E402

SCENES = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes")
DEVICE = "master/body/servo_cf"
NODE_RAMP = 0.1  # [s] rates.ramp of block.yaml
GUARD_RAMP, GUARD_PATIENCE = 0.02, 0.05  # [s] defaults of palpate_guard


class Ends(unittest.TestCase):
    def setUp(self):
        self.spatial, self.body, self.device = wrench_ear("spatial"), wrench_ear("body"), Ear(DEVICE, WrenchStamped)
        self.programs = Programs()

    def tearDown(self):
        self.programs.end()
        for ear in (self.spatial, self.body, self.device):
            ear.subscriber.unregister()

    def node(self):
        return self.programs.node("palpate_node", "__name:=palpate", "_scene:=" + os.path.join(SCENES, "block.yaml"))

    def guard(self):
        return self.programs.node("palpate_guard", "__name:=guard", "_input:=probe/body/measured_cf", "_output:=" + DEVICE)

    def press(self, ear=None):
        hand = Hand()
        hand.hold(ABOVE)
        rospy.wait_for_service("/palpate/reset", 30)
        time.sleep(0.5)
        ear = ear or self.spatial
        ear.clear()  # of what an earlier node has said
        hand.hold(TOUCHING)
        self.assertIsNotNone(ear.wait(lambda m: force(m) > 0.02))
        time.sleep(0.5)
        self.hand = hand
        return force(ear.last())

    def ends_in_zeros(self, ear, before, ramp, silence=0.0, late=0.2):
        """The wrench goes in a ramp of so many seconds, and at least ten zeros follow.

        Between two messages it goes as far as the time between them allows, and by `late` of `before` more,
        since neither is sent and heard at the same moment. The first long gap is the `silence` [s] in which a guard
        still waits: that much of it lets nothing go.
        """
        heard = [(t, force(m)) for t, m in ear.timed()]
        forces = [f for _, f in heard]
        for (t0, f0), (t1, f1) in zip(heard, heard[1:]):
            gap = t1 - t0
            if silence and gap > 0.5 * silence:
                gap, silence = max(0.0, gap - silence), 0.0
            self.assertLess(abs(f1 - f0), before * (late + gap / ramp), "%.4f s apart" % (t1 - t0))
        zeros = next((i for i, f in enumerate(reversed(forces)) if f != 0.0), len(forces))
        self.assertGreaterEqual(zeros, 10)

    def test_signals_and_rosnode_kill(self):
        for how in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, "rosnode"):
            node = self.node()
            before = self.press()
            self.spatial.clear()
            self.body.clear()
            asked = time.monotonic()
            if how == "rosnode":
                subprocess.check_call(["rosnode", "kill", "/palpate"], stdout=subprocess.DEVNULL)
            else:
                node.send_signal(how)
            self.assertEqual(node.wait(10), 0, how)
            took = time.monotonic() - asked
            self.assertLess(took, 3.0 if how == "rosnode" else 1.0, how)
            time.sleep(0.3)
            self.ends_in_zeros(self.spatial, before, NODE_RAMP)
            self.ends_in_zeros(self.body, before, NODE_RAMP)
            self.hand.stop()

    def test_a_scene_that_fails_sends_zeros(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(SCENES, "block.yaml")) as f:
                text = f.read().replace("block.msh", "nowhere.msh").replace(
                    "urdf: probe.urdf", "urdf: " + os.path.join(SCENES, "probe.urdf"))
            bad = os.path.join(folder, "bad.yaml")
            with open(bad, "w") as f:
                f.write(text)
            node = self.programs.node("palpate_node", "__name:=palpate", "_scene:=" + bad)
            self.assertEqual(node.wait(20), 2)
        time.sleep(0.3)
        self.assertGreaterEqual(len(self.spatial.all()), 10)
        self.assertEqual({force(m) for m in self.spatial.all()}, {0.0})

    def test_a_second_interrupt_ends_it_at_once(self):
        node = self.node()
        self.press()
        node.send_signal(signal.SIGINT)
        node.send_signal(signal.SIGINT)
        self.assertIn(node.wait(1), (-signal.SIGINT, 0))
        self.hand.stop()

    def test_with_a_guard_even_a_killed_node_leaves_a_zero(self):
        guard, node = self.guard(), self.node()
        before = self.press(self.device)
        self.assertAlmostEqual(force(self.body.last()), before, delta=0.02 * before)
        self.device.clear()
        node.kill()
        killed = time.monotonic()
        self.assertIsNotNone(self.device.wait(lambda m: force(m) == 0.0, 1.0))
        self.assertLess(time.monotonic() - killed, 0.2)
        time.sleep(0.3)
        self.ends_in_zeros(self.device, before, GUARD_RAMP, GUARD_PATIENCE)
        # The guard goes, too: the device has its zero.
        self.device.clear()
        guard.send_signal(signal.SIGINT)
        self.assertEqual(guard.wait(5), 0)
        time.sleep(0.2)
        self.assertGreaterEqual(len(self.device.all()), 10)
        self.assertEqual({force(m) for m in self.device.all()}, {0.0})
        self.hand.stop()

    def test_a_guard_that_ends_takes_the_wrench_back(self):
        guard = self.guard()
        self.node()
        before = self.press(self.device)
        self.device.clear()
        guard.send_signal(signal.SIGTERM)
        self.assertEqual(guard.wait(5), 0)
        time.sleep(0.2)
        self.ends_in_zeros(self.device, before, GUARD_RAMP, GUARD_PATIENCE)
        self.hand.stop()

    def test_a_guard_says_what_it_needs(self):
        done = subprocess.run([roslib.packages.find_node("palpate", "palpate_guard")[0], "__name:=lost"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=20, universal_newlines=True)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("must be a topic", done.stdout)


if __name__ == "__main__":
    rospy.init_node("ends_test")
    rostest.rosrun("palpate", "ends_test", Ends)
