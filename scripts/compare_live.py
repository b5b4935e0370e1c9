#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives palpate_node by a trajectory, a row a cycle, and compares it with `palpate replay`.

    . scripts/env.sh
    scripts/compare_live.py [SCENE ...] [--touching CYCLES] [--rate HZ] [--out FILE.md]

SCENE: names of shipped scenes; without any, all that have a trajectory in config/trajectories. Each runs in a node
of its own, of a master that the script starts. A row is sent when the node has reported the cycle of the row before,
so that no cycle is late, however long it takes; of several instruments one moves at a time. --touching ends each run
so many cycles after the first contact.

The table has the largest force of each instrument live and in `palpate replay` of the rows that the cycles used, the
root mean square of the difference, and whether each state is that of `palpate replay --live` to the bit. --out writes
it as Markdown.
"""
import argparse
import csv
import glob
import math
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import time
import xml.etree.ElementTree
import xmlrpc.client

import numpy as np
import roslib.packages
import rosbag
import rospy
import yaml
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "data"))
from make_demo_bag import numbers, pose, rotation  # noqa: E402
from palpate.msg import ContactModel, StepReport  # noqa: E402

CONFIG = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "config")
RESEND = 0.02  # [s] an input that is not renewed is stale


def trajectory_of(scene):
    """Its own or, where several scenes share one, that whose name begins like its; None if there is none.

    One that is shared has joints of the scene's instruments alone."""
    folder = os.path.join(CONFIG, "trajectories")
    own = os.path.join(folder, scene + ".csv")
    if os.path.exists(own):
        return own
    with open(os.path.join(CONFIG, "scenes", scene + ".yaml"), encoding="utf-8") as file:
        tools = {tool["name"] for tool in yaml.safe_load(file)["instruments"]}
    for path in sorted(glob.glob(os.path.join(folder, scene.split("_")[0] + "_*.csv"))):
        with open(path, encoding="utf-8") as file:
            columns = next(csv.reader(file))[1:]
        if {c.split("/")[0] for c in columns if "/" in c} <= tools and (len(tools) == 1 or all("/" in c for c in columns)):
            return path
    return None


def shipped_scenes():
    """Names of the scenes that have a trajectory."""
    names = sorted(os.path.splitext(os.path.basename(f))[0] for f in glob.glob(os.path.join(CONFIG, "scenes", "*.yaml")))
    return [name for name in names if trajectory_of(name)]


def program(name):
    return roslib.packages.find_node("palpate", name)[0]


class Robot:
    """Forward kinematics of a URDF: where its links are, for joints by name."""

    def __init__(self, path):
        robot = xml.etree.ElementTree.parse(path).getroot()
        self.links = [link.get("name") for link in robot.iter("link")]
        self.joints = {}
        for joint in robot.findall("joint"):
            origin, axis, mimic = joint.find("origin"), joint.find("axis"), joint.find("mimic")
            origin = {} if origin is None else origin.attrib
            axis = np.array(numbers(None if axis is None else axis.get("xyz"), "1 0 0"))
            name, factor, offset = joint.get("name"), 1.0, 0.0
            if mimic is not None:
                name = mimic.get("joint")
                factor, offset = float(mimic.get("multiplier", 1.0)), float(mimic.get("offset", 0.0))
            self.joints[joint.find("child").get("link")] = (
                joint.find("parent").get("link"), joint.get("type"), name, factor, offset,
                pose(numbers(origin.get("xyz"), "0 0 0"), numbers(origin.get("rpy"), "0 0 0")),
                axis / np.linalg.norm(axis))

    def place(self, link, q):
        """Of the link in the root."""
        if link not in self.joints:
            return np.eye(4)
        parent, kind, name, factor, offset, origin, axis = self.joints[link]
        motion = np.eye(4)
        if kind == "prismatic":
            motion[:3, 3] = (factor * q[name] + offset) * axis
        elif kind != "fixed":
            motion[:3, :3] = rotation(axis, factor * q[name] + offset)
        return self.place(parent, q) @ origin @ motion


