#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever comes as joint positions: the node lives, the wrench keeps its limits, and what is right counts again."""
import os
import random
import sys
import threading
import time
import unittest

import rospkg
import rospy
import rostest
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import (  # noqa: E402
    ABOVE, JOINTS, TOUCHING, Programs, bytes_of, diagnostics_ear, force, joint_state, memory, report_ear, status, wrench_ear)
from limits import Limits  # noqa: E402
from tcpros import Speaker  # noqa: E402

SCENE = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes", "block.yaml")
TOPIC = "/probe/measured_js"
LIMITS = Limits(0.4, 0.01, 4.0)  # below what the block answers with
LARGE = 20e6  # [bytes] about the largest message that is sent here
# Such a message may be there three times as it came, read into, queued and looked at, and twice as what is
# made of it, in which a name of 7 letters takes 32 bytes.
LARGEST_GROWTH = 3 * LARGE + 2 * 3 * LARGE


def at(*positions):
    return bytes_of(joint_state(0.0, positions=list(positions)))


class HostileInputs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.programs = Programs()
        cls.node = cls.programs.node("palpate_node", "__name:=palpate", "_scene:=" + SCENE, *LIMITS.parameters())
        rospy.wait_for_service("/palpate/reset", 30)
        cls.spatial, cls.body = wrench_ear("spatial"), wrench_ear("body")
        cls.reports, cls.diagnostics = report_ear(), diagnostics_ear()
        cls.arm = Speaker(TOPIC, JointState, "/arm")
        cls.held, cls.done = None, False
        cls.thread = threading.Thread(target=cls._hold)
        cls.thread.start()

    @classmethod
    def tearDownClass(cls):
        cls.done = True
        cls.thread.join()
        cls.programs.end()

    @classmethod
    def _hold(cls):
        while not cls.done:
            if cls.held is not None:
                cls.arm.send(bytes_of(joint_state(cls.held)))
            time.sleep(0.01)

    def setUp(self):
        self.settle()

    def tearDown(self):
        self.assertIsNone(self.node.poll())
        self.settle()
        for ear in self.spatial, self.body:
            LIMITS.check(self, ear.all())
            ear.clear()

    def send(self, body, seconds, every=0.01):
        type(self).held = None
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.arm.send(body() if callable(body) else body)
            time.sleep(every)

    def settle(self):
        """The tool comes down onto the block, from above in case that it is nowhere, and is felt to the limit."""
        type(self).held = ABOVE
        time.sleep(0.3)
        type(self).held = TOUCHING
        self.is_felt()

    def is_felt(self):
        self.reports.clear()
        self.assertIsNotNone(self.reports.wait(lambda m: m.state == "RUNNING" and m.contacts > 0, 5.0))
        end = time.monotonic() + 5.0
        while abs(force(self.spatial.last()) - 0.4) > 1e-6:
            self.assertLess(time.monotonic(), end, force(self.spatial.last()))
            time.sleep(0.01)

    def is_no_input(self, body, seconds=0.5, every=0.01):
        self.reports.clear()
        self.send(body, seconds, every)
        self.assertIsNotNone(self.reports.wait(lambda m: m.state == "PAUSED", 5.0))
        end = time.monotonic() + 5.0
        while force(self.spatial.last()) != 0.0:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)

    def are_no_input(self, bodies, seconds=0.1):
        """None of them, one after the other: the node stays as it is without an input."""
        self.is_no_input(bodies[0], 0.3)
        self.reports.clear()
        for body in bodies:
            self.send(body, seconds)
        self.assertIsNotNone(self.reports.wait(lambda m: True, 3.0))
        self.assertEqual({m.state for m in self.reports.all()}, {"PAUSED"})

    def said_of_input(self, words):
        said = self.diagnostics.wait(lambda d: status(d, "input") and words in status(d, "input").message, 5.0)
        self.assertIsNotNone(said, words)
        self.diagnostics.clear()
        return status(said, "input")

    def test_stamps_of_any_value(self):
        self.reports.clear()
        for stamp in (rospy.Time(), rospy.Time(1), rospy.Time(0xffffffff), rospy.Time(0x80000000),
                      rospy.Time.now() + rospy.Duration(1e6), rospy.Time.now() - rospy.Duration(1e6)):
            self.send(bytes_of(joint_state(TOUCHING, stamp)), 0.3)
        body = bytes_of(joint_state(TOUCHING))
        for seconds_and_nanoseconds in b"\xff" * 8, b"\0" * 4 + b"\xff" * 4:  # after the number of the message
            self.send(body[:4] + seconds_and_nanoseconds + body[12:], 0.3)
        self.is_felt()
        self.assertEqual({m.state for m in self.reports.all()}, {"RUNNING"})

    def test_numbers_that_are_none_or_not_of_this_world(self):
        bodies = []
        for x in (float("nan"), -float("inf"), 1e308, -1e308, 1e200, 1e30, 2e3):
            bodies += [at(x, 0.0, TOUCHING, 0.0, 0.6, 0.0), at(x, -x, x, x, -x, x)]
        self.are_no_input(bodies)
        self.said_of_input("1 km away")
        self.settle()
        self.send(at(0.0, 0.0, TOUCHING, 1e308, -1e300, 1e17), 0.3)  # an angle like any other
        self.is_felt()

    def test_messages_of_another_shape(self):
        bad = [JointState(), joint_state(0, names=JOINTS, positions=[0.0] * 5), joint_state(0, names=[]),
               joint_state(0, names=JOINTS + ["z"], positions=[0.0] * 7),
               joint_state(0, names=["z"] * 6, positions=[0.0] * 6)]
        good = bytes_of(joint_state(TOUCHING))
        rng = random.Random(5)
        self.are_no_input([bytes_of(m) for m in bad] + [
            lambda: good[:rng.randrange(len(good))],
            lambda: bytes(rng.randrange(256) for _ in range(rng.randrange(400)))])
        # Velocities and efforts are nobody's.
        self.settle()
        more = joint_state(TOUCHING)
        more.velocity, more.effort = [float("nan")], [1e308] * 100
        self.reports.clear()
        self.send(bytes_of(more), 0.5)
        self.assertEqual({m.state for m in self.reports.all()}, {"RUNNING"})

    def test_large_messages_take_no_more_memory_than_they_need(self):
        before = memory(self.node.pid)
        many = bytes_of(joint_state(0, names=["j%06d" % i for i in range(1000000)], positions=[0.0] * 1000000))
        long = bytes_of(joint_state(0, names=["n" * 1000000] * 20, positions=[0.0] * 20))
        for body, words in (many, "names; at most"), (long, "letters"):
            self.assertAlmostEqual(len(body), LARGE, delta=0.1 * LARGE)
            self.is_no_input(body, 1.2, 0.0)
            self.assertLess(len(self.said_of_input(words).message), 1000)
        grown = memory(self.node.pid) - before
        print("memory of the node grew by %.0f MB" % (1e-6 * grown))
        self.assertLess(grown, LARGEST_GROWTH)

    def test_anything_ten_thousand_times_a_second(self):
        rng = random.Random(7)
        kinds = [lambda: at(*[rng.uniform(-0.2, 0.2) for _ in range(6)]),
                 lambda: at(*[rng.gauss(0, 1) * 10 ** rng.uniform(-6, 6) for _ in range(6)]),
                 lambda: at(0.0, 0.0, rng.choice([ABOVE, TOUCHING, -0.08]), 0.0, 0.6, 0.0),
                 lambda: at(*[rng.choice([float("nan"), 1e308, 0.0]) for _ in range(6)]),
                 lambda: bytes_of(joint_state(TOUCHING, rospy.Time(rng.randrange(2 ** 32), rng.randrange(10 ** 9))))]
        bodies = [rng.choice(kinds)() for _ in range(1000)]
        type(self).held = None
        self.reports.clear()
        began, sent = time.monotonic(), 0
        while time.monotonic() < began + 3.0:
            for body in bodies[sent % 1000:sent % 1000 + 10]:
                self.arm.send(body)
            sent += 10
            time.sleep(max(0.0, began + sent / 1e4 - time.monotonic()))
        print("%.0f messages a second, %d cycles" % (sent / (time.monotonic() - began), len(self.reports.all())))
        self.assertGreater(len(self.reports.all()), 0)

    def test_another_publisher_does_not_count_whatever_its_name(self):
        for name in "/other", "/arm":
            stranger = Speaker(TOPIC, JointState, "/stranger", says=name)
            for ear in self.reports, self.spatial, self.diagnostics:
                ear.clear()
            for _ in range(150):
                stranger.send(bytes_of(joint_state(ABOVE)))
                time.sleep(0.01)
            self.assertEqual(self.said_of_input("publish it").level, 2)  # ERROR
            stranger.close()
            self.assertEqual({m.state for m in self.reports.all()}, {"RUNNING"})
            for m in self.spatial.all():
                self.assertAlmostEqual(force(m), 0.4, delta=1e-6)

    def test_parameters_that_change_do_nothing(self):
        changes = {"haptics/max_force": 1000.0, "haptics/max_force_rate": 1e6, "rates/stale_after": 1e6,
                   "scene": "/nowhere", "state_directory": "/", "instruments/probe/joint_topic": "/elsewhere"}
        for name, value in changes.items():
            rospy.set_param("/palpate/" + name, value)
        rospy.set_param("/use_sim_time", True)
        try:
            self.assertTrue(rospy.ServiceProxy("/palpate/reset", Trigger)().success)
            self.settle()
            self.is_no_input(bytes_of(JointState()), 0.4)
        finally:
            rospy.delete_param("/use_sim_time")


if __name__ == "__main__":
    rospy.init_node("hostile_inputs_test")
    rostest.rosrun("palpate", "hostile_inputs_test", HostileInputs)
