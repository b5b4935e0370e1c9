#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""play.launch plays a motion into the node, replay.launch the inputs of a recorded session, each on its topics."""
import bisect
import csv
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import rosbag
import rospkg
import rospy
import rostest
from geometry_msgs.msg import WrenchStamped
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import JOINTS, Ear, Programs, force, report_ear, transform  # noqa: E402

SCENES = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes")
PROBE = [0.0, 0.0, 0.0, 0.0, 0.6, 0.0]
END = 1.2  # [s] of the motions here


def depth(t, most=0.004):
    """How far down from its beginning the ball is: down by twice `most` and back."""
    return most * (1.0 - math.cos(2.0 * math.pi * t / END))


def write_motion(file, tools, start=3.0):
    """Down into the block and back, in 41 rows; `tools`: column prefix to height at first [m]."""
    with open(file, "w") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["t"] + [prefix + joint for prefix in tools for joint in JOINTS])
        for k in range(41):
            t = END * k / 40
            row = ["%.6f" % (start + t)]
            for n, height in enumerate(tools.values()):
                q = list(PROBE)
                q[2] = height - depth(t) * (1.0 + 0.1 * n)
                row += ["%.9f" % x for x in q]
            table.writerow(row)


def rows_of(file):
    with open(file) as f:
        rows = [{name: float(x) for name, x in row.items()} for row in csv.DictReader(f)]
    first = rows[0]["t"]
    for row in rows:
        row["t"] -= first
    return rows


def value(rows, name, t):
    """On the line between two rows."""
    k = min(max(bisect.bisect_right([row["t"] for row in rows], t), 1), len(rows) - 1)
    a, b = rows[k - 1], rows[k]
    s = (t - a["t"]) / (b["t"] - a["t"])
    return (1.0 - s) * a[name] + s * b[name]


def messages(bag, topic):
    with rosbag.Bag(bag) as file:
        return [m for _, m, _ in file.read_messages(topics=[topic])]


def topics(bag):
    with rosbag.Bag(bag) as file:
        return set(file.get_type_and_topic_info().topics)


