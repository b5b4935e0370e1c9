# SPDX-License-Identifier: GPL-3.0-or-later
"""What the hand does: the shipped recording, and motions of the probe over an organ and of the grasper."""

import importlib.util
import math
import random

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from accuracy.solve import ROOT

from .replays import Motion

RATE = 100  # rows a second


def _demo():
    """scripts/data/make_demo_bag.py: surfaces, where a ball touches them, joints, minimum jerk."""
    spec = importlib.util.spec_from_file_location("make_demo_bag", ROOT / "scripts" / "data" / "make_demo_bag.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def recorded(name="liver_palpation"):
    """A table of config/trajectories."""
    file = ROOT / "config" / "trajectories" / f"{name}.csv"
    names = file.open().readline().strip().split(",")[1:]
    rows = np.loadtxt(file, delimiter=",", skiprows=1)
    return Motion(tuple(names), rows[:, 0], rows[:, 1:])


class Hand:
    """Moves the probe of a scene over its first organ."""

    def __init__(self, scene, cells=(36, 22), inset=0.75):
        self.demo = _demo()
        organ, tool = scene["organs"][0], scene["instruments"][0]
        self.chain = self.demo.Chain(tool["urdf"], tool["control_frame"])
        base = tool.get("base") or {}
        self.base = self.demo.pose(base.get("position", (0, 0, 0)), base.get("roll_pitch_yaw", (0, 0, 0)))
        points, triangles = self.demo.read_obj(organ["surface"])
        place = organ.get("pose") or {}
        x_wo = self.demo.pose(place.get("position", (0, 0, 0)), place.get("roll_pitch_yaw", (0, 0, 0)))
        self.points = points * float(organ.get("scale", 1.0)) @ x_wo[:3, :3].T + x_wo[:3, 3]
        self.reach = inset * self.points[:, :2].min(0), inset * self.points[:, :2].max(0)  # of x and y [m]
        x, y = (np.linspace(low, high, n) for low, high, n in zip(*self.reach, cells))
        places = np.array([(a, b) for a in x for b in y])
        touch = self.demo.touch_heights(self.points[triangles], places, self.chain.radius)
        touch = np.where(np.isfinite(touch), touch, self.points[:, 2].min())
        self.touch = RegularGridInterpolator((x, y), touch.reshape(len(x), len(y)))

    def way(self, tips, tilts=None):
        """The Motion of a ball whose centre is at tips (k, 3) [m], a row each 1/RATE s."""
        tilts = np.zeros((len(tips), 2)) if tilts is None else tilts
        rows = self.demo.joint_positions(self.chain, self.base, tips, tilts)
        return Motion(tuple(self.chain.names), np.arange(len(tips)) / RATE, np.array(rows))

    def over(self, waypoints):
        """Between rows of (t [s], x, y, depth below first touch [m]; negative: clearance) on minimum jerk."""
        times = np.arange(int(round(waypoints[-1][0] * RATE)) + 1) / RATE
        rows = self.demo.minimum_jerk(waypoints, times)
        return self.way(np.column_stack([rows[:, :2], self.touch(rows[:, :2]) - rows[:, 2]]))

    def tip(self, motion, row):
        """Where a Motion has the ball's centre [m], and its tilt [rad]."""
        q = dict(zip(motion.names, motion.values[row]))
        turns = [name for name, prismatic, _, _ in self.chain.joints if name and not prismatic]
        return (self.base @ np.append(self.chain.tip(q), 1.0))[:3], (q[turns[0]], q[turns[1]])


def hold(hand, place, tilt, aside, seconds):
    """To a place [m] and held there: (from straight above, from the side after a press `aside` [m] of it)."""
    place = np.array(place)
    above, beside = place + [0, 0, 0.04], place + [aside, 0, 0.4 * abs(aside)]
    ways = []
    for stations in ([(0.0, above), (0.8, place)],
                     [(0.0, beside + [0, 0, 0.04]), (0.8, beside), (1.0, beside), (1.6, place)]):
        times = np.arange(int(round((stations[-1][0] + seconds) * RATE)) + 1) / RATE
        table = [(t, *p) for t, p in stations] + [(stations[-1][0] + max(seconds, 0.01), *place)]
        ways.append(hand.way(hand.demo.minimum_jerk(table, times), np.tile(tilt, (len(times), 1))))
    return ways


def slide(hand, depth, speed, seconds):
    """Presses in and goes back and forth along x at a steady speed [m/s]."""
    low, high = 0.75 * hand.reach[0][0], 0.75 * hand.reach[1][0]
    along = np.arange(int(round(seconds * RATE)) + 1) / RATE * speed
    turn = 2 * (high - low)
    x = low + (high - low) - np.abs((along % turn) - (high - low))
    xy = np.column_stack([x, np.zeros_like(x)])
    down = np.minimum(1.0, np.arange(len(x)) / (0.3 * RATE))
    return hand.way(np.column_stack([xy, hand.touch(xy) + 0.003 - (depth + 0.003) * down]))


def wander(hand, seconds, seed=1, fastest=0.1, deepest=0.010, pause=20.0):
    """Presses, slides, leaves, goes elsewhere, all at random; each `pause` [s] or so the tool stays away for 2 s.
    Returns (Motion, [(begin, end)] of these stays [s])."""
    draw = random.Random(seed)

    def anywhere():
        return [draw.uniform(0.7 * a, 0.7 * b) for a, b in zip(*hand.reach)]
    stations, stays = [(0.0, *anywhere(), -0.04)], []

    def go(x, y, depth, least=0.3):
        t, *old = stations[-1]
        way = math.dist(old[:2], (x, y)) + abs(old[2] - depth)
        stations.append((t + max(least, 1.9 * way / fastest), x, y, depth))  # minimum jerk: 1.9 of the mean speed
    rested = 0.0
    while stations[-1][0] < seconds:
        go(*anywhere(), draw.uniform(-0.02, -0.01))
        go(*stations[-1][1:3], draw.uniform(0.3, 1.0) * deepest)
        for _ in range(draw.randrange(3)):
            x, y = stations[-1][1:3]
            near = [min(max(c + draw.uniform(-0.03, 0.03), 0.7 * a), 0.7 * b) for c, a, b in zip((x, y), *hand.reach)]
            go(*near, draw.uniform(0.2, 0.8) * deepest)
        go(*stations[-1][1:3], draw.uniform(-0.02, -0.01))
        if stations[-1][0] - rested > pause:
            go(*stations[-1][1:3], -0.05)
            rested = stations[-1][0]
            stations.append((rested + 2.0, *stations[-1][1:]))
            stays.append((rested, rested + 2.0))
    whole = hand.over(stations)
    return whole.during(0.0, seconds), [s for s in stays if s[1] <= seconds]


def grasp(scene, place, opening=0.4, closed=0.3, deep=0.004, pull=0.002):
    """The grasper of a scene comes to `place` (x, y) [m] of the organ's top with its jaws open across x, goes in,
    closes, pulls, opens and leaves; 4 s. The tip goes along the line through the remote centre."""
    demo = _demo()
    organ, tool = scene["organs"][0], scene["instruments"][0]
    points, triangles = demo.read_obj(organ["surface"])
    top = np.array([*place, demo.heights(points[triangles], np.array([place]))[0]])
    base = np.array((tool.get("base") or {}).get("position", (0, 0, 0)), float)
    way = top - base
    far = np.linalg.norm(way)
    yaw, pitch = math.atan2(-way[0], -way[2]), math.asin(way[1] / far)
    # t [s], tip below the surface [m], opening of a jaw [rad].
    stations = [(0.0, -0.04, opening), (0.2, -0.04, opening), (1.0, deep, opening), (1.2, deep, opening),
                (1.9, deep, closed), (2.2, deep, closed), (2.8, deep - pull, closed), (3.2, deep - pull, closed),
                (3.5, deep - pull, opening), (4.0, -0.04, opening)]
    times = np.arange(int(round(stations[-1][0] * RATE)) + 1) / RATE
    rows = demo.minimum_jerk(stations, times)
    names = ("yaw", "pitch", "insertion", "roll", "wrist_pitch", "wrist_yaw", "jaw_left")
    still = np.ones(len(times))
    values = np.column_stack([yaw * still, pitch * still, far + rows[:, 0], 0.5 * math.pi * still, 0 * still,
                              0 * still, rows[:, 1]])
    return Motion(names, times, values)
