#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live node's states are those of a replay of the inputs that its cycles used, to the bit."""
import csv
import math
import os
import subprocess
import sys
import tempfile
import time
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import JOINTS, Hand, joint_state, report_ear  # noqa: E402

SCENE = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes", "block_exact.yaml")
STEP = 0.015625
LENGTH = 2.5  # of the hand's way [s]


def way(t):
    """Joint positions: into the block by 4 mm, along it and out again."""
    down = 0.5 * (1.0 - math.cos(2.0 * math.pi * t / LENGTH))
    return [0.003 * math.sin(3.0 * t), 0.002 * t, -0.06 - 0.009 * down, 0.1 * t, 0.6, 0.05 * math.sin(t)]


class SameBits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_service("/palpate/reset", 30)
        cls.reset = rospy.ServiceProxy("/palpate/reset", Trigger)
        cls.hand = Hand()
        cls.reports = report_ear()

    def lead(self):
        """The positions of each stamp that was sent on one way of the hand."""
        sent = {}
        begin = time.monotonic()

        def make():
            m = joint_state(0.0, positions=way(time.monotonic() - begin))
            sent[m.header.stamp.to_nsec()] = m.position
            return m

        self.hand.send(make)
        time.sleep(LENGTH)
        self.hand.stop()
        time.sleep(0.5)  # its input is stale: no more cycles
        return sent

    def cycles(self):
        """The reports of cycles one after another from the first, until one was not published."""
        stepped = []
        for m in self.reports.all():
            number = round(m.time / STEP)
            if number == len(stepped) + 1:
                stepped.append(m)
        return stepped

    def replay(self, folder, cycles, sent):
        trajectory, out = os.path.join(folder, "way.csv"), os.path.join(folder, "out.csv")
        with open(trajectory, "w") as file:
            file.write(",".join(["t"] + JOINTS) + "\n")
            for k, m in enumerate(cycles):
                file.write(",".join(repr(x) for x in [k * STEP] + list(sent[m.header.stamp.to_nsec()])) + "\n")
        program = roslib.packages.find_node("palpate", "palpate")[0]
        subprocess.run([program, "replay", SCENE, "--trajectory", trajectory, "--out", out], check=True,
                       stdout=subprocess.DEVNULL)
        with open(out) as file:
            return [int(row["state_hash"], 16) for row in csv.DictReader(file)]

    def test_node_against_replay(self):
        for _ in range(3):  # where the machine stood still, a report may be replaced by the next
            self.reset()
            self.reports.clear()
            sent = self.lead()
            cycles = self.cycles()
            if len(cycles) > 100:
                break
        self.assertGreater(len(cycles), 100)
        self.assertGreater(sum(m.contacts > 0 for m in cycles), 30)
        live = [m.state_hash for m in cycles]
        self.assertGreater(len(set(live)), 60)
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.replay(folder, cycles, sent), live)


if __name__ == "__main__":
    rospy.init_node("same_bits_test")
    rostest.rosrun("palpate", "same_bits_test", SameBits)
