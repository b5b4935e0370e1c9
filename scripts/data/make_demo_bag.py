#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the shipped master-arm motion: a probe that palpates the liver.

    scripts/data/make_demo_bag.py [--scene FILE] [--out STEM] [--tremor METRES]

Writes STEM.bag (sensor_msgs/JointState on /<instrument>/measured_js) and STEM.csv (t and one column a
joint, for `palpate replay`) with the same numbers: the same scene and surface give the same bytes.

The motion is the table WAYPOINTS. Between two rows everything moves on a minimum-jerk profile
[Flash and Hogan 1985], which is how hands move: 10 s^3 - 15 s^4 + 6 s^5. Depths count from where the
ball first touches the organ at rest, straight below; that height comes from the organ's surface.
"""
import argparse
import csv
import math
import os
import sys
import xml.etree.ElementTree

import numpy as np
import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
RATE = 100  # [Hz]
START = 1000  # Stamp of the first message [s]; a bag must not start at zero, which means "no time".

# t [s], x, y [mm] in the organ's frame, depth [mm] (negative: clearance), tilt about x and y [deg].
WAYPOINTS = [
    (0.00, -35, 0, -40, 0, 0),
    (0.30, -35, 0, -40, 0, 0),
    (1.30, -60, 10, -6, -8, -12),  # approach
    (1.80, -60, 10, 5, -8, -12),  # first palpation: 5 mm, right lobe
    (2.20, -60, 10, 5, -8, -12),
    (2.70, -60, 10, -6, -8, -12),
    (3.30, 5, 18, -6, -12, 6),  # over to the middle
    (3.90, 5, 18, 10, -12, 6),  # second: 10 mm
    (4.40, 5, 18, 10, -12, 6),
    (5.00, 5, 18, -6, -12, 6),
    (5.60, -40, -25, -6, 14, -8),  # and back, to the front
    (6.30, -40, -25, 15, 14, -8),  # third: 15 mm
    (7.10, -40, -25, 15, 14, -8),
    (7.80, -40, -25, -6, 14, -8),
    (8.30, -55, 12, -6, -8, -10),
    (8.80, -55, 12, 8, -8, -10),  # press, then drag 65 mm along the dome
    (10.40, 10, 5, 8, -8, 8),
    (10.90, 10, 5, -6, -8, 8),
    (11.70, -35, 0, -40, 0, 0),  # retreat
    (12.00, -35, 0, -40, 0, 0),
]


def minimum_jerk(waypoints, t):
    """Rows of `waypoints` without their time, at the times t."""
    table = np.array(waypoints, dtype=float)
    i = np.clip(np.searchsorted(table[:, 0], t, side="right") - 1, 0, len(table) - 2)
    s = ((t - table[i, 0]) / (table[i + 1, 0] - table[i, 0])).clip(0.0, 1.0)
    s = (s**3 * (10.0 - 15.0 * s + 6.0 * s**2))[:, None]
    return (1.0 - s) * table[i, 1:] + s * table[i + 1, 1:]


def read_obj(path):
    """Points (n, 3) and triangles (m, 3) of a triangulated OBJ."""
    points, triangles = [], []
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                points.append([float(w) for w in words[1:4]])
            elif words[:1] == ["f"]:
                triangles.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    if not triangles:
        sys.exit("%s: no triangles" % path)
    return np.array(points), np.array(triangles)


def heights(corners, xy):
    """Where a ray from above first meets the surface: z at each of xy (n, 2), -inf if it does not.

    corners: (m, 3, 3). A ray along z is inside a triangle where its barycentric coordinates in the
    x-y plane are all positive.
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac = (b - a)[:, :2], (c - a)[:, :2]
    area = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    seen = np.abs(area) > 1e-14
    a, b, c, ab, ac, area = a[seen], b[seen], c[seen], ab[seen], ac[seen], area[seen]
    top = np.full(len(xy), -np.inf)
    for i, p in enumerate(xy):
        d = p - a[:, :2]
        v = (d[:, 0] * ac[:, 1] - d[:, 1] * ac[:, 0]) / area
        w = (ab[:, 0] * d[:, 1] - ab[:, 1] * d[:, 0]) / area
        hit = (v >= -1e-12) & (w >= -1e-12) & (v + w <= 1.0 + 1e-12)
        if hit.any():
            top[i] = np.max((a[:, 2] + v * (b - a)[:, 2] + w * (c - a)[:, 2])[hit])
    return top