def quaternion(r):
    """x, y, z, w of a rotation matrix [Shepperd 1978]."""
    diagonal = [r[0, 0], r[1, 1], r[2, 2], r[0, 0] + r[1, 1] + r[2, 2]]
    i = int(np.argmax(diagonal))
    q = np.zeros(4)
    if i == 3:
        q[:] = [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], 1.0 + diagonal[3]]
    else:
        j, k = (i + 1) % 3, (i + 2) % 3
        q[i] = 1.0 + r[i, i] - r[j, j] - r[k, k]
        q[j], q[k], q[3] = r[j, i] + r[i, j], r[k, i] + r[i, k], r[k, j] - r[j, k]
    return q / np.linalg.norm(q)


class Scene:
    """A shipped scene, and the motion of its instruments at the ends of cycles."""

    def __init__(self, name):
        self.name, self.file = name, os.path.join(CONFIG, "scenes", name + ".yaml")
        with open(self.file, encoding="utf-8") as file:
            self.keys = yaml.safe_load(file)
        self.step = float((self.keys.get("solver") or {}).get("step", 0.01))
        self.rate = float((self.keys.get("rates") or {}).get("simulation", 100.0))
        self.tools = self.keys["instruments"]
        self.trajectory = trajectory_of(name)
        with open(self.trajectory, encoding="utf-8") as file:
            rows = list(csv.reader(file))
        self.columns = rows[0][1:]
        table = np.array([[float(x) for x in row] for row in rows[1:]])
        times, values = table[:, 0] - table[0, 0], table[:, 1:]
        count = int(math.floor(times[-1] / self.step + 1e-6)) + 1
        self.times = np.arange(count) * self.step
        if len(times) == count and np.allclose(times, self.times, atol=1e-6 * self.step):
            self.rows = values  # the file's own bits
        else:
            self.rows = np.stack([np.interp(self.times, times, column) for column in values.T], axis=1)

    def joints(self, tool):
        """Names of the tool's joints, and their columns."""
        prefix = tool["name"] + "/"
        own = [(c[len(prefix):], k) for k, c in enumerate(self.columns) if c.startswith(prefix)]
        if own or len(self.tools) > 1:
            return [n for n, _ in own], [k for _, k in own]
        return list(self.columns), list(range(len(self.columns)))

    def base(self, tool):
        place = tool.get("base") or {}
        return pose(place.get("position", (0, 0, 0)), place.get("roll_pitch_yaw", (0, 0, 0)))

    def joint_topic(self, tool):
        return tool.get("joint_topic") or tool["name"] + "/measured_js"


class JointHand:
    """Publishes the joints of one tool. A message that is sent again is the same."""

    renewed = False

    def __init__(self, scene, tool, namespace):
        self.names, self.columns = scene.joints(tool)
        topic = scene.joint_topic(tool)
        self.topic = topic if topic.startswith("/") else namespace + "/" + topic
        self.publisher = rospy.Publisher(self.topic, JointState, queue_size=1, tcp_nodelay=True)

    def message(self, row, stamp):
        m = JointState()
        m.header.stamp, m.name, m.position = stamp, self.names, [float(row[k]) for k in self.columns]
        return m


class TfHand:
    """Publishes the frames of one tool's links. Their stamps are new each time, or nobody takes them for news."""

    renewed = True

    def __init__(self, scene, tool, _):
        self.names, self.columns = scene.joints(tool)
        self.robot = Robot(os.path.join(os.path.dirname(scene.file), tool["urdf"]))
        self.base, self.prefix, self.topic = scene.base(tool), tool.get("tf_prefix", ""), "/tf"
        self.publisher = rospy.Publisher(self.topic, TFMessage, queue_size=1, tcp_nodelay=True)

    def message(self, row, stamp):
        q = {name: row[k] for name, k in zip(self.names, self.columns)}
        m = TFMessage()
        for link in self.robot.links:
            if self.prefix + link == "world":
                continue
            t = TransformStamped()
            t.header.stamp, t.header.frame_id, t.child_frame_id = stamp, "world", self.prefix + link
            place = self.base @ self.robot.place(link, q)
            x = t.transform
            x.translation.x, x.translation.y, x.translation.z = place[:3, 3]
            x.rotation.x, x.rotation.y, x.rotation.z, x.rotation.w = quaternion(place[:3, :3])
            m.transforms.append(t)
        return m


class Lost(Exception):
    """A report was not heard: the machine stood still."""


class Cycle:
    """What a cycle used, a row of positions, and its report; None of the first ones, before anybody listened."""

    def __init__(self, row, report):
        self.row, self.report = row, report
        self.stamp = report.header.stamp.to_nsec() if report else 0


