#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ROS master goes and comes back: the node goes on, and is found again."""
import os
import signal
import socket
import subprocess
import sys
import time
import unittest

import rospkg
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import Programs  # noqa: E402

SCENES = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes")


class Master(unittest.TestCase):
    def setUp(self):
        with socket.socket() as s:
            s.bind(("localhost", 0))
            self.port = s.getsockname()[1]
        self.env = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % self.port)
        self.programs = Programs(self.env)

    def tearDown(self):
        self.programs.end()

    def master(self):
        master = self.programs.start("rosmaster", "--core", "-p", str(self.port), stdout=subprocess.DEVNULL)
        self.wait_for(lambda: self.answers("rosnode", "list"), 15.0)
        return master

    def answers(self, *command, timeout=5.0):
        try:
            return subprocess.run(list(command), env=self.env, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                  timeout=timeout, universal_newlines=True).returncode == 0
        except subprocess.TimeoutExpired:
            return False

    def wait_for(self, condition, seconds):
        end = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.1)

    def hears(self, timeout):
        return self.answers("rostopic", "echo", "-n", "1", "/probe/spatial/measured_cf", timeout=timeout)

    def test_the_node_registers_again(self):
        master = self.master()
        node = self.programs.node("palpate_node", "__name:=palpate",
                          "_scene:=" + os.path.join(SCENES, "block.yaml"), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True)
        self.wait_for(lambda: self.answers("rosservice", "info", "/palpate/reset"), 20.0)
        self.assertTrue(self.hears(5.0))

        master.kill()
        master.wait(10)
        time.sleep(1.5)
        self.assertIsNone(node.poll())

        # A new one, that knows nobody: a new subscriber hears the wrench, an input and a service work.
        self.master()
        self.assertTrue(self.hears(5.0))
        hand = self.programs.start("rostopic", "pub", "-r", "100", "/probe/measured_js", "sensor_msgs/JointState",
                          "{header: {stamp: now}, name: [x, y, z, roll, pitch, yaw],"
                          " position: [0.0, 0.0, -0.05, 0.0, 0.0, 0.0]}", stdout=subprocess.DEVNULL)
        self.wait_for(lambda: "RUNNING" in subprocess.run(
            ["rostopic", "echo", "-n", "1", "/step_report/state"], env=self.env, stdout=subprocess.PIPE,
            timeout=10.0, universal_newlines=True).stdout, 15.0)
        self.assertTrue(self.answers("rosservice", "call", "/palpate/reset"))
        hand.kill()

        node.send_signal(signal.SIGINT)
        said = node.communicate(timeout=10)[0]
        self.assertEqual(node.returncode, 0)
        self.assertEqual(said.count("the ROS master is gone"), 1, said)
        self.assertEqual(said.count("registered again"), 1, said)


if __name__ == "__main__":
    rostest.rosrun("palpate", "master_test", Master)