class Play(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="play_test_")
        self.programs = Programs(dict(os.environ, PWD=self.folder))
        for node in "/palpate", "/player", "/recorder":  # what a test before has set
            if rospy.has_param(node):
                rospy.delete_param(node)

    def tearDown(self):
        self.programs.end()
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def launch(self, file, scene, *arguments):
        """Runs it to its end; what it prints."""
        out = self.path("log")
        with open(out, "w") as log:
            done = self.programs.start(
                "roslaunch", "palpate", file, "scene:=" + os.path.join(SCENES, scene), *arguments,
                stdout=log, stderr=subprocess.STDOUT, cwd=self.folder)
            status = done.wait(60)
        with open(out) as log:
            said = log.read()
        self.assertEqual(status, 0, said)
        self.assertIn("[player-", said)
        self.assertIn("finished cleanly", said)
        return said

    def expect_played(self, sent, rows, value_of, rate=1.0):
        """Messages follow the table at their stamps, as far from the last one, which is the last row's."""
        last = sent[-1].header.stamp
        times = [END - rate * (last - m.header.stamp).to_sec() for m in sent]
        self.assertGreater(len(sent), 100)
        self.assertLess(times[0], 0.2)
        for t, m in zip(times, sent):
            for name, x in value_of(m).items():
                self.assertAlmostEqual(x, value(rows, name, t), delta=1e-7, msg="%s at %f" % (name, t))

    def test_two_instruments_by_their_topics_and_the_session_again(self):
        """The CSV first, then the bag that was recorded meanwhile: of that only the inputs."""
        write_motion(self.path("motion.csv"), {"left/": -0.06, "right/": -0.061})
        self.launch("play.launch", "block_two.yaml", "trajectory:=motion.csv", "record:=session.bag", "rate:=0.8")
        rows, session = rows_of(self.path("motion.csv")), self.path("session.bag")
        for name in "left", "right":
            sent = messages(session, "/%s/measured_js" % name)
            self.assertEqual(sent[0].name, JOINTS)
            self.expect_played(sent, rows, lambda m, n=name: {n + "/" + j: x for j, x in zip(m.name, m.position)}, 0.8)
            felt = messages(session, "/%s/spatial/measured_cf" % name)
            self.assertGreater(max(force(m) for m in felt), 0.02)
        self.assertLessEqual({"/left/body/measured_cf", "/right/contact_model", "/step_report", "/run_record"},
                             topics(session))
        self.assertFalse({"/organs", "/tf", "/tf_static"} & topics(session))

        ears = {t: Ear(t, kind) for t, kind in (("left/measured_js", JointState),
                                                ("left/spatial/measured_cf", WrenchStamped))}
        before = rospy.get_rostime()
        self.launch("replay.launch", "block_two.yaml", "bag:=" + session, "rviz:=false")
        self.assertFalse(rospy.has_param("/use_sim_time"))
        joints, wrenches = ears["left/measured_js"].all(), ears["left/spatial/measured_cf"].all()
        self.assertEqual({m._connection_header["callerid"] for m in joints}, {"/player"})
        self.assertEqual({m._connection_header["callerid"] for m in wrenches}, {"/palpate"})
        recorded = messages(session, "/left/measured_js")
        self.assertEqual([m.position for m in joints], [m.position for m in recorded])
        # Their stamps are of now, as far apart as they were.
        self.assertGreater(joints[0].header.stamp, before)
        for a, b in zip(joints, recorded):
            self.assertAlmostEqual((a.header.stamp - joints[0].header.stamp).to_sec(),
                                   (b.header.stamp - recorded[0].header.stamp).to_sec(), delta=1e-6)
        self.assertGreater(max(force(m) for m in wrenches), 0.02)

    def test_by_tf_and_the_session_again(self):
        write_motion(self.path("motion.csv"), {"": 0.04})
        self.launch("play.launch", "block_tf.yaml", "trajectory:=" + self.path("motion.csv"),
                    "record:=" + self.path("session"))
        rows, session = rows_of(self.path("motion.csv")), self.path("session.bag")
        tips = [t for m in messages(session, "/tf") for t in m.transforms if t.child_frame_id == "tool/tip"]
        self.assertEqual({t.header.frame_id for t in tips}, {"world"})
        self.expect_played(tips, rows, lambda t: {"z": t.transform.translation.z, "x": t.transform.translation.x})
        for t in tips:
            self.assertAlmostEqual(t.transform.rotation.y, math.sin(0.3), delta=1e-7)
        felt = [force(m) for m in messages(session, "/probe/spatial/measured_cf")]
        self.assertGreater(max(felt), 0.02)

        # A bag with frames that move nothing, and one that comes by way of another frame.
        with rosbag.Bag(self.path("tf.bag"), "w") as bag:
            for k in range(60):
                stamp = rospy.Time(1000) + rospy.Duration(0.02 * k)
                mount = transform("world", "mount", 0.04 - depth(0.02 * k), stamp)
                tip = transform("mount", "tool/tip", 0.0, stamp)
                tip.transform.rotation.y, tip.transform.rotation.w = 0.0, 1.0
                camera = transform("world", "camera", 1.0, stamp)
                bag.write("/tf", TFMessage([mount, tip, camera]), stamp)
                bag.write("/probe/spatial/measured_cf", WrenchStamped(), stamp)
        heard, wrenches = Ear("/tf", TFMessage), Ear("probe/spatial/measured_cf", WrenchStamped)
        self.launch("replay.launch", "block_tf.yaml", "bag:=" + self.path("tf.bag"), "rviz:=false", "rate:=1.0")
        self.assertEqual([{t.child_frame_id for t in m.transforms} for m in heard.all()], [{"mount", "tool/tip"}] * 60)
        self.assertEqual({m._connection_header["callerid"] for m in wrenches.all()}, {"/palpate"})
        self.assertGreater(max(force(m) for m in wrenches.all()), 0.02)

    def start_node(self, scene):
        self.programs.node("palpate_node", "__name:=palpate", "_scene:=" + os.path.join(SCENES, scene))
        rospy.wait_for_service("/palpate/reset", 30)

    def player(self, *arguments):
        return self.programs.node("palpate_play", "__name:=player", *arguments, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, universal_newlines=True)

    def test_a_node_that_runs_again_and_again(self):
        """The player alone takes the scene from the node, and resets the organs before it begins again."""
        write_motion(self.path("motion.csv"), {"": -0.06})
        self.start_node("block.yaml")
        reports, joints = report_ear(), Ear("probe/measured_js", JointState)
        player = self.player("_trajectory:=" + self.path("motion.csv"), "_loop:=true", "_rate:=4", "_publish_rate:=200")
        last = [value(rows_of(self.path("motion.csv")), j, END) for j in JOINTS]
        for _ in range(2):
            self.assertIsNotNone(joints.wait(lambda m: max(abs(a - b) for a, b in zip(m.position, last)) < 1e-9))
            joints.clear()
            self.assertIsNotNone(reports.wait(lambda m: m.time > 0.2))
            reports.clear()
            self.assertIsNotNone(reports.wait(lambda m: m.time < 0.1), "it did not begin anew")
        self.assertIsNone(player.poll())
        player.send_signal(15)
        self.assertEqual(player.wait(10), 0, player.stdout.read())

    def test_what_cannot_be_played_is_said_and_the_end(self):
        write_motion(self.path("motion.csv"), {"left/": -0.06})
        self.start_node("block_two.yaml")
        for arguments, words in (
                (("_trajectory:=" + self.path("motion.csv"),), ("right/x", "this joint has no column")),
                (("_trajectory:=" + self.path("nowhere.csv"),), (self.path("nowhere.csv"),)),
                ((), ("trajectory", "must be given")),
                (("_scene:=liver_palpatoin",), ("did you mean liver_palpation?",)),
                (("_speed:=2",), ("speed", "is unknown")),
                (("_rate:=0", "_trajectory:=" + self.path("motion.csv")), ("rate", "must be"))):
            player = self.player(*arguments)
            self.assertEqual(player.wait(20), 2, arguments)
            said = player.stdout.read()
            for word in words:
                self.assertIn(word, said)
            for name in "trajectory", "scene", "speed", "rate":
                if rospy.has_param("/player/" + name):
                    rospy.delete_param("/player/" + name)


if __name__ == "__main__":
    rospy.init_node("play_test")
    rostest.rosrun("palpate", "play_test", Play)
