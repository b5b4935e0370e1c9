#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every shipped scene loads in the node, by its name, and waits for the inputs that it names."""
import glob
import os
import subprocess
import sys
import unittest

import roslib.packages
import rospkg
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import diagnostics_ear  # noqa: E402

NODE = roslib.packages.find_node("palpate", "palpate_node")[0]
SCENES = os.path.join(rospkg.RosPack().get_path("palpate"), "config", "scenes", "*.yaml")


class Scenes(unittest.TestCase):
    def test_every_shipped_scene_waits_for_its_input(self):
        names = sorted(os.path.splitext(os.path.basename(f))[0] for f in glob.glob(SCENES))
        self.assertGreaterEqual(len(names), 4)
        diagnostics = diagnostics_ear()
        for name in names:
            node = subprocess.Popen([NODE, "__name:=" + name, "_scene:=" + name])

            def waiting(d, node_name=name):
                return any(s.name == node_name + ": simulation" and s.message == "WAITING"
                           for s in d.status)

            try:
                # The first start fills the organ with tetrahedra.
                self.assertIsNotNone(diagnostics.wait(waiting, 120.0), name)
            finally:
                node.send_signal(2)
                self.assertEqual(node.wait(20), 0, name)


if __name__ == "__main__":
    rospy.init_node("scenes_test")
    rostest.rosrun("palpate", "scenes_test", Scenes)
