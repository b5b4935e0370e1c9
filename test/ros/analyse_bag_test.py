#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/analyse_bag.py on bags that are written here: it finds what there is, and warns where it should."""
import csv
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import rosbag
import rospy
from geometry_msgs.msg import WrenchStamped
from palpate.msg import StepReport

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPT = os.path.join(ROOT, "scripts", "analyse_bag.py")
START, STEP = 1000.0, 0.01  # [s]


def wrench(x, z=0.0):
    m = WrenchStamped()
    m.wrench.force.x, m.wrench.force.z = x, z
    return m


def report(time, step=STEP, state="RUNNING", cycle_ms=2.0):
    return StepReport(time=time, step=step, state=state, status="converged", contacts=3 if time > 0.1 else 0,
                      max_penetration=1e-3, mesh_error=0.25, skipped_far_bodies=2, cycle_ms=cycle_ms)


class AnalyseBag(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="analyse_bag_test_")
        self.bag = os.path.join(self.folder, "some.bag")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, rows):
        """Of rows (t, topic, message)."""
        with rosbag.Bag(self.bag, "w") as bag:
            for t, topic, message in sorted(rows, key=lambda row: row[0]):
                bag.write(topic, message, rospy.Time.from_sec(START + t))

    def analyse(self, *arguments, status=0):
        done = subprocess.run([SCRIPT, self.bag, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True, timeout=120)
        self.assertEqual(done.returncode, status, done.stdout)
        return done.stdout

    def path(self, name):
        return os.path.join(self.folder, name)

    def reports(self, topic="/step_report", speed=1.0, count=100, every=STEP):
        return [(k * every, topic, report((k + 1) * every * speed, step=every * speed)) for k in range(count)]

    def test_two_instruments(self):
        rows = self.reports()
        for name, force in ("left", 0.5), ("right", 1.25):
            for ending, sign in ("spatial", 1.0), ("body", -2.0):
                topic = "/%s/%s/measured_cf" % (name, ending)
                rows += [(0.001 * k, topic, wrench(sign * force * k / 999)) for k in range(1000)]
        self.write(rows)
        said = self.analyse("--csv", self.path("f.csv"), "--plot", self.path("f.png"))
        self.assertRegex(said, r"peak force of left +0\.500 N")
        self.assertRegex(said, r"peak force of right +1\.250 N")
        self.assertRegex(said, r"force loop rate of right +1000 Hz")
        self.assertRegex(said, r"contacts, most at once +3\n")
        self.assertRegex(said, r"cycles, of which not converged +100, 0\n")
        self.assertRegex(said, r"work skipped +far bodies 200,")
        self.assertNotIn("WARNING", said)
        with open(self.path("f.csv"), encoding="utf-8") as file:
            table = list(csv.DictReader(file))
        self.assertEqual(len(table), 2000)
        self.assertEqual({row["instrument"] for row in table}, {"left", "right"})
        self.assertEqual(max(float(row["fx"]) for row in table if row["instrument"] == "right"), 1.25)
        self.assertEqual([float(row["t"]) for row in table], sorted(float(row["t"]) for row in table))
        with open(self.path("f.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    def test_one_instrument_of_another_name_and_nothing_asked_for(self):
        self.write(self.reports() + [(0.01 * k, "/lab/fan/spatial/measured_cf", wrench(0.3, -0.4)) for k in range(100)] +
                   [(k * STEP, "/lab/step_report", report(k * STEP)) for k in range(100)])
        said = self.analyse()
        self.assertRegex(said, r"peak force +0\.500 N")
        self.assertRegex(said, r"cycles, of which not converged +100, 0\n")
        self.assertEqual(os.listdir(self.folder), ["some.bag"])
        self.analyse("--csv", self.path("f.csv"))
        with open(self.path("f.csv"), encoding="utf-8") as file:
            self.assertEqual(next(csv.reader(file)), ["t", "fx", "fy", "fz", "tx", "ty", "tz"])

    def test_body_wrenches_alone_and_no_reports(self):
        self.write([(0.01 * k, "/probe/body/measured_cf", wrench(0.5)) for k in range(100)])
        said = self.analyse("--plot", self.path("f.png"))
        self.assertRegex(said, r"peak force +0\.500 N")
        self.assertIn("no step reports of /step_report were recorded", said)
        self.assertTrue(os.path.exists(self.path("f.png")))

    def test_two_nodes(self):
        rows = []
        for name, force in ("/a", 0.5), ("/b", 0.75):
            rows += self.reports(name + "/step_report")
            rows += [(0.01 * k, name + "/probe/spatial/measured_cf", wrench(force)) for k in range(100)]
        self.write(rows)
        said = self.analyse("--csv", self.path("f.csv"))
        self.assertRegex(said, r"/a:\n +peak force +0\.500 N(.|\n)*/b:\n +peak force +0\.750 N")
        self.assertEqual(sorted(os.listdir(self.folder)), ["f_a.csv", "f_b.csv", "some.bag"])

    def test_what_is_simulated_too_slowly_is_said(self):
        wrenches = [(0.01 * k, "/probe/spatial/measured_cf", wrench(0.5)) for k in range(100)]
        self.write(self.reports(speed=0.5) + wrenches)
        self.assertIn("WARNING: 50 % of real time was simulated", self.analyse())

    def test_no_warning_where_nothing_is_slow(self):
        topic, reports = "/step_report", {}
        # Rows 20 ms apart, each cut into two steps of 10 ms, of which a report has the last one's length.
        reports["cut in two"] = [(0.02 * k, topic, report(0.02 * (k + 1), step=0.01)) for k in range(50)]
        # The hand is still for a second in the middle: no time is simulated.
        reports["pause"] = [(k * STEP, topic, report(k * STEP)) for k in range(40)]
        reports["pause"] += [(0.4 + 0.1 * k, topic, report(0.39, state="PAUSED")) for k in range(10)]
        reports["pause"] += [(1.4 + k * STEP, topic, report(0.4 + k * STEP)) for k in range(40)]
        # Reset half way: simulated time begins anew.
        reports["reset"] = [(k * STEP, topic, report((k % 50) * STEP)) for k in range(100)]
        # The recorder missed every third report.
        reports["missed"] = [row for k, row in enumerate(self.reports()) if k % 3]
        for name, rows in reports.items():
            end = rows[-1][0]
            self.write(rows + [(end * k / 99, "/probe/spatial/measured_cf", wrench(0.5)) for k in range(100)])
            self.assertNotIn("WARNING", self.analyse(), name)

    def test_a_replay_has_no_cycle_times(self):
        self.write([(k * STEP, "/step_report", report(k * STEP, cycle_ms=0.0)) for k in range(100)] +
                   [(k * STEP, "/probe/spatial/measured_cf", wrench(0.5)) for k in range(100)])
        self.assertNotIn("cycle time", self.analyse("--plot", self.path("f.png")))

    def test_bags_without_what_is_needed(self):
        self.write([(0.0, "/chatter", wrench(1.0))])
        self.assertIn("/chatter", self.analyse(status=1))
        self.write([(0.01 * k, "/probe/spatial/measured_cf", wrench(float("nan"))) for k in range(9)])
        self.assertIn("/probe/spatial/measured_cf: a wrench is not finite", self.analyse(status=1))
        self.write([(0.01 * k, "/probe/spatial/measured_cf", wrench(1.0)) for k in range(9)] +
                   [(0.0, "/step_report", report(0.0, state="WAITING"))])
        self.assertIn("its last state is WAITING", self.analyse(status=1))
        with open(self.bag, "wb") as file:
            file.write(b"no bag")
        self.assertIn("some.bag", self.analyse(status=1))
        self.assertFalse(re.search("Traceback", self.analyse(status=1)))
        os.remove(self.bag)
        self.assertFalse(re.search("Traceback", self.analyse(status=1)))


if __name__ == "__main__":
    unittest.main()
