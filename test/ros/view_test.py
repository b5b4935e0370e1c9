#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the node tells rviz: tf of the instruments' links, their descriptions, words on its state, a configuration."""
import os
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree as ElementTree

import roslib.packages
import rospkg
import rospy
import rostest
import yaml
from geometry_msgs.msg import WrenchStamped
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import ABOVE, TOUCHING, Ear, Hand, Programs, joint_state, report_ear  # noqa: E402

SCENES = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes")
LINKS = {l.get("name") for l in ElementTree.parse(os.path.join(SCENES, "probe.urdf")).getroot().iter("link")}


class Frames:
    """All transforms since it was made."""

    def __init__(self):
        self.static, self.moving = Ear("/tf_static", TFMessage), Ear("/tf", TFMessage)

    def sent(self):
        """Those that moved."""
        return [t for message in self.moving.all() for t in message.transforms]

    def place(self, frame):
        """Of a frame in world, or None. Only links that nothing hangs on turn."""
        newest = {t.child_frame_id: t for message in self.static.all() for t in message.transforms}
        newest.update((t.child_frame_id, t) for t in self.sent())
        place = [0.0, 0.0, 0.0]
        while frame != "world":
            if frame not in newest:
                return None
            p = newest[frame].transform.translation
            place = [a + b for a, b in zip(place, (p.x, p.y, p.z))]
            frame = newest[frame].header.frame_id
        return place

    def wait(self, frame, place, timeout=5.0):
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            found = self.place(frame)
            if found and max(abs(a - b) for a, b in zip(found, place)) < 1e-6:
                return True
            time.sleep(0.05)
        return False


