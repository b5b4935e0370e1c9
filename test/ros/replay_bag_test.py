#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""palpate_replay_bag: repeatable, the same as `palpate replay`, and clear about bad bags."""
import csv
import glob
import math
import os
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import rosbag
import roslib.packages
import rospkg
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import joint_state, numbers  # noqa: E402

SCENES = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes")


def program(name):
    return roslib.packages.find_node("palpate", name)[0]


def height(t):
    """Down into the block by 3 mm and back, in 1 s."""
    return -0.06 - 0.004 * (1.0 - math.cos(2.0 * math.pi * t))


def write_joints(file, start=1000, count=100, period_ns=10000000, bad=()):
    with rosbag.Bag(file, "w") as bag:
        for i in range(count):
            stamp = rospy.Time(start, 0) + rospy.Duration(0, i * period_ns)
            m = joint_state(height(i / count), stamp)
            if i in bad:
                m.position[0] = float("nan")
            # Recorded a little later than it was sent, as it is.
            bag.write("/probe/measured_js", m, stamp + rospy.Duration(0, 300000))


def bits(m):
    return struct.pack("6d", *numbers(m))


def messages(file, topic):
    with rosbag.Bag(file) as bag:
        return [m for _, m, _ in bag.read_messages(topics=[topic])]


class ReplayBag(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="replay_bag_test_")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def replay(self, bag, *arguments, scene="block.yaml", out="out.bag", **options):
        done = subprocess.run(
            [program("palpate_replay_bag"), self.path(bag), "--scene", os.path.join(SCENES, scene),
             "--out", self.path(out)] + list(arguments),
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, timeout=60, **options)
        return done.returncode, done.stdout, done.stderr

    def test_twice_is_the_same_bit_for_bit(self):
        write_joints(self.path("in.bag"))
        for out in ("a.bag", "b.bag"):
            code, table, errors = self.replay("in.bag", out=out)
            self.assertEqual(code, 0, errors)
            self.assertIn("peak force of probe [N]", table)
        for topic in ("/probe/spatial/measured_cf", "/probe/body/measured_cf"):
            a, b = messages(self.path("a.bag"), topic), messages(self.path("b.bag"), topic)
            self.assertEqual(len(a), 100)
            self.assertEqual([bits(m) for m in a], [bits(m) for m in b])
            self.assertEqual([m.header.stamp for m in a],
                             [m.header.stamp for m in messages(self.path("in.bag"),
                                                               "/probe/measured_js")])
        with open(self.path("a.bag"), "rb") as a, open(self.path("b.bag"), "rb") as b:
            self.assertEqual(a.read(), b.read())
        forces = [m.wrench.force.z for m in messages(self.path("a.bag"),
                                                     "/probe/spatial/measured_cf")]
        self.assertGreater(max(forces), 0.02)
        self.assertEqual(forces[0], 0.0)
        reports = messages(self.path("a.bag"), "/step_report")
        self.assertEqual(len(reports), 100)
        self.assertEqual({m.cycle_ms for m in reports}, {0.0})
        self.assertEqual({m.linear_solve_ms for m in reports}, {0.0})
        self.assertEqual(len(messages(self.path("a.bag"), "/probe/measured_js")), 100)

    def test_files_that_may_not_grow_are_none(self):
        write_joints(self.path("in.bag"), count=20)
        for most in 0, 5000, 20000:
            code, _, errors = self.replay(
                "in.bag", preexec_fn=lambda m=most: resource.setrlimit(resource.RLIMIT_FSIZE, (m, m)))
            self.assertEqual(code, 2, errors)
            self.assertIn(self.path("out.bag"), errors)
            self.assertEqual(os.listdir(self.folder), ["in.bag"], most)

    def test_the_same_as_palpate_replay(self):
        # 33.3 Hz: a cycle is cut into several steps.
        write_joints(self.path("in.bag"), count=40, period_ns=30300000)
        code, _, errors = self.replay("in.bag", "--trajectory", self.path("t.csv"), "--csv",
                                      self.path("bag.csv"))
        self.assertEqual(code, 0, errors)
        done = subprocess.run(
            [program("palpate"), "replay", os.path.join(SCENES, "block.yaml"), "--trajectory",
             self.path("t.csv"), "--out", self.path("cli.csv")],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout)
        rows = []
        for name in ("bag.csv", "cli.csv"):
            with open(self.path(name)) as f:
                table = list(csv.DictReader(f))
            for row in table:
                del row["step_ms"]
            rows.append(table)
        self.assertEqual(len(rows[0]), 40)
        self.assertEqual(rows[0], rows[1])
        wrenches = messages(self.path("out.bag"), "/probe/spatial/measured_cf")
        self.assertEqual([m.wrench.force.z for m in wrenches], [float(r["fz"]) for r in rows[1]])
        # Times are those that a person would write, not 0.090900000000000009.
        self.assertEqual([r["t"] for r in rows[0][:4]], ["0", "0.0303", "0.0606", "0.0909"])

    def test_another_scene_than_that_of_the_recording_is_said(self):
        """A bag of results says what scene they are of; one of inputs alone goes with any."""
        scene = os.path.join(self.folder, "scene.yaml")
        for name in ("block.msh", "probe.urdf"):
            shutil.copy(os.path.join(SCENES, name), self.folder)
        with open(os.path.join(SCENES, "block.yaml")) as f:
            text = f.read()
        with open(scene, "w") as f:
            f.write(text)
        write_joints(self.path("in.bag"), count=20)
        code, _, errors = self.replay("in.bag", scene=scene, out="results.bag")
        self.assertEqual(code, 0, errors)
        self.assertNotIn("WARNING", errors)
        record, = messages(self.path("results.bag"), "/run_record")
        self.assertEqual(record.scene_text, text)
        code, _, errors = self.replay("results.bag", scene=scene)
        self.assertEqual(code, 0, errors)
        self.assertNotIn("WARNING", errors)
        # Elsewhere, but the same.
        code, _, errors = self.replay("results.bag")
        self.assertNotIn("WARNING", errors)

        with open(os.path.join(self.folder, "block.msh"), "a") as f:
            f.write("\n")
        with open(scene, "w") as f:
            f.write(text.replace("step: 0.01", "step: 0.008"))
        code, _, errors = self.replay("results.bag", scene=scene)
        self.assertEqual(code, 0, errors)
        self.assertIn("WARNING: %s was recorded with another scene" % self.path("results.bag"), errors)
        self.assertIn("solver.step: 0.01 then, 0.008 now", errors)
        self.assertIn("block.msh (organs[0].tetrahedra): sha256 ", errors)
        self.assertIn("scene.yaml (scene): sha256 ", errors)

    def test_bad_messages_are_dropped_and_counted(self):
        write_joints(self.path("in.bag"), bad=(3, 50))
        code, table, errors = self.replay("in.bag")
        self.assertEqual(code, 0, errors)
        self.assertIn("2 messages dropped", errors)
        wrenches = messages(self.path("out.bag"), "/probe/spatial/measured_cf")
        self.assertEqual(len(wrenches), 98)
        for m in wrenches:
            self.assertTrue(all(math.isfinite(x) for x in numbers(m)))

    def test_time_that_goes_back_starts_anew(self):
        with rosbag.Bag(self.path("in.bag"), "w") as bag:
            for k, start in enumerate((1000, 500)):
                for i in range(50):
                    stamp = rospy.Time(start, i * 10000000)
                    bag.write("/probe/measured_js", joint_state(height(i / 50), stamp),
                              rospy.Time(2000 + k, i * 10000000))
        code, _, errors = self.replay("in.bag")
        self.assertEqual(code, 0, errors)
        wrenches = {}
        for m in messages(self.path("out.bag"), "/probe/spatial/measured_cf"):
            wrenches.setdefault(m.header.stamp.secs, []).append(bits(m))
        self.assertEqual(len(wrenches[500]), 50)
        self.assertEqual(wrenches[500][0], wrenches[1000][0])
        forces = [struct.unpack("6d", w)[2] for w in wrenches[500]]
        self.assertGreater(max(forces), 0.02)
        code, _, errors = self.replay("in.bag", "--trajectory", self.path("t.csv"))
        self.assertEqual(code, 2)
        self.assertIn("time goes back", errors)
        self.assertFalse(os.path.exists(self.path("t.csv")))

    def test_looped_twice_is_the_same_bit_for_bit(self):
        # As rosbag play --loop says it: the stamps come again.
        with rosbag.Bag(self.path("in.bag"), "w") as bag:
            for k in range(2):
                for i in range(50):
                    bag.write("/probe/measured_js", joint_state(height(i / 50), rospy.Time(1000, i * 10000000)),
                              rospy.Time(2000 + k, i * 10000000))
        code, _, errors = self.replay("in.bag", "--csv", self.path("out.csv"))
        self.assertEqual(code, 0, errors)
        with open(self.path("out.csv")) as file:  # in the order of cycles; a bag has them by their stamps
            hashes = [row["state_hash"] for row in csv.DictReader(file)]
        self.assertEqual(len(hashes), 100)
        self.assertEqual(hashes[50:], hashes[:50])
        self.assertGreater(len(set(hashes)), 20)

    def test_tf_in_the_bag(self):
        with rosbag.Bag(self.path("in.bag"), "w") as bag:
            fixed = TransformStamped()
            fixed.header.frame_id, fixed.child_frame_id = "world", "rail"
            fixed.transform.translation.z, fixed.transform.rotation.w = 0.1, 1.0
            bag.write("/tf_static", TFMessage([fixed]), rospy.Time(999))
            for i in range(50):
                t = TransformStamped()
                t.header.stamp = rospy.Time(1000, i * 10000000)
                t.header.frame_id, t.child_frame_id = "rail", "tool/tip"
                t.transform.translation.z, t.transform.rotation.w = height(i / 50), 1.0
                bag.write("/tf", TFMessage([t]), t.header.stamp)
        code, _, errors = self.replay("in.bag", scene="block_tf.yaml")
        self.assertEqual(code, 0, errors)
        wrenches = messages(self.path("out.bag"), "/probe/body/measured_cf")
        self.assertEqual(len(wrenches), 50)
        self.assertGreater(max(m.wrench.force.z for m in wrenches), 0.02)
        self.assertEqual(wrenches[0].header.frame_id, "tool/tip")
        code, _, errors = self.replay("in.bag", "--trajectory", self.path("t.csv"),
                                      scene="block_tf.yaml")
        self.assertEqual(code, 2)
        self.assertIn("no joints", errors)

    def refused(self, words, bag, *arguments, **more):
        code, _, errors = self.replay(bag, *arguments, **more)
        self.assertEqual(code, 2, errors)
        for word in words:
            self.assertIn(word, errors)
        self.assertFalse(os.path.exists(self.path("out.bag")))
        self.assertEqual(glob.glob(self.path("out.bag.part*")), [])

    def test_bad_bags_are_refused(self):
        self.refused(["none.bag"], "none.bag")
        with open(self.path("empty.bag"), "wb"):
            pass
        self.refused(["empty.bag"], "empty.bag")
        with open(self.path("text.bag"), "w") as f:
            f.write("t,x,y\n" * 1000)
        self.refused(["text.bag"], "text.bag")
        write_joints(self.path("in.bag"))
        size = os.path.getsize(self.path("in.bag"))
        for part in (20, 5000, size // 2, size - 10):
            shutil.copy(self.path("in.bag"), self.path("cut.bag"))
            os.truncate(self.path("cut.bag"), part)
            self.refused(["cut.bag"], "cut.bag")
        # Cut off while recording: no index.
        with open(self.path("in.bag"), "r+b") as f:
            head = bytearray(f.read(4200))
            at = head.index(b"index_pos=") + len(b"index_pos=")
            f.seek(at)
            f.write(struct.pack("<Q", 0))
        self.refused(["reindex"], "in.bag")

    def test_bags_without_the_motion_are_refused_with_what_is_there(self):
        with rosbag.Bag(self.path("other.bag"), "w") as bag:
            bag.write("/arm/measured_js", joint_state(0.0, rospy.Time(1)), rospy.Time(1))
        self.refused(["/probe/measured_js", "/arm/measured_js"], "other.bag")
        with rosbag.Bag(self.path("type.bag"), "w") as bag:
            bag.write("/probe/measured_js", TFMessage(), rospy.Time(1))
        self.refused(["tf2_msgs/TFMessage"], "type.bag")
        write_joints(self.path("bad.bag"), count=3, bad=(0, 1, 2))
        self.refused(["no usable input", "x"], "bad.bag")
        write_joints(self.path("in.bag"))
        code, _, errors = self.replay("in.bag", out="in.bag")
        self.assertEqual(code, 2)
        self.assertIn("another file", errors)


if __name__ == "__main__":
    rostest.rosrun("palpate", "replay_bag_test", ReplayBag)
