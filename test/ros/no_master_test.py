#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Without a master: every program of the graph explains itself, refuses options that it does not know,
and says that it waits, which a signal ends.

    no_master_test.py FOLDER      with the programs
"""
import os
import re
import select
import signal
import socket
import socketserver
import subprocess
import sys
import threading
import time
import unittest
import xmlrpc.client
import xmlrpc.server

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOLDER = "."
LONG = 30.0  # [s] after which something hangs
STARTS = {  # arguments with which each program would work, if there were a master
    "palpate_node": ["_scene:=liver_palpation"],
    "palpate_guard": ["_input:=/a", "_output:=/b"],
    "palpate_device": ["_after:="],
    "palpate_play": ["_scene:=slab_probe"],
    "palpate_record": ["_scene:=slab_probe", "_bag:=/nowhere/a.bag"],
    "palpate_wire": ["_seconds:=1"],
    "palpate_when_ready": ["/a", "true"],
}
PROGRAMS = [*STARTS, "palpate_replay_bag", "palpate_rviz"]


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


def environment(port):
    return {**os.environ, "ROS_MASTER_URI": "http://localhost:%d" % port, "ROS_HOSTNAME": "localhost"}


def run(program, *arguments, port=None, **variables):
    done = subprocess.run([os.path.join(FOLDER, program), *arguments], timeout=LONG, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True,
                          env={**environment(port or free_port()), **variables})
    return done.returncode, done.stdout


def table_below(heading):
    """The first cells of all tables below a heading of docs/node.md, without their heads."""
    with open(os.path.join(ROOT, "docs", "node.md"), encoding="utf-8") as file:
        page = file.read()
    part = page[page.index("\n## " + heading + "\n") + 4:].split("\n## ")[0]
    return [m.group(1) for m in re.finditer(r"^\| (`[^|]*) \|", part, re.MULTILINE)]


class Waiting:
    """A program that was started and may wait."""

    def __init__(self, program, port):
        self.process = subprocess.Popen([os.path.join(FOLDER, program), *STARTS[program]], env=environment(port),
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.said = b""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()

    def says(self, words):
        end = time.monotonic() + LONG
        while words.encode() not in self.said and time.monotonic() < end:
            if not select.select([self.process.stdout], [], [], 1.0)[0]:
                continue
            more = os.read(self.process.stdout.fileno(), 4096)
            if not more:
                break
            self.said += more
        return words.encode() in self.said


class DeafMaster:
    """Says who it is, and answers nothing else."""

    class Server(socketserver.ThreadingMixIn, xmlrpc.server.SimpleXMLRPCServer):
        daemon_threads = True

    def __enter__(self):
        self.over, self.asked = threading.Event(), threading.Event()
        self.server = self.Server(("127.0.0.1", 0), logRequests=False, allow_none=True)
        self.server.register_function(lambda caller: (1, "", os.getpid()), "getPid")
        self.server.register_instance(self)
        self.port = self.server.server_address[1]
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        return self

    def _dispatch(self, method, arguments):
        self.asked.set()
        self.over.wait()
        return (0, method, 0)

    def __exit__(self, *_):
        self.over.set()
        self.server.shutdown()
        self.server.server_close()


class NoMaster(unittest.TestCase):
    def test_help(self):
        for program in PROGRAMS:
            for option in "--help", "-h":
                status, said = run(program, option, "__name:=other", "_parameter:=1")
                if program == "palpate_replay_bag":  # no node
                    status, said = run(program, option)
                self.assertEqual(status, 0, said)
                self.assertRegex(said, r"Usage: (\S*/)?" + program)
                self.assertGreater(len(said.splitlines()), 8, said)

    def test_help_of_the_node_has_what_its_page_has(self):
        _, said = run("palpate_node", "--help")
        cells = table_below("Topics and services") + table_below("Parameters of `palpate_node`")
        names = [name for cell in cells for name in re.findall(r"`([^`]*)`", cell)]
        self.assertGreater(len(names), 20)
        for name in names:
            self.assertRegex(said, r"(?m)(^  |, )%s(,|$| )" % re.escape(name))

    def test_help_has_parameters_with_defaults(self):
        for program, expected in {
                "palpate_node": [r"~scene +required +\w", r"~arrow_scale +0 +\w.*\[m/N\] \(>= 0\)",
                                 r"~cutaway/corner +\[1, -1, 0\] +\w", r"~save_state_at_end +true +\w"],
                "palpate_guard": [r"~input +required +\w", r"~patience +0\.05 +\w.*\[s\]", r"~ramp +0\.02 +\w",
                                  r"~max_force_rate +\d+ +\w.*\[N/s\]"],
                "palpate_device": [r"~names +\[x, y, z, roll, pitch, yaw\]", r"~way +0\.02 +\w.*\[m\]",
                                   r"~wrench +/probe/spatial/measured_cf\s+\w"],
                "palpate_wire": [r"~seconds +20 +\w.*\[s\]", r"~wrench +/probe/spatial/measured_cf\s+\w"],
        }.items():
            _, said = run(program, "--help")
            for line in expected:
                self.assertRegex(said, "(?m)^  " + line)

    def test_unknown_options_are_refused(self):
        for program in STARTS:
            for arguments in ["--helpp", *STARTS[program]], ["-x", *STARTS[program]], ["--scene=liver", *STARTS[program]]:
                status, said = run(program, *arguments)
                self.assertEqual(status, 2, said)
                self.assertIn(arguments[0], said)
                self.assertIn("--help", said)
        for program in "palpate_node", "palpate_guard", "palpate_device", "palpate_wire":
            self.assertEqual(run(program, "liver_palpation")[0], 2)
        self.assertEqual(run("palpate_when_ready", "/only_a_service")[0], 2)

    def test_a_uri_that_is_none(self):
        for program in STARTS:
            status, said = run(program, *STARTS[program], ROS_MASTER_URI="localhost")
            self.assertEqual(status, 2, said)
            self.assertIn("ROS_MASTER_URI = localhost: must be like http://localhost:11311", said)
            status, said = run(program, "__master:=nowhere", *STARTS[program])
            self.assertEqual(status, 2, said)
            self.assertIn("__master = nowhere", said)

    def test_who_waits_says_so_and_ends_by_a_signal(self):
        for program in STARTS:
            for ends in signal.SIGTERM, signal.SIGINT, signal.SIGHUP:
                port = free_port()
                with Waiting(program, port) as waiting:
                    self.assertTrue(waiting.says("%s: waiting for the master at http://localhost:%d\n" % (program, port)),
                                    waiting.said)
                    self.assertIsNone(waiting.process.poll())
                    waiting.process.send_signal(ends)
                    self.assertEqual(waiting.process.wait(LONG), -ends)

    def test_a_master_that_hangs_holds_nobody(self):
        for program in STARTS:
            with DeafMaster() as master, Waiting(program, master.port) as waiting:
                self.assertTrue(master.asked.wait(LONG))
                time.sleep(0.3)
                self.assertIsNone(waiting.process.poll())
                waiting.process.send_signal(signal.SIGTERM)
                # Killed by the signal, or as a shell would say so.
                self.assertIn(waiting.process.wait(LONG), (-signal.SIGTERM, 128 + signal.SIGTERM))

    def test_a_master_that_comes_later_is_found(self):
        port = free_port()
        with Waiting("palpate_guard", port) as waiting:
            self.assertTrue(waiting.says("waiting for the master"))
            master = subprocess.Popen(["/usr/bin/rosmaster", "--core", "-p", str(port)], env=environment(port),
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                self.assertTrue(waiting.says("the master is there"), waiting.said)
                end = time.monotonic() + LONG
                with xmlrpc.client.ServerProxy("http://localhost:%d" % port) as proxy:
                    while not any(topic == "/b" for topic, _ in proxy.getSystemState("/test")[2][0]):
                        self.assertLess(time.monotonic(), end)
                        time.sleep(0.05)
                waiting.process.send_signal(signal.SIGTERM)
                self.assertEqual(waiting.process.wait(LONG), 0)
            finally:
                master.terminate()
                master.wait()


if __name__ == "__main__":
    FOLDER = sys.argv.pop(1)
    unittest.main()
