#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""rviz shows the shipped scenes without an error: each display, by the configuration that the node makes.

Skipped where there is no python3-rviz or no Xvfb.
"""
import glob
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import rospkg
import rospy
import rostest
from std_msgs.msg import String

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import Ear, Programs  # noqa: E402
from stage import Hands, Screen  # noqa: E402

PACKAGE = rospkg.RosPack().get_path("palpate")
# As another one, but for the organ's model, which rviz does not see.
ALIKE = ("slab_springs", "slab_tensor_mass", "slab_hybrid", "slab_sampled", "slab_bem", "slab_neural", "slab_enriched",
         "interface_2011_fine")
SCENES = sorted(f for f in glob.glob(os.path.join(PACKAGE, "config", "scenes", "*.yaml"))
                if os.path.splitext(os.path.basename(f))[0] not in ALIKE)
STATUSES = os.path.join(PACKAGE, "test", "ros", "rviz_statuses.py")


def missing():
    if not shutil.which("Xvfb"):
        return "no Xvfb"
    found = subprocess.run(["/usr/bin/python3", "-c", "from rviz import bindings"], stderr=subprocess.DEVNULL)
    return "no python3-rviz" if found.returncode else ""


class Displays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if missing():
            raise unittest.SkipTest(missing())
        cls.screen = Screen()

    @classmethod
    def tearDownClass(cls):
        cls.screen.close()

    def setUp(self):
        self.programs, self.hands = Programs(), None

    def tearDown(self):
        if self.hands:
            self.hands.stop()
        self.programs.end()

    def statuses(self, scene, *parameters):
        """By display, and what rviz said on the way."""
        name = os.path.splitext(os.path.basename(scene))[0]
        configs = Ear("/%s/rviz_config" % name, String)
        self.programs.node("palpate_node", "__ns:=" + name, "_scene:=" + scene, "_save_state_at_end:=false", *parameters)
        self.assertIsNotNone(configs.wait(lambda m: True, 120.0), name)
        self.hands = self.hands_of(scene, name)
        with tempfile.NamedTemporaryFile("w", suffix=".rviz") as file:
            file.write(configs.last().data)
            file.flush()
            done = subprocess.run(["/usr/bin/python3", STATUSES, file.name], env=self.screen.environment, timeout=60,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout.splitlines()[-1]), done.stderr

    def hands_of(self, scene, namespace):
        return Hands(scene, namespace)

    def check(self, scene):
        statuses, said = self.statuses(scene)
        wrong = {name: status for name, status in statuses.items() if status[0] != "Ok"}
        self.assertEqual(wrong, {}, scene)
        tools = [name for name in statuses if name.startswith("Instrument ")]
        self.assertTrue(tools, statuses)
        for word in ("TF_REPEATED_DATA", "TF_OLD_DATA", "TF_NO_FRAME_ID"):
            self.assertNotIn(word, said)

    def test_an_error_is_seen(self):
        """What is asserted below can fail: nobody moves the tracked tool, so its display is an error."""
        self.hands_of = lambda scene, namespace: None
        statuses, _ = self.statuses(os.path.join(PACKAGE, "config", "scenes", "gallbladder_tf.yaml"))
        self.assertEqual(statuses["Instrument probe"][0], "Error", statuses)


def add(scene):
    name = os.path.splitext(os.path.basename(scene))[0]
    setattr(Displays, "test_" + name, lambda self: self.check(scene))


for path in SCENES:
    add(path)

if __name__ == "__main__":
    rospy.init_node("displays_test")
    rostest.rosrun("palpate", "displays_test", Displays)
