#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""States that are saved: at every ending, within the second, and on disks that do not want them."""
import glob
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import rospkg
import rospy
import rostest
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import ABOVE, TOUCHING, Hand, Programs, force, report_ear, wrench_ear  # noqa: E402

SCENES = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes")
BLOCK = os.path.join(SCENES, "block.yaml")
WITHIN = 1.0  # [s] from the signal to the end


class Saves(unittest.TestCase):
    def setUp(self):
        self.programs = Programs()
        self.folder = tempfile.mkdtemp(prefix="saves_test_")
        self.states = os.path.join(self.folder, "states")
        self.last = os.path.join(self.states, "last-palpate.state")
        self.spatial, self.reports, self.hand = wrench_ear(), report_ear(), Hand()

    def tearDown(self):
        self.hand.stop()
        self.programs.end()
        for ear in self.spatial, self.reports:
            ear.subscriber.unregister()
        shutil.rmtree(self.folder)

    def start(self, *parameters, scene=BLOCK, states=None, **options):
        if rospy.has_param("/palpate"):
            rospy.delete_param("/palpate")  # of the last one, which stay
        node = self.programs.node("palpate_node", "__name:=palpate", "_scene:=" + scene,
                                  "_state_directory:=" + (states or self.states), *parameters,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, **options)
        try:
            rospy.wait_for_service("/palpate/reset", 30)
        except rospy.ROSException:
            node.kill()
            self.fail(node.communicate()[0])
        return node

    def touch(self):
        self.hand.hold(ABOVE)
        self.heard(lambda m: m.state == "RUNNING")
        time.sleep(0.3)
        self.hand.hold(TOUCHING)
        self.assertIsNotNone(self.spatial.wait(lambda m: force(m) > 0.02))

    def heard(self, condition, timeout=10.0):
        self.reports.clear()
        m = self.reports.wait(condition, timeout)
        self.assertIsNotNone(m)
        return m

    def ends(self, node, how, status=0):
        asked = time.monotonic()
        if how == "rosnode":
            killer = subprocess.Popen(["rosnode", "kill", "/palpate"], stdout=subprocess.DEVNULL)
            said = node.communicate(timeout=10)[0]
            killer.wait(10)
        else:
            node.send_signal(how)
            said = node.communicate(timeout=10)[0]
            self.assertLess(time.monotonic() - asked, WITHIN, how)
        self.assertEqual(node.returncode, status, said)
        time.sleep(0.1)
        self.assertEqual(force(self.spatial.last()), 0.0)
        return said

    def saved_time(self, file=None):
        """What the second line after the head says; the reader checks the rest."""
        with open(file or self.last, "rb") as f:
            return float(re.search(rb"^time: ([0-9.e+-]+) s$", f.read(1000), re.M).group(1))

    def files(self, folder=None):
        return sorted(os.listdir(folder or self.states))

    def test_each_ending_saves_and_the_next_start_goes_on(self):
        node, saved = self.start(), 0.0
        self.touch()
        for how in signal.SIGTERM, signal.SIGINT, signal.SIGHUP, "rosnode":
            time.sleep(0.3)
            last = self.reports.last().time
            said = self.ends(node, how)
            self.assertIn("the state at the end is in " + self.last, said)
            self.assertEqual(self.files(), ["last-palpate.state"])
            self.assertGreaterEqual(self.saved_time(), last - 1e-9)
            self.assertGreater(self.saved_time(), saved)
            saved = self.saved_time()
            # The tool is where it was, in the tissue, and need not be lifted out.
            self.spatial.clear()
            node = self.start("_initial_state:=" + self.last)
            self.assertGreater(self.heard(lambda m: m.state == "RUNNING" and m.contacts > 0).time, saved)
            self.assertIsNotNone(self.spatial.wait(lambda m: force(m) > 0.02))
        # One without a step has nothing to save, and one that is not to does not.
        self.hand.stop()
        self.ends(node, signal.SIGINT)
        saved = self.saved_time()
        self.ends(self.start(), signal.SIGINT)
        node = self.start("_save_state_at_end:=false")
        self.touch()
        self.ends(node, signal.SIGTERM)
        self.assertEqual(self.saved_time(), saved)

    def slow(self):
        """Six blocks of springs in steps so short that a cycle takes seconds."""
        with open(BLOCK) as f:
            text = f.read()
        organ = re.search(r"  - name: block\n(?:    .*\n)+", text).group(0)
        organ = re.sub(r"\bblock.msh", SCENES + "/block.msh", organ)
        organ += "    model: mass_spring\n    springs: {scheme: symplectic_euler, step: 1.1e-6}\n"
        blocks = "".join(organ.replace("name: block", "name: block_%d" % k) for k in range(6))
        text, changed = re.subn(r"  - name: block\n(?:    .*\n)+", lambda _: blocks, text)
        self.assertEqual(changed, 1)
        for old, new in ((r"urdf: probe.urdf", "urdf: " + SCENES + "/probe.urdf"),
                         (r"solver: .*", "solver: {step: 0.1, skip: {sleeping: false}}")):
            text, changed = re.subn(old, new, text)
            self.assertEqual(changed, 1, old)
        file = os.path.join(self.folder, "slow.yaml")
        with open(file, "w") as f:
            f.write(text)
        return file

    def test_in_the_middle_of_a_step_of_seconds(self):
        scene = self.slow()
        for deadline in "0", "1":
            node = self.start("_solver/deadline:=" + deadline, scene=scene)
            self.hand.hold(ABOVE)
            self.heard(lambda m: m.state == "RUNNING" and m.cycle_ms > 0.0, 30.0)
            self.hand.hold(-0.0651)  # a tenth of a millimetre deep
            long = self.heard(lambda m: m.cycle_ms > 500.0, 30.0)
            time.sleep(0.1)  # the next has begun
            asked = threading.Thread(target=self.ask_for_a_state, daemon=True)  # which waits for it
            asked.start()
            time.sleep(0.1)
            self.ends(node, signal.SIGTERM)
            self.assertAlmostEqual(self.saved_time(), long.time, delta=1e-9)
            asked.join(5)
            self.assertFalse(asked.is_alive())
            os.remove(self.last)
        # Before the first step was none that took long: what was before it is not kept.
        node = self.start(scene=scene)
        self.hand.hold(ABOVE)
        time.sleep(0.5)
        self.assertIn("the state at the end is lost", self.ends(node, signal.SIGTERM, 1))
        self.assertNotIn("last-palpate.state", self.files())

    def test_a_step_of_seconds_is_a_fault_until_it_has_ended(self):
        node = self.start("_solver/deadline:=1", scene=self.slow())
        self.hand.hold(ABOVE)
        self.heard(lambda m: m.state == "RUNNING" and m.cycle_ms > 0.0, 30.0)
        self.hand.hold(-0.0651)
        self.heard(lambda m: m.state == "FAULT", 30.0)
        self.spatial.clear()
        # A step that had begun above the block ends without a force, and the next one takes as long.
        ended = self.heard(lambda m: m.cycle_ms > 500.0 and m.contacts > 0, 60.0)
        self.assertEqual(ended.state, "RUNNING")
        self.assertIsNotNone(self.spatial.wait(lambda m: force(m) > 0.0, 5.0))
        self.heard(lambda m: m.state == "FAULT", 30.0)
        self.spatial.clear()
        self.assertIsNotNone(self.spatial.wait(lambda m: force(m) == 0.0, 2.0))
        self.ends(node, signal.SIGTERM)

    def ask_for_a_state(self):
        try:
            rospy.ServiceProxy("/palpate/save_state", Trigger)()
        except rospy.ServiceException:
            pass  # the node is gone

    def refuses_to_save(self, node, folder, words):
        """No state, no part of one, and the force goes on; nor at the end."""
        self.touch()
        before, first = self.files(folder), self.spatial.last().header.seq
        for _ in range(3):
            done = rospy.ServiceProxy("/palpate/save_state", Trigger)()
            self.assertFalse(done.success)
            self.assertIn(words, done.message)
            self.assertIn(folder, done.message)
        self.assertEqual(self.files(folder), before)
        self.assertEqual(self.heard(lambda m: True).state, "RUNNING")
        self.spatial.clear()
        self.assertIsNotNone(self.spatial.wait(lambda m: m.header.seq > first and force(m) > 0.02))
        said = self.ends(node, signal.SIGTERM, 1)
        self.assertIn("the state at the end is lost", said)
        self.assertIn(words, said)
        self.assertEqual(self.files(folder), before)

    def test_a_full_disk(self):
        disk = os.path.join(self.folder, "disk")
        os.mkdir(disk)
        if subprocess.call(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", disk], stderr=subprocess.DEVNULL) != 0:
            self.skipTest("needs a disk of 64 kB to fill: mount -t tmpfs is not permitted here")
        try:
            with open(os.path.join(disk, "other"), "wb") as f:
                f.write(b"x" * 48 * 1024)
            self.refuses_to_save(self.start(states=disk), disk, "No space left on device")
        finally:
            self.programs.end()
            subprocess.check_call(["umount", disk])

    def test_a_file_that_may_not_grow(self):
        os.mkdir(self.states)
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))  # noqa: E731
        self.refuses_to_save(self.start(preexec_fn=limit), self.states, "File too large")

    def test_a_folder_that_is_none(self):
        with open(self.states, "w"):
            pass
        node = self.start()
        self.touch()
        done = rospy.ServiceProxy("/palpate/save_state", Trigger)()
        self.assertFalse(done.success)
        self.assertIn(self.states, done.message)
        self.assertIn("the state at the end is lost", self.ends(node, signal.SIGTERM, 1))

    def test_nothing_is_written_beside_the_folder_and_not_without_end(self):
        os.mkdir(self.states)
        victim = os.path.join(self.folder, "victim")
        with open(victim, "w") as f:
            f.write("as it was")
        os.symlink(victim, self.last)
        for k in range(998):
            with open(os.path.join(self.states, "state-%d.state" % k), "w"):
                pass
        node = self.start()
        self.touch()
        save = rospy.ServiceProxy("/palpate/save_state", Trigger)
        self.assertTrue(save().success)
        done = save()
        self.assertFalse(done.success)
        self.assertIn("1000 states", done.message)
        self.ends(node, signal.SIGTERM)
        with open(victim) as f:
            self.assertEqual(f.read(), "as it was")
        self.assertFalse(os.path.islink(self.last))
        self.assertEqual(sorted(os.listdir(self.folder)), ["states", "victim"])
        self.assertEqual(len(glob.glob(self.states + "/*.state")), 1000)


if __name__ == "__main__":
    rospy.init_node("saves_test")
    rostest.rosrun("palpate", "saves_test", Saves)
