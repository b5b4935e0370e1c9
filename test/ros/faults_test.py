#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs of the graph that die, stop, do not listen or take the processor: what the hand feels of it."""
import os
import signal
import sys
import time
import unittest

import rospkg
import rospy
import rostest
from geometry_msgs.msg import WrenchStamped
from palpate.msg import StepReport
from visualization_msgs.msg import MarkerArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import (  # noqa: E402
    ABOVE, TOUCHING, Ear, Hand, Programs, bytes_of, force, memory, report_ear, wrench_ear)
from limits import Limits  # noqa: E402
from tcpros import Speaker, listen  # noqa: E402

SCENE = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes", "block.yaml")
DEVICE = "master/body/servo_cf"
STALE_AFTER, RAMP = 0.2, 0.1  # [s] of the scene
GUARD_PATIENCE, GUARD_RAMP = 0.05, 0.02  # [s] defaults
LIMITS = Limits(0.4, 0.01, 4.0)
STARTED = 20
LATE = 0.3  # [s] that a machine with other work may be late with anything


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.programs = Programs()
        cls.node = cls.programs.node("palpate_node", "__name:=palpate", "_scene:=" + SCENE, *LIMITS.parameters())
        cls.guard = cls.programs.node("palpate_guard", "__name:=guard", "_input:=probe/body/measured_cf",
                                      "_output:=" + DEVICE, *LIMITS.parameters(""))
        rospy.wait_for_service("/palpate/reset", 30)
        cls.spatial, cls.device = wrench_ear("spatial"), Ear(DEVICE, WrenchStamped)
        cls.reports = report_ear()
        cls.hand = Hand()

    @classmethod
    def tearDownClass(cls):
        cls.programs.end()

    def setUp(self):
        self.hand.hold(ABOVE)
        self.wait(lambda: force(self.spatial.last()) == 0.0 and self.reports.last().state == "RUNNING", "above")
        for ear in self.spatial, self.device, self.reports:
            ear.clear()

    def tearDown(self):
        self.assertIn(self.node.poll(), (None, 0))
        self.assertIsNone(self.guard.poll())
        for ear in self.spatial, self.device:
            LIMITS.check(self, ear.all())

    def wait(self, condition, what, timeout=5.0):
        end = time.monotonic() + timeout
        while not self.holds(condition):
            self.assertLess(time.monotonic(), end, what)
            time.sleep(0.005)

    @staticmethod
    def holds(condition):
        try:
            return condition()
        except AttributeError:  # nothing was heard yet
            return False

    def touch(self):
        self.hand.hold(TOUCHING)
        self.wait(lambda: abs(force(self.device.last()) - 0.4) < 1e-6, "touch")

    def hand_program(self, z, way):
        """A hand in a process of its own, at 1 kHz."""
        name = "hand_%d" % len(self.programs.all)
        rospy.set_param("/" + name, {"start": [0.0, 0.0, z, 0.0, 0.6, 0.0], "way": way, "speed": 0.03, "hold": 60.0,
                                     "grip_stiffness": 1000.0, "after": ""})
        return self.programs.node("palpate_device", "__name:=" + name)

    def test_a_hand_that_is_killed_while_it_presses_and_one_that_takes_over(self):
        self.hand.stop()
        self.wait(lambda: self.reports.last().state == "PAUSED", "no hand")
        program = self.hand_program(ABOVE, 0.03)
        self.wait(lambda: force(self.spatial.last()) > 0.1, "press", 10.0)  # and goes on down
        program.kill()
        killed = time.monotonic()
        self.reports.clear()
        self.wait(lambda: self.reports.last().state == "PAUSED", "paused")
        paused = time.monotonic()
        self.wait(lambda: force(self.spatial.last()) == 0.0, "gone")
        self.assertGreater(paused - killed, 0.5 * STALE_AFTER)
        self.assertLess(paused - killed, STALE_AFTER + LATE)
        self.assertLess(time.monotonic() - paused, RAMP + LATE)
        # Another one is where that one was.
        z = TOUCHING - 0.002
        program = self.hand_program(z, 0.0)
        self.wait(lambda: self.reports.last().state == "RUNNING", "taken over")
        self.wait(lambda: abs(force(self.spatial.last()) - 0.4) < 1e-6, "felt again")
        program.send_signal(signal.SIGINT)
        self.assertEqual(program.wait(5), 0)

    def test_a_node_that_is_stopped_and_goes_on(self):
        self.touch()
        self.node.send_signal(signal.SIGSTOP)
        try:
            self.wait(lambda: force(self.device.last()) == 0.0, "guard", GUARD_PATIENCE + GUARD_RAMP + LATE)
            self.hand.hold(TOUCHING - 0.004)  # meanwhile it is elsewhere
            time.sleep(1.0)
            self.assertEqual({force(m) for m in self.device.all()[-100:]}, {0.0})
            self.reports.clear()
        finally:
            self.node.send_signal(signal.SIGCONT)
        self.wait(lambda: abs(force(self.device.last()) - 0.4) < 1e-6, "back")
        self.assertLessEqual({m.state for m in self.reports.all()}, {"RUNNING", "PAUSED"})
        self.assertEqual(self.reports.last().state, "RUNNING")

    def test_a_guard_that_is_stopped_and_goes_on(self):
        self.touch()
        self.guard.send_signal(signal.SIGSTOP)
        try:
            self.hand.hold(ABOVE)
            self.wait(lambda: force(self.spatial.last()) == 0.0, "lifted")
            time.sleep(0.5)
            self.assertGreater(force(self.device.last()), 0.3)  # a device holds it
        finally:
            self.guard.send_signal(signal.SIGCONT)
        self.wait(lambda: force(self.device.last()) == 0.0, "let go", 0.4 / 4.0 + LATE)

    def test_a_stranger_before_the_guard(self):
        self.touch()
        stranger, m = Speaker("/probe/body/measured_cf", WrenchStamped), WrenchStamped()

        def send(count, values, period=0.002):
            for k in range(count):
                m.wrench.force.z = m.wrench.torque.x = values[k % len(values)]
                stranger.send(bytes_of(m))
                time.sleep(period)

        own = self.device.last().wrench.force.z
        self.assertLess(own, 0.39)  # of the 0.4, in another direction than the stranger's
        self.device.clear()
        send(200, (1e3, float("nan"), -1e308, float("inf")))
        for heard in self.device.all():
            self.assertAlmostEqual(heard.wrench.force.z, own, delta=1e-3)
        # While the node is stopped nobody else speaks: the stranger is heard, within the guard's limits.
        self.node.send_signal(signal.SIGSTOP)
        try:
            send(200, (1e3, float("nan")))
            self.assertAlmostEqual(self.device.last().wrench.force.z, 0.4, delta=1e-6)
            send(200, (1e3, -1e3))
            send(1500, (float("nan"),), 0.0005)  # no numbers are silence, however many
            self.assertEqual(force(self.device.last()), 0.0)
        finally:
            self.node.send_signal(signal.SIGCONT)
        stranger.close()
        self.wait(lambda: abs(self.device.last().wrench.force.z - own) < 1e-3, "back")

    def rate(self, seconds):
        """Of the force loop [Hz], by the numbers of its messages."""
        first, begin = self.spatial.last().header.seq, time.monotonic()
        time.sleep(seconds)
        return (self.spatial.last().header.seq - first) / (time.monotonic() - begin)

    def test_subscribers_that_never_read(self):
        self.touch()
        alone, before = self.rate(1.0), memory(self.node.pid)
        kinds = {"/probe/spatial/measured_cf": WrenchStamped, "/probe/body/measured_cf": WrenchStamped,
                 "/organs": MarkerArray, "/cutaway": MarkerArray, "/step_report": StepReport}
        deaf = [listen("/palpate", topic, kind, buffer=4096) for topic, kind in kinds.items() for _ in range(4)]
        time.sleep(1.0)  # until what the kernel keeps for them is full
        beside, grown = self.rate(1.0), memory(self.node.pid) - before
        print("force loop at %.0f Hz, with %d deaf ones %.0f Hz, memory %+.1f MB" %
              (alone, len(deaf), beside, 1e-6 * grown))
        self.assertGreater(beside, 0.8 * alone)
        # One message waits for each, one is half sent: pictures of this block have some 100 kB.
        self.assertLess(grown, 2 * len(deaf) * 200e3 + 2e6)
        for connection in deaf:
            connection.close()

    def test_both_cores_busy(self):
        self.hand.stop()
        program = self.hand_program(ABOVE, 0.03)
        self.wait(lambda: force(self.spatial.last()) > 0.1, "press", 10.0)
        alone = self.rate(1.0)
        spinning = [self.programs.start("sh", "-c", "while :; do :; done") for _ in range(2 * os.cpu_count())]
        self.reports.clear()
        busy, reports = self.rate(2.0), self.reports.all()
        cycles = len(reports) / 2.0
        for p in spinning:
            p.kill()
            p.wait()
        print("force loop at %.0f Hz, with %d spinning programs %.0f Hz and %.0f cycles a second" %
              (alone, len(spinning), busy, cycles))
        self.assertGreater(busy, 0.0)
        self.assertGreater(cycles, 0.0)
        # Slower, or without a hand that is heard in time, but not in a fault.
        self.assertLessEqual({m.state for m in reports}, {"RUNNING", "PAUSED"})
        self.wait(lambda: force(self.spatial.last()) > 0.1, "press again", 10.0)
        program.send_signal(signal.SIGINT)
        self.assertEqual(program.wait(5), 0)

    def test_programs_that_start_while_both_cores_are_busy(self):
        """None waits for a mutex of roscpp's that its own server thread takes again and again."""
        spinning = [self.programs.start("sh", "-c", "while :; do :; done") for _ in range(2 * os.cpu_count())]
        started = {}
        try:
            for k in range(STARTED):
                name = "started_%d" % k
                rospy.set_param("/" + name, {"joints": "/%s/joints" % name, "after": "", "hold": 60.0})
                started["/%s/joints" % name] = self.programs.node("palpate_device", "__name:=" + name)
            end = time.monotonic() + 40.0
            while started:
                self.assertLess(time.monotonic(), end, "not started: %s" % sorted(started))
                for topic, _ in rospy.get_published_topics():
                    if topic in started:
                        started.pop(topic).kill()
                time.sleep(0.1)
        finally:
            for program in spinning + list(started.values()):
                program.kill()
                program.wait()

    def test_z_it_ends_beside_who_never_reads(self):
        self.touch()
        deaf = [listen("/palpate", "/organs", MarkerArray, buffer=4096),
                listen("/palpate", "/probe/spatial/measured_cf", WrenchStamped, buffer=4096)]
        time.sleep(0.5)
        asked = time.monotonic()
        self.node.send_signal(signal.SIGTERM)
        self.assertEqual(self.node.wait(10), 0)
        self.assertLess(time.monotonic() - asked, 1.0)
        self.wait(lambda: force(self.device.last()) == 0.0, "zero")
        for connection in deaf:
            connection.close()


if __name__ == "__main__":
    rospy.init_node("faults_test")
    rostest.rosrun("palpate", "faults_test", Faults)
