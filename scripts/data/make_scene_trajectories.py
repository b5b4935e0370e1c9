#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the shipped motions, config/trajectories/*.csv, for `palpate replay`.

    scripts/data/make_scene_trajectories.py [--out FOLDER]

The motions are tables of waypoints; between two rows everything moves on a minimum-jerk profile, as
in scripts/data/make_demo_bag.py. The same scenes give the same bytes.
"""
import argparse
import csv
import math
import os

import numpy as np
import yaml

from make_demo_bag import minimum_jerk, pose

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# t [s], way of the tips along the lift [mm], opening of each jaw [rad].
LIFT = [
    (0.00, 40, 0.65),
    (0.20, 40, 0.65),
    (1.40, 0, 0.65),  # down over the gallbladder
    (1.60, 0, 0.65),
    (2.40, 0, 0.26),  # close
    (2.70, 0, 0.26),
    (3.90, 12, 0.26),  # lift
    (4.90, 12, 0.26),  # hold
    (5.90, 0, 0.26),  # lower
    (6.10, 0, 0.26),
    (6.80, 0, 0.65),  # open
    (7.00, 0, 0.65),
    (8.00, 40, 0.65),  # retreat
    (8.40, 40, 0.65),
]
# Where the tips go, in the gallbladder's frame after scaling [mm].
GRIPS = {"left": (-24.0, 0.0, 6.0), "right": (13.0, 0.5, 6.5)}

# t [s], the fan's middle from where its base is: x, z [mm], pitch [deg], opening [rad].
RETRACT = [
    (0.00, 90, -8, -12, 0.0),
    (0.20, 90, -8, -12, 0.0),
    (1.20, 6, -8, -12, 0.0),  # in below the lobe
    (1.60, 6, -8, -12, 0.35),  # open the fan
    (3.40, 6, 40, -12, 0.35),  # lift
    (9.20, 6, 40, -12, 0.35),  # hold
    (10.60, 6, -8, -12, 0.35),  # lower
    (11.00, 6, -8, -12, 0.0),
    (12.00, 90, -8, -12, 0.0),
    (12.40, 90, -8, -12, 0.0),
]
# t [s], the ball's centre before the surface along the way in (negative: pressed) [mm].
PALPATE = [
    (0.00, 60),
    (3.20, 60),
    (4.40, 5),
    (5.00, -4),  # first
    (5.40, -4),
    (5.90, 4),
    (6.60, -7),  # second
    (7.20, -7),
    (8.00, 5),
    (9.20, 60),
    (12.40, 60),
]
# Where the ball's centre touches the lifted liver, and the way in.
TOUCH = np.array([0.0202, -0.0181, 0.0539])  # [m]
WAY_IN = np.array([0.0, math.sin(0.45), math.cos(0.45)])

BALL = 0.005  # radius of the probe's ball [m]
TOP = 0.03  # of slab.obj [m]
# t [s], the ball's centre along x and above where it would touch the block, negative: pressed [mm].
PRICK = [  # of the blunt needle's ball on the block of skin
    (0.00, 0, 1.0),
    (0.20, 0, 1.0),
    (0.80, 0, -0.9),  # the shallower profile's depth
    (1.20, 0, -0.9),
    (1.60, 0, -1.8),  # the deeper one's
    (2.00, 0, -1.8),
    (3.00, 0, 2.0),
    (3.20, 0, 2.0),
]
PRESS = [
    (0.00, 0, 5),
    (0.20, 0, 5),
    (0.60, 0, -3),  # press
    (1.40, 0, -3),  # hold
    (2.20, 20, -3),  # slide
    (2.60, 20, -3),
    (3.00, 20, 10),  # lift
    (3.40, 20, 10),
]
DRAG = [
    (0.00, -15, 10),
    (0.40, -15, 10),
    (1.20, -15, 0),
    (1.80, -15, -5),  # push
    (2.20, -15, -5),
    (3.40, 0, -5),  # drag
    (3.80, 0, -5),
    (4.60, 0, 0),
    (5.20, 0, 10),
    (6.00, 0, 10),
]

# t [s], the stylus's tip in the liver's frame [mm].
STAB = [
    (0.00, -35, 0, 115),
    (0.20, -35, 0, 115),
    (1.00, -35, 0, 90),  # press
    (1.50, -35, 0, 90),
    (2.50, -15, 10, 90),  # go about
    (2.80, -15, 10, 90),
    (3.40, -15, 10, 115),  # leave
    (3.60, -15, 10, 115),
]

# t [s], the tips above the kidney's top [mm], opening of each jaw [rad].
GRASP = [
    (0.00, 3, 0.35),
    (0.20, 3, 0.35),
    (1.20, -7, 0.35),  # 10 mm down in a second
    (1.40, -7, 0.35),
    (2.20, -7, 0.05),  # close
    (2.50, -7, 0.05),
    (3.50, 10, 0.05),  # lift
    (3.80, 10, 0.05),
    (4.40, 10, 0.35),
    (5.00, 3, 0.35),
    (5.20, 3, 0.35),
]
KIDNEY = np.array([0.0, 0.0, 0.045])  # its top [m]

# t [s], the needle's tip above the block [mm].
INSERT = [
    (0.00, 5),
    (0.20, 5),
    (2.20, -20),  # in
    (2.70, -20),
    (3.90, 5),  # out
    (4.20, 5),
]

# t [s], the centre of the tracked probe's ball in the world: x, z [mm].
TRACK = [
    (0.00, -15, 65),
    (0.20, -15, 65),
    (0.90, -15, 39),  # at the fundus
    (1.50, -15, 31),  # press
    (2.00, -15, 31),
    (3.00, 0, 30),  # slide
    (3.30, 0, 30),
    (4.30, 0, 65),
    (4.60, 0, 65),
]
# The same over the gallbladder that breathes.
SQUEEZE = [
    (0.00, -15, 65),
    (0.20, -15, 65),
    (0.80, -15, 39),
    (1.40, -15, 34),  # press
    (4.40, -15, 34),  # while it goes to and fro
    (5.20, -15, 65),
    (5.40, -15, 65),
]


def placed(of, key):
    place = of.get(key) or {}
    return pose(place.get("position", (0, 0, 0)), place.get("roll_pitch_yaw", (0, 0, 0)))


def times(waypoints, rate):
    return np.arange(int(round(waypoints[-1][0] * rate)) + 1) / rate


def grasper_joints(base, tips, jaw):
    """Joints of grasper.urdf, by name, that bring its tip to `tips` (n, 3), the wrist straight."""
    way = (tips - base[:3, 3]) @ base[:3, :3]
    length = np.linalg.norm(way, axis=1)
    zero = np.zeros(len(tips))
    return {
        "yaw": np.arctan2(-way[:, 0], -way[:, 2]),
        "pitch": np.arcsin(way[:, 1] / length),
        "insertion": length,
        "roll": zero,
        "wrist_pitch": zero,
        "wrist_yaw": zero,
        "jaw_left": jaw,
    }


def bimanual(scene):
    t = times(LIFT, 40)
    motion = minimum_jerk(LIFT, t)
    organ = next(o for o in scene["organs"] if o["name"] == "gallbladder")
    x_wo = placed(organ, "pose")
    up = np.array([0.0, 0.0, 1.0])
    columns = {}
    for instrument in scene["instruments"]:
        grip = x_wo[:3, :3] @ (np.array(GRIPS[instrument["name"]]) * 1e-3) + x_wo[:3, 3]
        tips = grip + 1e-3 * motion[:, :1] * up
        joints = grasper_joints(placed(instrument, "base"), tips, motion[:, 1])
        columns.update({instrument["name"] + "/" + name: q for name, q in joints.items()})
    return t, columns


def retraction(scene):
    t = times(RETRACT, 50)
    fan = minimum_jerk(RETRACT, t)
    ball = minimum_jerk(PALPATE, t)
    probe = next(i for i in scene["instruments"] if i["name"] == "probe")
    base = placed(probe, "base")
    slides = (TOUCH - 1e-3 * ball * WAY_IN - base[:3, 3]) @ base[:3, :3]
    zero = np.zeros(len(fan))
    tilt = zero + math.atan2(WAY_IN[2], WAY_IN[1])
    return t, {
        "retractor/x": 1e-3 * fan[:, 0],
        "retractor/y": zero,
        "retractor/z": 1e-3 * fan[:, 1],
        "retractor/roll": zero,
        "retractor/pitch": np.radians(fan[:, 2]),
        "retractor/yaw": zero,
        "retractor/finger_left": fan[:, 3],
        "probe/x": slides[:, 0],
        "probe/y": slides[:, 1],
        "probe/z": slides[:, 2],
        "probe/roll": tilt,
        "probe/pitch": zero,
        "probe/yaw": zero,
    }


def on_slab(waypoints, top=TOP, radius=BALL):
    def motion(scene):
        t = times(waypoints, 100)
        ball = 1e-3 * minimum_jerk(waypoints, t)
        zero = np.zeros(len(t))
        z = top + radius + ball[:, 1] - placed(scene["instruments"][0], "base")[2, 3]
        return t, {"x": ball[:, 0], "y": zero, "z": z, "roll": zero, "pitch": zero, "yaw": zero}

    return motion


def stylus(scene):
    t = times(STAB, 100)
    tip = 1e-3 * minimum_jerk(STAB, t) - placed(scene["instruments"][0], "base")[:3, 3]
    zero = np.zeros(len(t))
    return t, {"x": tip[:, 0], "y": tip[:, 1], "z": tip[:, 2], "roll": zero, "pitch": zero, "yaw": zero}


def grasp(scene):
    t = times(GRASP, 100)
    motion = minimum_jerk(GRASP, t)
    tips = KIDNEY + 1e-3 * motion[:, :1] * np.array([0.0, 0.0, 1.0])
    return t, grasper_joints(placed(scene["instruments"][0], "base"), tips, motion[:, 1])


def insertion(scene):
    t = times(INSERT, 100)
    zero = np.zeros(len(t))
    z = TOP + 1e-3 * minimum_jerk(INSERT, t)[:, 0] - placed(scene["instruments"][0], "base")[2, 3]
    return t, {"x": zero, "y": zero, "z": z, "roll": zero, "pitch": zero}


def above(waypoints):
    def motion(scene):
        t = times(waypoints, 100)
        ball = 1e-3 * minimum_jerk(waypoints, t)
        zero = np.zeros(len(t))
        base = placed(scene["instruments"][0], "base")[:3, 3]  # of a tracked probe: the world
        x, z = ball[:, 0] - base[0], ball[:, 1] - base[2]
        return t, {"x": x, "y": zero, "z": z, "roll": zero, "pitch": zero, "yaw": zero}

    return motion


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--out", default=os.path.join(ROOT, "config/trajectories"))
    folder = parser.parse_args().out
    motions = {
        "gallbladder_bimanual": bimanual,
        "liver_retraction": retraction,
        "slab_probe": on_slab(PRESS),
        "honeycomb": on_slab(DRAG),
        "interface_2011": stylus,
        "kidney_grasper": grasp,
        "needle_insertion": insertion,
        "gallbladder_tf": above(TRACK),
        "gallbladder_full": above(SQUEEZE),
        "skin_two_layer": on_slab(PRICK, top=0.0045, radius=0.0005),
    }
    for name, motion in motions.items():
        with open(os.path.join(ROOT, "config/scenes", name + ".yaml"), encoding="utf-8") as file:
            t, columns = motion(yaml.safe_load(file))
        path = os.path.join(folder, name + ".csv")
        with open(path, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["t"] + list(columns))
            for k, time in enumerate(t):
                writer.writerow(["%.3f" % time] + ["%.6f" % (q[k] + 0.0) for q in columns.values()])
        print("%s: %d rows, %.1f s" % (path, len(t), t[-1]))


if __name__ == "__main__":
    main()
