#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Peers that speak ROS's protocols as they should not: the wrench keeps its limits, and what ends ends in zeros."""
import fcntl
import os
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import rospkg
import rospy
import rostest
from geometry_msgs.msg import WrenchStamped
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import tcpros  # noqa: E402
from helpers import (  # noqa: E402
    ABOVE, TOUCHING, Ear, Hand, Programs, bytes_of, force, joint_state, memory, report_ear, wrench_ear)
from limits import Limits  # noqa: E402

SCENE = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes", "block.yaml")
WRENCH, JOINTS_TOPIC, DEVICE = "/probe/spatial/measured_cf", "/probe/measured_js", "/master/body/servo_cf"
LIMITS = Limits(0.4, 0.01, 4.0)
RAMP = 0.1  # [s] of the scene


class HostileGraph(unittest.TestCase):
    def setUp(self):
        self.programs = Programs()
        self.folder = tempfile.mkdtemp(prefix="hostile_graph_test_")
        self.spatial, self.reports, self.hand = wrench_ear(), report_ear(), Hand()

    def tearDown(self):
        self.hand.stop()
        self.programs.end()
        for ear in self.spatial, self.reports:
            ear.subscriber.unregister()
        self.hand.publisher.unregister()
        LIMITS.check(self, self.spatial.all())
        shutil.rmtree(self.folder)

    def start(self, env=None, **options):
        self.programs.env = env
        self.node = self.programs.node("palpate_node", "__name:=palpate", "_scene:=" + SCENE,
                                       "_state_directory:=" + self.folder, *LIMITS.parameters(), **options)
        rospy.wait_for_service("/palpate/reset", 30)
        self.hand.hold(ABOVE)
        self.assertIsNotNone(self.reports.wait(lambda m: m.state == "RUNNING", 5.0))
        time.sleep(0.3)
        self.hand.hold(TOUCHING)
        self.is_felt()

    def is_felt(self):
        self.assertIsNone(self.node.poll())
        self.spatial.clear()
        self.assertIsNotNone(self.spatial.wait(lambda m: abs(force(m) - 0.4) < 1e-6, 5.0))
        self.reports.clear()
        self.assertIsNotNone(self.reports.wait(lambda m: m.state == "RUNNING", 3.0))

    @staticmethod
    def connect(address, *data):
        connection = socket.create_connection(address, 5.0)
        for part in data:
            connection.sendall(part)
        return connection

    def test_headers_and_messages_of_any_length(self):
        self.start()
        before = memory(self.node.pid)
        port = tcpros.data_port("/palpate", WRENCH)
        open_ones = []
        for size in 0xffffffff, 0x7fffffff, 1000000000, 300:
            open_ones += [self.connect(port, struct.pack("<I", size), b"g" * 300) for _ in range(5)]
        # As a publisher of joint positions, a service's client, and a subscriber.
        for size in 0xffffffff, 0x7fffffff, 999999999:
            speaker = tcpros.Speaker(JOINTS_TOPIC, JointState, "/stranger_%d" % size)
            speaker.connection.sendall(struct.pack("<I", size))
            open_ones.append(speaker)
        host, number = tcpros.call(tcpros.master(), "lookupService", "/palpate/reset")[9:].split(":")
        hello = tcpros.header(callerid="/stranger", service="/palpate/reset", md5sum=Trigger._md5sum)
        for size in 0xffffffff, 999999999:
            open_ones.append(self.connect((host, int(number)), hello, struct.pack("<I", size), b"g" * 7))
        wrong = tcpros.header(callerid="/stranger", topic=WRENCH, type="std_msgs/String", md5sum="0" * 32)
        open_ones += [self.connect(port, wrong), self.connect(port, tcpros.header(topic="/nothing")), self.connect(port)]
        time.sleep(1.0)
        self.is_felt()
        grown = memory(self.node.pid) - before
        print("declared lengths of 1 GB: memory %+.1f MB" % (1e-6 * grown))
        self.assertLess(grown, 20e6)  # what is declared costs nothing until it is sent
        for connection in open_ones:
            connection.close()
        self.is_felt()

    def test_questions_that_make_no_sense(self):
        self.start()
        address = tcpros.slave("/palpate").address
        number, text, array = "<value><i4>7</i4></value>", "<value>%s</value>", "<value><array><data>%s</data></array></value>"
        me, js, wrench = (text % x for x in ("/stranger", JOINTS_TOPIC, WRENCH))
        somewhere = array % "".join(text % x for x in ("http://nowhere:-1/", "garbage", "http://localhost:99999999/"))
        bodies = [os.urandom(1000), b"", b"<?xml version='1.0'?><methodCall>"]
        for method, arguments in (
                ("publisherUpdate", []), ("publisherUpdate", [number]), ("publisherUpdate", [me, js, number]),
                ("publisherUpdate", [me, js, array % number]), ("requestTopic", [me]),
                ("requestTopic", [me, wrench, number]), ("requestTopic", [me, wrench, array % number]),
                ("requestTopic", [me, wrench, array % (array % (text % "UDPROS"))]), ("paramUpdate", [me, number]),
                ("paramUpdate", []), ("getBusInfo", []), ("palpateTask", []), ("system.multicall", [number]),
                ("system.multicall", [array % number]), ("publisherUpdate", [me, text % "/nothing", somewhere])):
            bodies.append(self.question(method, arguments))
        for body in bodies:
            connection = self.connect(address, self.http(body))
            connection.settimeout(0.3)
            try:
                connection.recv(1000)
            except OSError:
                pass
            connection.close()
            self.assertIsNone(self.node.poll(), body[:200])
        half = [self.connect(address, self.http(b"half", 2000000000)) for _ in range(5)]
        crowd = [socket.socket() for _ in range(200)]
        for connection in crowd:  # not one after the other: few may wait at this door at a time
            connection.setblocking(False)
            connection.connect_ex(address)
        time.sleep(1.5)
        self.is_felt()
        self.assertTrue(rospy.ServiceProxy("/palpate/save_state", Trigger)().success)
        for connection in half + crowd:
            connection.close()
        # A stranger says who publishes the joints: that one is heard then, and is felt within the limits.
        stranger = tcpros.Speaker(JOINTS_TOPIC, JointState, announced=False)
        tcpros.slave("/palpate").publisherUpdate("/stranger", JOINTS_TOPIC, [stranger.address])
        stranger.accept()
        for k in range(50):
            stranger.send(bytes_of(joint_state((ABOVE, TOUCHING)[k // 5 % 2])))
            time.sleep(0.01)
        stranger.close()
        tcpros.slave("/palpate").publisherUpdate("/master", JOINTS_TOPIC, [tcpros.call(
            tcpros.master(), "lookupNode", rospy.get_name())])
        self.is_felt()

    @staticmethod
    def question(method, arguments):
        return ("<?xml version='1.0'?><methodCall><methodName>%s</methodName><params>%s</params></methodCall>" %
                (method, "".join("<param>%s</param>" % a for a in arguments))).encode()

    @staticmethod
    def http(body, length=None):
        return b"POST /RPC2 HTTP/1.1\r\nHost: x\r\nContent-Type: text/xml\r\nContent-length: %d\r\n\r\n" % (
            len(body) if length is None else length) + body

    def test_floods_of_requests(self):
        self.start()
        done, until, request = [], time.monotonic() + 3.0, struct.pack("<I", 0)

        def client(service):
            uri = tcpros.call(tcpros.master(), "lookupService", service)
            host, number = uri[9:].split(":")
            connection = self.connect((host, int(number)), tcpros.header(
                callerid="/stranger", service=service, md5sum=Trigger._md5sum, persistent="1"))
            tcpros.frame(connection)
            return connection

        def ask(service):
            connection = client(service)
            while time.monotonic() < until:
                connection.sendall(request)
                tcpros.receive(connection, 1)
                tcpros.frame(connection)
                done.append(service)
            connection.close()

        def ask_without_listening(service):  # a thousand times a second
            connection = client(service)
            while time.monotonic() < until:
                connection.sendall(10 * request)
                time.sleep(0.01)
            connection.close()

        threads = [threading.Thread(target=ask, args=("/palpate/" + name,), daemon=True)
                   for name in ["reset"] * 10 + ["save_state"] * 3]
        threads.append(threading.Thread(target=ask_without_listening, args=("/palpate/reset",), daemon=True))
        self.spatial.clear()
        for t in threads:
            t.start()
        for t in threads:
            t.join(10)
            self.assertFalse(t.is_alive())
        print("%.0f resets and %.0f states a second" % tuple(done.count("/palpate/" + n) / 3.0
                                                             for n in ("reset", "save_state")))
        self.assertGreater(done.count("/palpate/reset"), 10)
        self.assertLessEqual(len([f for f in os.listdir(self.folder) if f.endswith(".state")]), 1000)
        self.hand.hold(ABOVE)
        time.sleep(0.3)
        self.hand.hold(TOUCHING)
        LIMITS.check(self, self.spatial.all())
        self.is_felt()

    def ends_in_zeros(self, ear, began, before):
        """The force goes as the ramp has it, and ten zeros follow."""
        heard = [m for t, m in ear.timed() if t > began]
        LIMITS.check(self, heard)
        forces = [force(m) for m in heard]
        self.assertGreater(max(forces), 0.5 * before)
        self.assertEqual(set(forces[-10:]), {0.0})
        self.assertTrue(any(0.2 * before < f < 0.8 * before for f in forces))

    def test_a_question_that_nests_without_end(self):
        guard = self.programs.node("palpate_guard", "__name:=guard", "_input:=probe/body/measured_cf",
                                   "_output:=" + DEVICE, *LIMITS.parameters(""))
        self.start()
        device = Ear(DEVICE, WrenchStamped)
        self.assertIsNotNone(device.wait(lambda m: abs(force(m) - 0.4) < 1e-6, 5.0))
        opening, closing = "<value><array><data>", "</data></array></value>"
        nested = self.http(self.question("getPid", [opening * 100000 + "<value>1</value>" + closing * 100000]))
        for program, name, ear in (guard, "/guard", device), (self.node, "/palpate", self.spatial):
            ear.clear()
            began = time.monotonic()
            connection = self.connect(tcpros.slave(name).address, nested)
            self.assertEqual(program.wait(10), -signal.SIGSEGV, name)
            self.assertLess(time.monotonic() - began, 2.0)
            connection.close()
            time.sleep(0.3)
            self.ends_in_zeros(ear, began, 0.4)
        self.assertIn("last-palpate.state", os.listdir(self.folder))
        device.subscriber.unregister()

    def test_another_machine_cannot_reach_a_node_of_this_one(self):
        """By its topics, which ROS sees to where the node's host is localhost, nor by questions."""
        space, here, there = ("plp%d%s" % (os.getpid() % 100000, end) for end in ("n", "a", "b"))

        def network(*commands):
            return all(subprocess.call(["ip"] + c.split(), stderr=subprocess.DEVNULL) == 0 for c in commands)

        try:
            made = network("netns add " + space, "link add %s type veth peer name %s" % (here, there),
                           "link set %s netns %s" % (there, space), "addr add 10.213.77.1/24 dev " + here,
                           "link set %s up" % here, "-n %s addr add 10.213.77.2/24 dev %s" % (space, there),
                           "-n %s link set %s up" % (space, there))
        except FileNotFoundError:
            made = False
        if not made:
            network("netns del " + space)
            self.skipTest("needs network namespaces (ip netns, ip link), which are not permitted here")
        try:
            self.start(env=dict(os.environ, ROS_HOSTNAME="localhost"))
            ports = [tcpros.slave("/palpate").address[1], tcpros.data_port("/palpate", WRENCH)[1]]
            with socket.socket() as reachable:  # the way there is open
                reachable.bind(("0.0.0.0", 0))
                reachable.listen(1)
                tried = subprocess.run(
                    ["ip", "netns", "exec", space, sys.executable, "-c",
                     "import socket, sys\nfor p in sys.argv[1:]:\n"
                     " s = socket.socket(); s.settimeout(2); print(s.connect_ex(('10.213.77.1', int(p))))"] +
                    [str(p) for p in ports + [reachable.getsockname()[1]]],
                    stdout=subprocess.PIPE, universal_newlines=True, timeout=20).stdout.split()
            self.assertEqual(len(tried), 3, tried)
            self.assertNotEqual(tried[0], "0")
            self.assertNotEqual(tried[1], "0")
            self.assertEqual(tried[2], "0")
        finally:
            network("link del " + here, "netns del " + space)
        self.is_felt()

    def test_nobody_reads_what_the_node_says(self):
        reader, writer = os.pipe()
        fcntl.fcntl(writer, 1031, 4096)  # F_SETPIPE_SZ
        self.start(stdout=writer, stderr=writer)
        os.close(writer)
        self.hand.stop()
        stranger = tcpros.Speaker(JOINTS_TOPIC, JointState)
        for _ in range(100):
            stranger.send(b"garbage")  # of each of which ROS says something
            time.sleep(0.005)
        self.assertIsNotNone(self.spatial.wait(lambda m: force(m) == 0.0, 5.0))
        self.spatial.clear()
        began = time.monotonic()
        self.node.send_signal(signal.SIGTERM)
        self.assertEqual(self.node.wait(10), 1)  # something hung
        self.assertLess(time.monotonic() - began, 1.2)
        self.assertEqual({force(m) for m in self.spatial.all()}, {0.0})
        self.assertIn("last-palpate.state", os.listdir(self.folder))
        stranger.close()
        os.close(reader)


if __name__ == "__main__":
    rospy.init_node("hostile_graph_test")
    rostest.rosrun("palpate", "hostile_graph_test", HostileGraph)