def touch_heights(corners, xy, radius):
    """Height of a ball's centre that touches from above, at each of xy: rays within its shadow."""
    offsets = [(0.0, 0.0)]
    for ring in range(1, 5):
        for k in range(6 * ring):
            angle = 2.0 * math.pi * k / (6 * ring)
            offsets.append((0.24 * ring * radius * math.cos(angle), 0.24 * ring * radius * math.sin(angle)))
    best = np.full(len(xy), -np.inf)
    for dx, dy in offsets:
        lift = math.sqrt(radius**2 - dx**2 - dy**2)
        best = np.maximum(best, heights(corners, xy + [dx, dy]) + lift)
    return best


def rotation(axis, angle):
    """Rodrigues' formula."""
    x, y, z = axis
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + math.sin(angle) * k + (1.0 - math.cos(angle)) * (k @ k)


def pose(xyz, rpy):
    x = np.eye(4)
    x[:3, :3] = rotation((0, 0, 1), rpy[2]) @ rotation((0, 1, 0), rpy[1]) @ rotation((1, 0, 0), rpy[0])
    x[:3, 3] = xyz
    return x


def numbers(text, default):
    return [float(w) for w in (text or default).split()]


class Chain:
    """The joints of a URDF from its root to one link."""

    def __init__(self, path, link):
        robot = xml.etree.ElementTree.parse(path).getroot()
        parents = {j.find("child").get("link"): j for j in robot.iter("joint") if j.find("child") is not None}
        self.joints = []  # (name or None, prismatic, origin, axis), from the root on
        self.radius = self.ball(robot, link)
        while link in parents:
            joint = parents[link]
            origin, axis = joint.find("origin"), joint.find("axis")
            origin = {} if origin is None else origin.attrib
            x = pose(numbers(origin.get("xyz"), "0 0 0"), numbers(origin.get("rpy"), "0 0 0"))
            axis = np.array(numbers(None if axis is None else axis.get("xyz"), "1 0 0"))
            fixed = joint.get("type") == "fixed"
            name = None if fixed else joint.get("name")
            self.joints.insert(0, (name, joint.get("type") == "prismatic", x, axis / np.linalg.norm(axis)))
            link = joint.find("parent").get("link")
        self.names = [name for name, _, _, _ in self.joints if name]

    @staticmethod
    def ball(robot, name):
        for link in robot.iter("link"):
            sphere = link.find("collision/geometry/sphere")
            if link.get("name") == name and sphere is not None:
                return float(sphere.get("radius"))
        sys.exit("link '%s' has no collision sphere" % name)

    def tip(self, q):
        """Position of the link in the root, for q by joint name."""
        x = np.eye(4)
        for name, prismatic, origin, axis in self.joints:
            x = x @ origin
            if name:
                motion = np.eye(4)
                if prismatic:
                    motion[:3, 3] = q[name] * axis
                else:
                    motion[:3, :3] = rotation(axis, q[name])
                x = x @ motion
        return x[:3, 3]


def joint_positions(chain, base, tips, tilts):
    """Joint values (n, joints): the three prismatic ones carry the tip, the other ones tilt it."""
    slides = [name for name, prismatic, _, _ in chain.joints if name and prismatic]
    turns = [name for name, prismatic, _, _ in chain.joints if name and not prismatic]
    if len(slides) != 3 or len(turns) < 2:
        sys.exit("the demo needs an instrument with three prismatic and two revolute joints or more")
    rows = []
    inverse = np.linalg.inv(base)
    for p_W, tilt in zip(tips, tilts):
        q = dict.fromkeys(chain.names, 0.0)
        q[turns[0]], q[turns[1]] = tilt
        p_B = inverse[:3, :3] @ p_W + inverse[:3, 3]
        # The slides come first and do not turn, so the tip is linear in them.
        rest = chain.tip(q)
        columns = []
        for name in slides:
            q[name] = 1.0
            columns.append(chain.tip(q) - rest)
            q[name] = 0.0
        for name, value in zip(slides, np.linalg.solve(np.array(columns).T, p_B - rest)):
            q[name] = value
        assert np.linalg.norm(chain.tip(q) - p_B) < 1e-9
        # Nanometres, so that the decimals of the CSV are the bag's numbers exactly.
        rows.append([round(q[name], 9) + 0.0 for name in chain.names])
    return rows