class LiveNode:
    """A node with one scene, which a hand drives a row a cycle."""

    def __init__(self, scene, rate=None, log=None, parameters=()):
        self.scene, self.namespace = scene, "/live_" + scene.name
        command = [program("palpate_node"), "__ns:=" + self.namespace, "_scene:=" + scene.file, "_save_state_at_end:=false",
                   "_rates/catch_up:=1"]
        command += ["_rates/simulation:=%r" % rate] if rate else []
        self.node = subprocess.Popen(command + list(parameters), stdout=log, stderr=subprocess.STDOUT)
        self.heard, self.models = queue.Queue(), {}
        topics = self.namespace + "/%s"
        self.ears = [rospy.Subscriber(topics % "step_report", StepReport, self.heard.put, queue_size=1000, tcp_nodelay=True)]
        self.hands = [(TfHand if tool.get("input") == "tf" else JointHand)(scene, tool, self.namespace) for tool in scene.tools]
        for i, tool in enumerate(scene.tools):
            self.models[i] = {}
            self.ears.append(rospy.Subscriber(topics % (tool["name"] + "/contact_model"), ContactModel, self.hear, i, queue_size=1000,
                                              tcp_nodelay=True))
        self.reset = rospy.ServiceProxy(topics % "palpate/reset", Trigger)
        self.lock, self.messages, self.rows, self.last = threading.Lock(), [None] * len(self.hands), {}, 0
        self.sending = threading.Thread(target=self.resend, daemon=True)
        self.ended = False

    def hear(self, model, i):
        f = model.wrench.force
        self.models[i][model.header.stamp.to_nsec()] = (f.x, f.y, f.z)

    def begin(self, patience=600.0):
        """Until it has loaded, and all tools are there."""
        end = time.monotonic() + patience
        while True:
            try:
                rospy.wait_for_service(self.reset.resolved_name, 0.5)
                break
            except rospy.ROSException:
                if self.node.poll() is not None or time.monotonic() > end:
                    raise RuntimeError("%s: the node did not load" % self.scene.name)
        self.sending.start()

    def end(self):
        self.ended = True
        if self.sending.is_alive():
            self.sending.join()
        self.node.send_signal(signal.SIGINT)
        try:
            self.node.wait(20)
        except subprocess.TimeoutExpired:
            self.node.kill()
        for ear in self.ears:
            ear.unregister()
        for hand in self.hands:
            hand.publisher.unregister()
        return self.node.returncode

    def stamp(self):
        """Of now, and later than all before."""
        self.last = max(self.last + 1, time.time_ns())
        return rospy.Time(self.last // 10**9, self.last % 10**9)

    def hold(self, row, which=None):
        """Sends the positions of all tools, or of those in `which`; returns the stamp that says so."""
        with self.lock:
            stamp = self.stamp()
            for i in range(len(self.hands)) if which is None else which:
                self.messages[i] = (row, stamp)
            self.rows[stamp.to_nsec()] = row
            self.send(range(len(self.hands)) if which is None else which)
        return stamp.to_nsec()

    def send(self, which):
        for i in which:
            row, stamp = self.messages[i]
            self.hands[i].publisher.publish(self.hands[i].message(row, stamp))

    def resend(self):
        while not self.ended:
            time.sleep(RESEND)
            with self.lock:
                for i, hand in enumerate(self.hands):
                    if hand.renewed and self.messages[i]:
                        row = self.messages[i][0]
                        stamp = self.stamp()
                        self.messages[i] = (row, stamp)
                        self.rows[stamp.to_nsec()] = row
                if all(self.messages):
                    self.send(range(len(self.hands)))

    def next(self, patience=60.0):
        """The next report."""
        end = time.monotonic() + patience
        while time.monotonic() < end and self.node.poll() is None:
            try:
                return self.heard.get(timeout=0.5)
            except queue.Empty:
                pass
        raise Lost("%s: no report any more" % self.scene.name)

    def drive(self, touching=None, alone=False, until=None):
        """From rest through all rows, or until so many cycles after the first contact; returns the cycles.

        `alone`: one tool is moved at a time, so that what a cycle used is known whenever it began. Otherwise tools
        move together, at once after a report. `until`: so many seconds of touching are enough."""
        self.hold(self.scene.rows[0])
        while self.next().state != "RUNNING":
            pass
        time.sleep(0.2)  # the others are heard, too
        if not self.reset().success:
            raise Lost("no reset")
        time.sleep(0.1)  # what was said before is heard
        while not self.heard.empty():
            self.heard.get()
        m = self.next()
        cycles = [Cycle(self.scene.rows[0], None) for _ in range(round(m.time / self.scene.step))]
        moves = self.moves(alone)
        wanted, touched, since = next(moves), 0, None
        while wanted is not None:
            m = self.next()
            number = round(m.time / self.scene.step)
            if number == len(cycles):
                continue  # what the state is, without a cycle
            if number != len(cycles) + 1:
                raise Lost("%s: cycle %d came after %d" % (self.scene.name, number, len(cycles)))
            cycles.append(Cycle(self.rows[m.header.stamp.to_nsec()], m))
            touched += m.contacts > 0 or touched > 0
            since = since or (time.monotonic() if touched else None)
            long_enough = until and since and touched >= (touching or 0) // 4 and time.monotonic() > since + until
            if touching and (touched >= touching or long_enough):
                break
            if cycles[-1].stamp >= wanted:
                wanted = next(moves, None)
        return cycles

    def moves(self, alone):
        """Makes one after the other; the stamps that say that they were seen."""
        before = self.scene.rows[0]
        for row in self.scene.rows[1:]:
            for i, hand in enumerate(self.hands) if alone else [(None, None)]:
                if i is not None:
                    now = np.array(before)
                    now[hand.columns] = row[hand.columns]
                    if i < len(self.hands) - 1 and (now == before).all():
                        continue
                    before = now
                yield self.hold(before if alone else row, None if i is None else [i])

    def settled_forces(self, cycles):
        """Of each tool in each cycle that it moved in [N], n x 3; what no model was heard of is zero."""
        time.sleep(0.2)
        return [np.array([self.models[i].get(c.stamp, (0.0, 0.0, 0.0)) for c in cycles])
                for i in range(len(self.hands))]


def write_rows(path, columns, step, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t"] + list(columns))
        for k, row in enumerate(rows):
            writer.writerow([repr(k * step)] + [repr(float(x)) for x in row])


def replay(scene, trajectory, out, *options):
    done = subprocess.run([program("palpate"), "replay", scene.file, "--trajectory", trajectory, "--out", out] + list(options),
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    if done.returncode not in (0, 1):  # 1: some cycles did not converge
        raise RuntimeError(done.stdout)
    with open(out, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def replay_cycles(scene, cycles, folder):
    """A replay of the rows that the cycles used, as the live node makes cycles."""
    out = os.path.join(folder, "live.csv")
    if all(tool.get("input") != "tf" for tool in scene.tools):
        rows = os.path.join(folder, "rows.csv")
        write_rows(rows, scene.columns, scene.step, [c.row for c in cycles])
        return replay(scene, rows, out, "--live")
    bag = os.path.join(folder, "rows.bag")
    hands = [(TfHand if tool.get("input") == "tf" else JointHand)(scene, tool, "") for tool in scene.tools]
    with rosbag.Bag(bag, "w") as file:
        for k, cycle in enumerate(cycles):
            ns = 10**12 + k * round(scene.step * 1e9)
            stamp = rospy.Time(ns // 10**9, ns % 10**9)
            for hand in hands:
                file.write("/" + hand.topic.lstrip("/"), hand.message(cycle.row, stamp), stamp)
    for hand in hands:
        hand.publisher.unregister()
    subprocess.run([program("palpate_replay_bag"), bag, "--scene", scene.file, "--out", os.path.join(folder, "out.bag"), "--csv", out,
                    "--live"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(out, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def forces_of(scene, rows):
    """Of each tool in each row of a replay [N], n x 3."""
    prefixes = [tool["name"] + "/" if len(scene.tools) > 1 else "" for tool in scene.tools]
    return [np.array([[float(row[prefix + a]) for a in ("fx", "fy", "fz")] for row in rows]) for prefix in prefixes]


def run(scene, folder, rate=None, touching=None, alone=False, until=None, tries=4):
    """(cycles, forces of each tool as heard, replay of the same rows). Where reports are lost, again at half the rate."""
    for k in range(tries):
        with open(os.path.join(folder, "node.log"), "w", encoding="utf-8") as log:
            node = LiveNode(scene, (rate or scene.rate) / 2**k, log)
            try:
                node.begin()
                cycles = node.drive(touching, alone, until)
                forces = node.settled_forces(cycles)
                break
            except Lost:
                if k == tries - 1:
                    raise
            finally:
                node.end()
    return cycles, forces, replay_cycles(scene, cycles, folder)


def first_apart(cycles, rows):
    """The number of the first cycle whose state is not that of the replay; None if there is none."""
    if len(cycles) != len(rows):
        return min(len(cycles), len(rows))
    return next((k for k, (c, row) in enumerate(zip(cycles, rows)) if c.report and c.report.state_hash != int(row["state_hash"], 16)),
                None)


def compared(scene, folder, rate, touching):
    """A row of the table, by its heads."""
    cycles, live, live_rows = run(scene, folder, rate, touching, alone=True)
    apart = first_apart(cycles, live_rows)
    if len(scene.tools) > 1 and apart is None:
        live = forces_of(scene, live_rows)  # which the hash is of, too; a tool that rests says its force under an old stamp
    path = os.path.join(folder, "rows.csv")
    write_rows(path, scene.columns, scene.step, [c.row for c in cycles])
    replayed = forces_of(scene, replay(scene, path, os.path.join(folder, "replay.csv")))
    peaks, peaks_replay = [[np.linalg.norm(f, axis=1).max() for f in forces] for forces in (live, replayed)]
    rms = [math.sqrt(np.mean(np.sum((a - b) ** 2, axis=1))) for a, b in zip(live, replayed)]
    speed = scene.step * scene.rate
    told = [c for c in cycles if c.report]

    def figures(values):
        return ", ".join("%.3g" % v for v in values)

    return {"scene": "`%s`" % scene.name, "instruments": ", ".join(tool["name"] for tool in scene.tools),
            "cycles": str(len(cycles)), "most contacts": str(max(c.report.contacts for c in told)),
            "peak live [N]": figures(peaks), "peak in replay [N]": figures(peaks_replay),
            "RMS of the difference [N]": figures(rms), "same bits": "yes" if apart is None else "no, from cycle %d on" % apart,
            "longest step [ms]": "%.3g" % max(c.report.cycle_ms for c in told),
            "step x rate": "real time" if abs(speed - 1.0) < 0.01 else "%.3g of real time" % speed}


def start_master(uri, folder):
    with open(os.path.join(folder, "master.log"), "w", encoding="utf-8") as log:
        master = subprocess.Popen(["roscore", "-p", uri.rstrip("/").split(":")[-1]], stdout=log, stderr=subprocess.STDOUT)
    proxy = xmlrpc.client.ServerProxy(uri)
    for _ in range(300):
        try:
            if proxy.getPid("/compare_live")[0] == 1:
                return master
        except OSError:
            pass
        time.sleep(0.1)
    sys.exit("compare_live.py: no master at " + uri)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--touching", type=int, metavar="CYCLES", help="end so many cycles after the first contact")
    parser.add_argument("--rate", type=float, default=20.0, help="of the cycles, at most [Hz] (20)")
    parser.add_argument("--out", help="Markdown file for the table")
    options = parser.parse_args()
    known = shipped_scenes()
    for name in options.scenes:
        if name not in known:
            parser.error("%s is no shipped scene with a trajectory; there are: %s" % (name, ", ".join(known)))

    rows = []
    with tempfile.TemporaryDirectory(prefix="compare_live_") as folder:
        master = start_master(os.environ.get("ROS_MASTER_URI", ""), folder)
        try:
            rospy.init_node("compare_live", disable_signals=True, log_level=rospy.WARN)
            for name in options.scenes or known:
                try:
                    rows.append(compared(Scene(name), folder, options.rate, options.touching))
                except (Lost, RuntimeError, subprocess.CalledProcessError) as error:
                    rows.append({"scene": "`%s`" % name, "same bits": "failed: " + str(error).strip().replace("\n", " ")[-200:]})
                print(", ".join("%s: %s" % item for item in rows[-1].items()), flush=True)
        finally:
            master.send_signal(signal.SIGINT)
            master.wait(20)
    heads = max(rows, key=len).keys()
    table = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    table += ["| " + " | ".join(row.get(head, "") for head in heads) + " |" for row in rows]
    if options.out:
        with open(options.out, "w", encoding="utf-8") as file:
            file.write("\n".join(table) + "\n")
    sys.exit(0 if all(row["same bits"] == "yes" for row in rows) else 1)


if __name__ == "__main__":
    main()
