#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Starts the node with parameters: bad ones end it with a message, good ones replace keys."""
import concurrent.futures
import hashlib
import os
import subprocess
import sys
import tempfile
import unittest

import rospkg
import roslib.packages
import rospy
import rostest
from palpate.msg import RunRecord

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from helpers import TOUCHING, Hand, diagnostics_ear, report_ear, status  # noqa: E402

SCENES = os.path.join(rospkg.RosPack().get_path("palpate"), "test", "ros", "scenes")
NODE = roslib.packages.find_node("palpate", "palpate_node")[0]


def next_name():
    run.count += 1
    return "node_%d" % (run.count - 1)


def run(*arguments, program="palpate_node", name=None):
    """Exit status and all that was said, of a program that should end by itself."""
    done = subprocess.run([roslib.packages.find_node("palpate", program)[0], "__name:=" + (name or next_name())] +
                          list(arguments), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=30,
                          universal_newlines=True)
    return done.returncode, done.stdout


run.count = 0


def run_all(programs):
    """Likewise of each (program, name), several at a time: most of their time they wait for who may listen."""
    with concurrent.futures.ThreadPoolExecutor(6) as pool:
        return list(pool.map(lambda p: run(program=p[0], name=p[1]), programs))


class Parameters(unittest.TestCase):
    def refused(self, words, *arguments):
        code, said = run(*arguments)
        self.assertEqual(code, 2, said)
        for word in words:
            self.assertIn(word, said)

    def test_no_scene(self):
        self.refused(["scene"])
        self.refused(["nowhere.yaml"], "_scene:=/nowhere.yaml")
        self.refused(["no_such_scene"], "_scene:=no_such_scene")

    def test_overrides_are_checked_all_at_once(self):
        scene = "_scene:=" + os.path.join(SCENES, "block.yaml")
        self.refused(["rates/simulation", "-3", "solver/stepp", "did you mean solver/step",
                      "instruments/probe/input", "joints, tf", "contact/stiffness"],
                     scene, "_rates/simulation:=-3", "_solver/stepp:=0.1",
                     "_instruments/probe/input:=hands", "_contact/stiffness:=soft")
        self.refused(["arrow_scale"], scene, "_arrow_scale:=-1.0")

    def test_the_cut_is_checked(self):
        scene = "_scene:=" + os.path.join(SCENES, "block.yaml")
        self.refused(["cutaway/rate", "cutaway/sizes", "did you mean cutaway/size"], scene, "_cutaway/rate:=-5.0",
                     "_cutaway/sizes:=1")
        # Lists come from files or the server, not from the command line.
        for corner, words in (([0, 0, 0], "takes all away"), ([2, 0, 0], "cutaway/corner"), ([1, 0], "three"), ([0.5, 0, 1], "whole")):
            rospy.set_param("/node_%d/cutaway/corner" % run.count, corner)
            self.refused(["cutaway/corner", words], scene)

    def test_unknown_parameters_are_refused_anywhere(self):
        scene = "_scene:=" + os.path.join(SCENES, "block.yaml")
        self.refused(["sceen", "did you mean scene"], scene, "_sceen:=liver_palpation")
        self.refused(["haptic/max_force", "did you mean haptics"], scene, "_haptic/max_force:=3.0")
        self.refused(["instruments/prob/input", "did you mean instruments/probe"], scene,
                     "_instruments/prob/input:=tf")
        self.refused(["proxy/max_sped", "max_speed"], scene, "_instruments/probe/proxy/max_sped:=0.1")
        self.refused(["wind", "known: scene"], scene, "_wind:=strong")

    def test_garbage_of_any_kind_is_refused(self):
        """Each parameter of the node itself, then one of each kind of a scene's keys, with values of other types."""
        scene = os.path.join(SCENES, "block.yaml")
        nan, inf, text = float("nan"), float("inf"), "t" * 1000000
        numbers = list(range(200000))
        own = {
            "scene": [5, 2.5, True, [scene], {"a": scene}, "", text],
            "initial_state": [5, [1, 2], text],
            "state_directory": [5, True, {"a": 1}, "", numbers],
            "arrow_scale": ["big", nan, inf, -1.0, [1.0], numbers, text],
            "publish_links": ["yes", 1, nan, text],
            "cutaway/corner": ["all", numbers, [nan, 0, 1], [1, "a", 0], {"x": 1}],
        }
        of_scene = {
            "rates/simulation": ["100 Hz", nan, -inf, 0, 1e308, True, numbers, text, {"a": 1}],
            "solver/max_newton_iterations": [2.5, "ten", nan],
            "solver/method": [5, "none", text, numbers],
            "instruments/probe/proxy/active": ["yes", 1, nan],
        }
        sections = {"solver": [numbers, "fast"], "instruments/probe": [5], "haptics": [nan], "contact": [text]}
        cases = {}
        for group in own, of_scene, sections:
            for k in range(max(len(values) for values in group.values())):
                name, wrong = next_name(), {key: values[k] for key, values in group.items() if k < len(values)}
                rospy.set_param("/" + name, {"scene": scene})
                for key, value in wrong.items():
                    rospy.set_param("/%s/%s" % (name, key), value)
                cases[name] = wrong
        for (name, wrong), (code, said) in zip(cases.items(), run_all([("palpate_node", name) for name in cases])):
            self.assertEqual(code, 2, said[:2000])
            for key in wrong:
                self.assertRegex(said, r"parameters of /%s: %s\b" % (name, key))
            self.assertLess(len(said), 20000)
            rospy.delete_param("/" + name)

    def test_names_nobody_knows_are_refused_whatever_they_are(self):
        scene = os.path.join(SCENES, "block.yaml")
        name = "/node_%d" % run.count
        rospy.set_param(name, {"scene": scene, "n" * 1000000: 1, "rates": {"s" * 100000: 2}})
        code, said = run()
        self.assertEqual(code, 2, said[:2000])
        self.assertIn("is unknown", said)
        self.assertLess(len(said), 20000)
        rospy.delete_param(name)
        name = "/node_%d" % run.count
        rospy.set_param(name, {"scene": scene, "solver": {"key%d" % k: k for k in range(20000)}})
        code, said = run()
        self.assertEqual(code, 2, said[:2000])
        self.assertIn("19950 more", said)
        rospy.delete_param(name)

    def test_guard_and_device_refuse_garbage(self):
        garbage = {"palpate_guard": (("patience", "long"), ("input", 5), ("ramp", float("nan")), ("rampe", 1.0),
                                     ("max_force", -1.0)),
                   "palpate_device": (("names", 5), ("start", ["a"]), ("start", [float("nan")] * 6), ("speed", "fast"),
                                      ("mas", 1.0))}
        right = {"palpate_guard": {"input": "a", "output": "b"}, "palpate_device": {"after": ""}}
        cases = [(program, next_name(), key, value) for program, values in garbage.items() for key, value in values]
        for program, name, key, value in cases:
            rospy.set_param("/" + name, dict(right[program], **{key: value}))
        for case, (code, said) in zip(cases, run_all([case[:2] for case in cases])):
            self.assertEqual(code, 2, (case, said))
            self.assertIn(case[2], said)

    def test_bad_state_file(self):
        with tempfile.NamedTemporaryFile("w", suffix=".state") as f:
            f.write("nonsense\n")
            f.flush()
            self.refused([f.name, "is no state"], "_scene:=" + os.path.join(SCENES, "block.yaml"),
                         "_initial_state:=" + f.name)

    def test_sets_what_the_libraries_read_before_main(self):
        bare = {k: v for k, v in os.environ.items()
                if k not in ("OMP_THREAD_LIMIT", "OPENBLAS_NUM_THREADS",
                             "OPENBLAS_CORETYPE")}
        node = subprocess.Popen([NODE, "__name:=bare",
                                 "_scene:=" + os.path.join(SCENES, "block.yaml")], env=bare)
        try:
            diagnostics = diagnostics_ear()
            self.assertIsNotNone(diagnostics.wait(
                lambda d: any(s.name.startswith("bare: ") for s in d.status), 20.0))
            with open("/proc/%d/environ" % node.pid, "rb") as f:
                settings = f.read().decode().split("\0")
            self.assertIn("OMP_THREAD_LIMIT=1", settings)
            self.assertIn("OPENBLAS_NUM_THREADS=1", settings)
            with open("/proc/cpuinfo") as f:
                cpu = f.read()
            if "GenuineIntel" in cpu and "avx512vl" in cpu:
                self.assertIn("OPENBLAS_CORETYPE=SKYLAKEX", settings)
        finally:
            node.send_signal(2)
            self.assertEqual(node.wait(10), 0)

    def test_lists_stay_those_of_the_file(self):
        scene = "_scene:=gallbladder_bimanual"
        rospy.set_param("/node_%d/contact/friction/pairs" % run.count, [{"instrument": "left", "static": 0.1}])
        self.refused(["contact/friction/pairs", "cannot be a parameter: change it in the scene file"], scene)
        rospy.set_param("/node_%d/contact/apart" % run.count, [])
        self.refused(["contact/apart", "cannot be a parameter"], scene)

    def test_the_run_record_says_what_ran(self):
        """Also to who comes late; with the lists of the file, and the keys that parameters replaced."""
        node = subprocess.Popen([NODE, "__name:=recorded", "_scene:=gallbladder_bimanual", "_rates/stale_after:=0.3"])
        try:
            rospy.wait_for_service("/recorded/reset", 60)
            record = rospy.wait_for_message("run_record", RunRecord, 10)
            keys = {k.key: k.value for k in record.keys}
            self.assertEqual(keys["contact.friction.pairs[0].static"], "0.6")
            self.assertEqual(keys["rates.stale_after"], "0.3")
            self.assertEqual({k.key: k.value for k in record.replaced}, {"rates.stale_after": "0.2"})
            files = {f.key: f for f in record.files}
            self.assertEqual(os.path.realpath(files["scene"].path), os.path.realpath(record.scene))
            with open(record.scene, encoding="utf-8") as f:
                self.assertEqual(f.read(), record.scene_text)
            for f in record.files:
                with open(f.path, "rb") as bytes_of_file:
                    self.assertEqual(hashlib.sha256(bytes_of_file.read()).hexdigest(), f.sha256, f.path)
            self.assertLessEqual({"organs[0].surface", "organs[1].surface", "organs[0].material.file",
                                  "instruments[0].urdf", "instruments[1].urdf"}, set(files))
            self.assertRegex(record.commit, r"^([0-9a-f]+\+?)?$")
            self.assertTrue(record.version)
        finally:
            node.send_signal(2)
            self.assertEqual(node.wait(20), 0)

    def test_overrides_count(self):
        node = subprocess.Popen([NODE, "__name:=overridden",
                                 "_scene:=" + os.path.join(SCENES, "block.yaml"),
                                 "_rates/simulation:=50", "_solver/step:=0.02", "_solver/method:=auto",
                                 "_instruments/probe/joint_topic:=other_js"])
        try:
            reports, diagnostics, hand = report_ear(), diagnostics_ear(), Hand("other_js")
            hand.hold(TOUCHING)
            running = reports.wait(lambda m: m.state == "RUNNING", 20.0)
            self.assertIsNotNone(running)
            self.assertEqual(running.step, 0.02)

            def wanted(d):
                s = status(d, "simulation")
                values = {v.key: v.value for v in s.values} if s else {}
                return (float(values.get("rate wanted [Hz]", 0.0)) == 50.0
                        and "method auto takes" in values.get("note", ""))

            self.assertIsNotNone(diagnostics.wait(wanted, 5.0))
        finally:
            node.send_signal(2)
            self.assertEqual(node.wait(10), 0)


if __name__ == "__main__":
    rospy.init_node("parameters_test")
    rostest.rosrun("palpate", "parameters_test", Parameters)