def smooth(values, width):
    """Mean over 2 width + 1 samples, twice: the facets of the surface must not be felt."""
    kernel = np.ones(2 * width + 1) / (2 * width + 1)
    for _ in range(2):
        values = np.convolve(np.pad(values, width, mode="edge"), kernel, mode="valid")
    return values


def write_csv(path, names, times, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t"] + names)
        for t, row in zip(times, rows):
            writer.writerow(["%.2f" % t] + ["%.9f" % value for value in row])


def write_bag(path, topic, names, rows):
    import genpy
    import rosbag
    from sensor_msgs.msg import JointState

    with rosbag.Bag(path, "w", compression="bz2") as bag:
        for i, row in enumerate(rows):
            message = JointState()
            nanoseconds = i * (10**9 // RATE)
            message.header.seq = i
            message.header.stamp = genpy.Time(START + nanoseconds // 10**9, nanoseconds % 10**9)
            message.name = names
            message.position = row
            bag.write(topic, message, message.header.stamp)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scene", default=os.path.join(ROOT, "config/scenes/liver_palpation.yaml"))
    parser.add_argument("--out", default=os.path.join(ROOT, "config/trajectories/liver_palpation"))
    parser.add_argument("--tremor", type=float, default=0.0, help="sideways, 3.5 Hz [m]")
    arguments = parser.parse_args()

    with open(arguments.scene, encoding="utf-8") as file:
        scene = yaml.safe_load(file)
    folder = os.path.dirname(arguments.scene)
    organ, instrument = scene["organs"][0], scene["instruments"][0]
    chain = Chain(os.path.join(folder, instrument["urdf"]), instrument["control_frame"])

    def placed(key, of):
        place = of.get(key) or {}
        return pose(place.get("position", (0, 0, 0)), place.get("roll_pitch_yaw", (0, 0, 0)))

    x_wo = placed("pose", organ)
    points, triangles = read_obj(os.path.join(folder, organ["surface"]))
    points = points * float(organ.get("scale", 1.0)) @ x_wo[:3, :3].T + x_wo[:3, 3]

    count = int(round(WAYPOINTS[-1][0] * RATE)) + 1
    times = np.arange(count) / RATE
    motion = minimum_jerk(WAYPOINTS, times)
    xy = motion[:, :2] * 1e-3 + x_wo[:2, 3]
    touch = touch_heights(points[triangles], xy, chain.radius)
    if not np.isfinite(touch).all():
        bad = times[~np.isfinite(touch)]
        sys.exit("the probe leaves the organ at t = %.2f s: change WAYPOINTS" % bad[0])
    xy[:, 0] += arguments.tremor * np.sin(2.0 * math.pi * 3.5 * times)
    xy[:, 1] += arguments.tremor * np.sin(2.0 * math.pi * 3.1 * times + 1.0)
    tips = np.column_stack([xy, smooth(touch, 8) - motion[:, 2] * 1e-3])
    rows = joint_positions(chain, placed("base", instrument), tips, np.radians(motion[:, 3:5]))

    os.makedirs(os.path.dirname(os.path.abspath(arguments.out)), exist_ok=True)
    topic = "/" + (instrument.get("joint_topic") or instrument["name"] + "/measured_js").lstrip("/")
    write_csv(arguments.out + ".csv", chain.names, times, rows)
    write_bag(arguments.out + ".bag", topic, chain.names, rows)
    speed = np.linalg.norm(np.diff(tips, axis=0), axis=1).max() * RATE
    print("%s.bag, .csv: %d messages on %s, %.1f s, ball of %.1f mm, fastest %.2f m/s" %
          (arguments.out, count, topic, times[-1], 1e3 * chain.radius, speed))


if __name__ == "__main__":
    main()