class View(unittest.TestCase):
    def setUp(self):
        self.programs, self.hands = Programs(), []
        self.frames = Frames()
        self.words, self.configs = Ear("state_text", Marker), Ear("rviz_config", String)

    def tearDown(self):
        for hand in self.hands:
            hand.stop()
        self.end()

    def end(self):
        """All programs, so that they leave the graph."""
        for program in self.programs.all:
            if program.poll() is None:
                program.terminate()
                program.wait(10)
        for node in ("palpate", "guard"):
            if rospy.has_param(node):
                rospy.delete_param(node)

    def start(self, scene, *parameters):
        scene = os.path.join(SCENES, scene)
        node = self.programs.node("palpate_node", "__name:=palpate", "_scene:=" + scene, *parameters)
        self.assertIsNotNone(self.configs.wait(lambda m: True, 30.0))
        return node

    def hand(self, topic):
        self.hands.append(Hand(topic))
        return self.hands[-1]

    def said(self, word, timeout=5.0):
        self.assertIsNotNone(self.words.wait(lambda m: word in m.text, timeout), word)

    def test_two_instruments_of_one_urdf_have_frames_of_their_own(self):
        self.start("block_two.yaml")
        bodies = {n: Ear(n + "/body/measured_cf", WrenchStamped) for n in ("left", "right")}
        # Before any input all joints are at zero: the tips are at the bases.
        self.assertTrue(self.frames.wait("left/tip", (-0.02, 0, 0.1)), self.frames.place("left/tip"))
        self.assertTrue(self.frames.wait("right/tip", (0.02, 0, 0.1)))
        self.hand("left/measured_js").hold(ABOVE)
        self.hand("right/measured_js").hold(TOUCHING)
        self.assertTrue(self.frames.wait("left/tip", (-0.02, 0, 0.1 + ABOVE)))
        self.assertTrue(self.frames.wait("right/tip", (0.02, 0, 0.1 + TOUCHING)))
        time.sleep(1.0)
        sent = self.frames.sent()
        frames = {t.child_frame_id for t in sent}
        self.assertEqual(frames, {n + "/" + l for n in ("left", "right") for l in LINKS - {"base"}})
        self.assertEqual({t.header.frame_id for t in sent}, {"left/base", "right/base"})
        # What tf warns of as TF_REPEATED_DATA and TF_OLD_DATA.
        for frame in frames:
            stamps = [t.header.stamp for t in sent if t.child_frame_id == frame]
            self.assertEqual(stamps, sorted(set(stamps)), frame)
        for name, ear in bodies.items():
            self.assertIsNotNone(ear.wait(lambda m: m.header.frame_id == name + "/tip"), name)
            self.assertEqual({m.header.frame_id for m in ear.all()}, {name + "/tip"})
            urdf = ElementTree.fromstring(rospy.get_param("/%s/robot_description" % name))
            self.assertEqual({l.get("name") for l in urdf.iter("link")}, {name + "/" + l for l in LINKS})

    def test_unique_frames_stay_as_they_are(self):
        self.start("block.yaml", "_instruments/probe/joint_topic:=/arm/joints")
        self.hand("/arm/joints").hold(TOUCHING)
        self.assertTrue(self.frames.wait("tip", (0, 0, 0.1 + TOUCHING)), self.frames.place("tip"))
        body = Ear("probe/body/measured_cf", WrenchStamped)
        self.assertIsNotNone(body.wait(lambda m: m.header.frame_id == "tip"))
        urdf = ElementTree.fromstring(rospy.get_param("/probe/robot_description"))
        self.assertEqual({l.get("name") for l in urdf.iter("link")}, LINKS)

    def test_who_comes_late_sees_a_tool_that_rests(self):
        self.start("block.yaml")
        hand, reports = self.hand("probe/measured_js"), report_ear()
        hand.hold(ABOVE)
        self.assertIsNotNone(reports.wait(lambda m: m.state == "RUNNING"))
        hand.stop()
        self.assertIsNotNone(reports.wait(lambda m: m.state == "PAUSED"))
        late = Frames()
        self.assertTrue(late.wait("tip", (0, 0, 0.1 + ABOVE)), late.place("tip"))

    def test_stamps_that_go_back_do_not_stop_tf(self):
        self.start("block.yaml")
        hand = self.hand("probe/measured_js")
        hand.hold(ABOVE)
        self.assertTrue(self.frames.wait("tip", (0, 0, 0.1 + ABOVE)))
        hand.send(lambda: joint_state(TOUCHING, stamp=rospy.Time.now() - rospy.Duration(1000.0)))
        self.assertTrue(self.frames.wait("tip", (0, 0, 0.1 + TOUCHING)), self.frames.place("tip"))

    def test_tf_of_others_is_left_to_them(self):
        rospy.set_param("/probe/robot_description", "<robot name='other'/>")
        self.start("block.yaml", "_publish_links:=false")
        self.hand("probe/measured_js").hold(ABOVE)
        time.sleep(1.5)
        self.assertEqual(self.frames.moving.all(), [])
        self.assertEqual(rospy.get_param("/probe/robot_description"), "<robot name='other'/>")
        rospy.delete_param("/probe/robot_description")

    def test_words_say_why_there_is_no_force(self):
        self.start("block.yaml")
        self.said("WAITING for topic /probe/measured_js")
        hand = self.hand("probe/measured_js")
        hand.hold(TOUCHING)  # where it never came to: it is not let in
        self.said("probe is held outside")
        hand.hold(ABOVE)
        self.assertIsNotNone(self.words.wait(lambda m: m.action == Marker.DELETE))
        hand.stop()
        self.said("PAUSED")
        # Latched: rviz may start when it likes.
        self.words = Ear("state_text", Marker)
        self.said("PAUSED")

    def test_the_configuration_names_what_there_is(self):
        self.configs = Ear("/theatre/rviz_config", String)
        self.start("block_two.yaml", "__ns:=theatre")
        config = yaml.safe_load(self.configs.last().data)
        displays = config["Visualization Manager"]["Displays"]
        topics = {d.get("Marker Topic") or d.get("Topic") for d in displays} - {None}
        published = {name for name, _ in rospy.get_published_topics()}
        self.assertEqual(topics - published, set())
        descriptions = {d["Robot Description"] for d in displays if "Robot Description" in d}
        self.assertEqual(descriptions, {"/theatre/%s/robot_description" % n for n in ("left", "right")})
        self.assertTrue(all(rospy.has_param(d) for d in descriptions))

    def test_a_guard_finds_the_wrench_by_the_scene(self):
        def refused(*arguments):
            done = subprocess.run([roslib.packages.find_node("palpate", "palpate_guard")[0], "__name:=lost", "_output:=/device"] + list(arguments),
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=20, universal_newlines=True)
            self.assertEqual(done.returncode, 2, done.stdout)
            return done.stdout

        two = "_scene:=" + os.path.join(SCENES, "block_two.yaml")
        self.assertIn("left, right", refused(two))
        self.assertIn("must be an instrument", refused(two, "_instrument:=middle"))
        self.assertIn("not both", refused(two, "_input:=/a"))
        for scene, more, topic in (("block_two.yaml", ["_instrument:=right"], "/right/body/measured_cf"),
                                   ("block.yaml", [], "/probe/body/measured_cf")):
            wrenches, device = rospy.Publisher(topic, WrenchStamped, queue_size=1), Ear("/device", WrenchStamped)
            self.programs.node("palpate_guard", "__name:=guard", "_output:=/device", "_ramp:=0",
                               "_scene:=" + os.path.join(SCENES, scene), *more)
            wrench = WrenchStamped()
            wrench.header.frame_id, wrench.wrench.force.x = "tip", 0.01
            end = time.monotonic() + 10.0
            while not any(m.wrench.force.x > 0.0 for m in device.all()) and time.monotonic() < end:
                wrenches.publish(wrench)
                time.sleep(0.01)
            self.assertTrue(any(m.wrench.force.x > 0.0 for m in device.all()), topic)
            self.end()


if __name__ == "__main__":
    rospy.init_node("view_test")
    rostest.rosrun("palpate", "view_test", View)
