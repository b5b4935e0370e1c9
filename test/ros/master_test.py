#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ROS master goes and comes back, or forgets: node and guard go on, and are found again."""
import os
import signal
import socket
import subprocess
import sys
import threading
import time
import unittest

import rospkg
import rostest
from geometry_msgs.msg import WrenchStamped

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import tcpros  # noqa: E402
from helpers import Programs  # noqa: E402

SCENES = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes")


DEVICE = "/master/body/servo_cf"


class Listener:
    """Hears a topic of a node by a connection of its own, whatever the master does; the longest gap [s]."""

    def __init__(self, node, topic, uri):
        self.connection = tcpros.listen(node, topic, WrenchStamped, uri)
        self.gap, self.heard, self.failed, self.force = 0.0, 0, None, None
        self.thread = threading.Thread(target=self._hear, daemon=True)
        self.thread.start()

    def _hear(self):
        last = time.monotonic()
        try:
            while True:
                self.force = WrenchStamped().deserialize(tcpros.frame(self.connection)).wrench.force.z
                now = time.monotonic()
                self.gap, last, self.heard = max(self.gap, now - last), now, self.heard + 1
        except (OSError, EOFError) as e:
            self.failed = e


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

    def hears(self, timeout, topic="/probe/spatial/measured_cf"):
        return self.answers("rostopic", "echo", "-n", "1", topic, timeout=timeout)

    @staticmethod
    def said_so_far(program):
        os.set_blocking(program.stdout.fileno(), False)
        return program.stdout.read() or ""

    def uri(self):
        return self.env["ROS_MASTER_URI"]

    def known(self, node):
        """Publications, subscriptions and services of a node that the master knows."""
        state = tcpros.call(tcpros.master(self.uri()), "getSystemState")
        return [sorted(name for name, nodes in part if node in nodes) for part in state]

    def forget(self, node):
        """What `rosnode cleanup` does to a node that does not answer."""
        master = tcpros.master(self.uri())
        api = tcpros.call(master, "lookupNode", node)
        publications, subscriptions, services = self.known(node)
        for topic in publications:
            master.unregisterPublisher(node, topic, api)
        for topic in subscriptions:
            master.unregisterSubscriber(node, topic, api)
        for service in services:
            master.unregisterService(node, service, tcpros.call(master, "lookupService", service))

    def connection(self, node, topic):
        """Number of that by which a node hears a topic, [id, who, direction, transport, topic, connected, ...]."""
        information = tcpros.call(tcpros.slave(node, self.uri()), "getBusInfo")
        return next((c[0] for c in information if c[2] == "i" and c[4] == topic and c[5]), None)

    def test_a_guard_takes_the_force_back_though_the_master_hangs(self):
        master = self.master()
        guard = self.programs.node("palpate_guard", "__name:=guard", "_input:=/given", "_output:=" + DEVICE)
        self.programs.start("rostopic", "pub", "-r", "200", "/given", "geometry_msgs/WrenchStamped",
                            "{wrench: {force: {z: 1.0}}}", stdout=subprocess.DEVNULL)
        self.wait_for(lambda: self.hears(5.0, DEVICE), 20.0)
        device = Listener("/guard", DEVICE, self.uri())
        self.wait_for(lambda: device.force == 1.0, 5.0)
        master.send_signal(signal.SIGSTOP)
        try:
            guard.send_signal(signal.SIGTERM)
            asked = time.monotonic()
            self.assertEqual(guard.wait(10), 0)
            took = time.monotonic() - asked
        finally:
            master.send_signal(signal.SIGCONT)
        print("ended %.2f s after it was asked, force %s" % (took, device.force))
        self.assertEqual(device.force, 0.0)
        self.assertLess(took, 2.0)

    def test_the_node_registers_again(self):
        master = self.master()
        node = self.programs.node("palpate_node", "__name:=palpate",
                          "_scene:=" + os.path.join(SCENES, "block.yaml"), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True)
        self.wait_for(lambda: self.answers("rosservice", "info", "/palpate/reset"), 20.0)
        guard = self.programs.node("palpate_guard", "__name:=guard", "_input:=probe/body/measured_cf",
                                   "_output:=" + DEVICE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   universal_newlines=True)
        self.wait_for(lambda: self.hears(5.0, DEVICE), 20.0)
        before = {name: self.known(name) for name in ("/palpate", "/guard")}
        listeners = [Listener("/palpate", "/probe/spatial/measured_cf", self.uri()),
                     Listener("/guard", DEVICE, self.uri())]

        master.kill()
        master.wait(10)
        time.sleep(1.5)
        self.assertIsNone(node.poll())
        self.assertIsNone(guard.poll())

        # A new one, that knows nobody: a new subscriber hears the wrench, an input and a service work.
        self.master()
        self.assertTrue(self.hears(5.0))
        self.assertTrue(self.hears(5.0, DEVICE))
        for listener in listeners:
            print("%d messages, the longest gap %.3f s" % (listener.heard, listener.gap))
            self.assertIsNone(listener.failed)
            self.assertGreater(listener.heard, 1000)
            self.assertLess(listener.gap, 0.5)
        self.assertNotIn("nothing is heard", self.said_so_far(guard))
        hand = self.programs.start("rostopic", "pub", "-r", "100", "/probe/measured_js", "sensor_msgs/JointState",
                          "{header: {stamp: now}, name: [x, y, z, roll, pitch, yaw],"
                          " position: [0.0, 0.0, -0.05, 0.0, 0.0, 0.0]}", stdout=subprocess.DEVNULL)
        self.wait_for(lambda: "RUNNING" in subprocess.run(
            ["rostopic", "echo", "-n", "1", "/step_report/state"], env=self.env, stdout=subprocess.PIPE,
            timeout=10.0, universal_newlines=True).stdout, 15.0)
        self.assertTrue(self.answers("rosservice", "call", "/palpate/reset"))
        hand.kill()

        # One that is told to forget both, such as while they are stopped.
        for name, own in before.items():
            self.forget(name)
            own[2] = [s for s in own[2] if s in ("/palpate/reset", "/palpate/save_state")]
            self.wait_for(lambda: all(set(a) <= set(b) for a, b in zip(own, self.known(name))), 5.0)
        self.assertTrue(self.hears(5.0, DEVICE))

        # One that is told to forget one topic, whose subscriber hangs up, or one service.
        master, topic = tcpros.master(self.uri()), "/probe/body/measured_cf"
        connection = self.connection("/guard", topic)
        self.assertIsNotNone(connection)
        master.unregisterPublisher("/palpate", topic, tcpros.call(master, "lookupNode", "/palpate"))
        self.wait_for(lambda: self.connection("/guard", topic) not in (None, connection), 3.0)
        service = "/palpate/reset"
        master.unregisterService("/palpate", service, tcpros.call(master, "lookupService", service))
        self.wait_for(lambda: service in self.known("/palpate")[2], 2.0)

        node.send_signal(signal.SIGINT)
        said = node.communicate(timeout=10)[0]
        self.assertEqual(node.returncode, 0)
        self.assertEqual(said.count("the ROS master is gone"), 1, said)
        self.assertGreaterEqual(said.count("registered again"), 4, said)
        guard.send_signal(signal.SIGINT)
        guard.wait(10)


if __name__ == "__main__":
    rostest.rosrun("palpate", "master_test", Master)
