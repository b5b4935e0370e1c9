#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws moments of a replay without a screen: organs, instruments, and the forces on them.

    scripts/render_replay.py SCENE --trajectory T.csv --time S [S ...] --eye X Y Z --look-at X Y Z --out FILE.png

Replays the trajectory to each time with the built `palpate`, reads the deformed organs that it writes,
puts the URDFs' visuals at their joint positions and draws it all by a depth buffer, the moments side by
side: the same scene gives the same picture.
"""
import argparse
import csv
import glob
import math
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import meshio
import numpy as np
import yaml
from matplotlib.image import imsave

import find_palpate

sys.path.append(os.path.join(find_palpate.ROOT, "scripts", "data"))
from make_demo_bag import numbers, pose, rotation  # noqa: E402

ORGANS = [(0.62, 0.25, 0.20), (0.42, 0.56, 0.26), (0.75, 0.50, 0.35)]  # in the scene's order
ARROW = (0.16, 0.86, 0.45)
BACKGROUND = np.array([0.93, 0.94, 0.96])
SAMPLES = 2  # a pixel, in each direction


class Mesh:
    """Points (n, 3), triangles (m, 3), a normal for each point, a colour, and whether to draw edges."""

    def __init__(self, points, triangles, colour, edges=False, flat=False):
        if flat:
            points, triangles = points[triangles].reshape(-1, 3), np.arange(triangles.size).reshape(-1, 3)
        self.points, self.triangles, self.colour, self.edges = points, triangles, np.array(colour[:3]), edges
        a, b, c = (points[triangles[:, k]] for k in range(3))
        self.normals = np.zeros_like(points)
        for k in range(3):
            np.add.at(self.normals, triangles[:, k], np.cross(b - a, c - a))
        self.normals /= np.linalg.norm(self.normals, axis=1, keepdims=True) + 1e-30

    def moved(self, x):
        self.points = self.points @ x[:3, :3].T + x[:3, 3]
        self.normals = self.normals @ x[:3, :3].T
        return self


def surface(mesh):
    """Triangles that belong to one tetrahedron or hexahedron only, outward, of a meshio mesh, or all that it has."""
    tets = [block.data[:, :4] for block in mesh.cells if block.type.startswith("tetra")]
    # Along a diagonal from corner 0 to 6: neighbours on a grid cut their common side alike.
    paths = [(1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1)]
    for block in mesh.cells:
        if block.type == "hexahedron":
            tets += [block.data[:, [0, a, b, 6]] for a, b in paths]
    if not tets:
        return np.vstack([block.data for block in mesh.cells if block.type == "triangle"])
    tets = np.vstack(tets)
    faces = np.vstack([tets[:, k] for k in ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def lathe(profile, colour, around=32):
    """A body of revolution about z from rows of radius and height, with creases between rows."""
    angles = 2.0 * math.pi * np.arange(around) / around
    points, triangles = [], []
    for (r0, z0), (r1, z1) in zip(profile[:-1], profile[1:]):
        base = len(points)
        for r, z in ((r0, z0), (r1, z1)):
            points += [(r * math.cos(a), r * math.sin(a), z) for a in angles]
        for k in range(around):
            i, j = base + k, base + (k + 1) % around
            triangles += [(i, j, j + around), (i, j + around, i + around)]
    return Mesh(np.array(points), np.array(triangles), colour)


def shape(geometry, colour):
    """Of a URDF's geometry: cylinder, sphere or box."""
    form = geometry[0]
    if form.tag == "cylinder":
        r, half = float(form.get("radius")), 0.5 * float(form.get("length"))
        return lathe([(0, -half), (r, -half), (r, half), (0, half)], colour)
    if form.tag == "sphere":
        r, angles = float(form.get("radius")), np.linspace(-math.pi / 2, math.pi / 2, 17)
        ball = lathe([(r * math.cos(a), r * math.sin(a)) for a in angles], colour)
        ball.normals = ball.points / r
        return ball
    if form.tag == "box":
        half = 0.5 * np.array(numbers(form.get("size"), ""))
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        return Mesh(corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]), colour, flat=True)
    sys.exit("render_replay.py: %s cannot be drawn" % form.tag)


def origin(of):
    element = of.find("origin")
    at = {} if element is None else element.attrib
    return pose(numbers(at.get("xyz"), "0 0 0"), numbers(at.get("rpy"), "0 0 0"))


def instrument(path, base, q):
    """The visuals of a URDF as meshes, and the poses of its links, for joint positions by name."""
    robot = xml.etree.ElementTree.parse(path).getroot()
    colours = {m.get("name"): numbers(m.find("color").get("rgba"), "") for m in robot.findall("material")}
    children = {}
    for joint in robot.findall("joint"):
        children.setdefault(joint.find("parent").get("link"), []).append(joint)
    below = {joint.find("child").get("link") for joint in robot.findall("joint")}
    links = {link.get("name"): base for link in robot.findall("link") if link.get("name") not in below}
    waiting = list(links)
    while waiting:
        parent = waiting.pop()
        for joint in children.get(parent, []):
            motion, mimic = np.eye(4), joint.find("mimic")
            name, factor, offset = joint.get("name"), 1.0, 0.0
            if mimic is not None:
                name, factor = mimic.get("joint"), float(mimic.get("multiplier", 1))
                offset = float(mimic.get("offset", 0))
            if joint.get("type") != "fixed":
                axis, value = np.array(numbers(joint.find("axis").get("xyz"), "")), factor * q[name] + offset
                if joint.get("type") == "prismatic":
                    motion[:3, 3] = value * axis
                else:
                    motion[:3, :3] = rotation(axis, value)
            child = joint.find("child").get("link")
            links[child] = links[parent] @ origin(joint) @ motion
            waiting.append(child)
    meshes = []
    for link in robot.findall("link"):
        for visual in link.findall("visual"):
            material = visual.find("material")
            colour = (0.6, 0.6, 0.6) if material is None else colours[material.get("name")]
            meshes.append(shape(visual.find("geometry"), colour).moved(links[link.get("name")] @ origin(visual)))
    return meshes, links


def arrow(at, way):
    """From `at` along `way`, as thick as its length asks for."""
    length = np.linalg.norm(way)
    z = way / length
    x = np.cross([0.0, 1.0, 0.0] if abs(z[1]) < 0.9 else [1.0, 0.0, 0.0], z)
    x /= np.linalg.norm(x)
    placed = np.eye(4)
    placed[:3, :3], placed[:3, 3] = np.column_stack([x, np.cross(z, x), z]), at
    head, r = min(0.35 * length, 0.012), min(0.08 * length, 0.0016)
    return lathe([(0, 0), (r, 0), (r, length - head), (2.6 * r, length - head), (0, length)], ARROW).moved(placed)


def camera(eye, target, width, height, angle):
    """Maps points (n, 3) to columns, rows and depths; and the direction to the light."""
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    focal = 0.5 * height / math.tan(0.5 * math.radians(angle))

    def project(points):
        p = (points - eye) @ np.column_stack([right, up, forward])
        return np.column_stack([0.5 * width + focal * p[:, 0] / p[:, 2], 0.5 * height - focal * p[:, 1] / p[:, 2], p[:, 2]])

    light = -forward + 0.35 * up - 0.35 * right
    return project, light / np.linalg.norm(light), forward


def draw(mesh, project, light, forward, image, depth):
    """Into `image` (h, w, 3) where it is nearer than `depth` (h, w)."""
    height, width = depth.shape
    p = project(mesh.points)
    for t in mesh.triangles:
        a, b, c = p[t]
        if min(a[2], b[2], c[2]) < 1e-3:
            continue
        x0, x1 = max(int(min(a[0], b[0], c[0])), 0), min(int(max(a[0], b[0], c[0])) + 1, width - 1)
        y0, y1 = max(int(min(a[1], b[1], c[1])), 0), min(int(max(a[1], b[1], c[1])) + 1, height - 1)
        area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        if x1 < x0 or y1 < y0 or abs(area) < 1e-9:
            continue
        x, y = np.meshgrid(np.arange(x0, x1 + 1) + 0.5, np.arange(y0, y1 + 1) + 0.5)
        v = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area
        w = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area
        u = 1.0 - v - w
        z = 1.0 / (u / a[2] + v / b[2] + w / c[2])
        window = depth[y0 : y1 + 1, x0 : x1 + 1]
        seen = (u >= 0) & (v >= 0) & (w >= 0) & (z < window)
        if not seen.any():
            continue
        u, v, w = u[seen], v[seen], w[seen]
        n = np.column_stack([u, v, w]) @ mesh.normals[t]
        n /= np.linalg.norm(n, axis=1, keepdims=True) + 1e-30
        n *= np.where(n @ forward > 0, -1.0, 1.0)[:, None]
        lit = 0.42 + 0.58 * np.clip(n @ light, 0.0, 1.0)
        half = light - forward
        shine = 0.18 * np.clip(n @ (half / np.linalg.norm(half)), 0.0, 1.0) ** 40
        colour = lit[:, None] * mesh.colour + shine[:, None]
        if mesh.edges:
            sides = [np.linalg.norm((q - r)[:2]) for q, r in ((b, c), (c, a), (a, b))]
            near = np.min([abs(area) * s / side for s, side in zip((u, v, w), sides)], axis=0)
            colour *= np.where(near < 0.6 * SAMPLES, 0.86, 1.0)[:, None]
        image[y0 : y1 + 1, x0 : x1 + 1][seen] = colour
        window[seen] = z[seen]


def replayed(scene, trajectory, time):
    """Joint positions by column, forces by column, and (points, triangles) of each organ."""
    with open(trajectory, encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    kept = [rows[0]] + [row for row in rows[1:] if float(row[0]) < time + 1e-9]
    with tempfile.TemporaryDirectory() as folder:
        cut, out = os.path.join(folder, "cut.csv"), os.path.join(folder, "out.csv")
        with open(cut, "w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows(kept)
        command = [find_palpate.program(), "replay", scene, "--trajectory", cut, "--out", out, "--vtu", folder]
        subprocess.run(command + ["--every", str(len(kept) - 1)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(out, encoding="utf-8") as file:
            result = list(csv.DictReader(file))[-1]
        organs = {}
        for path in glob.glob(os.path.join(folder, "*.vtu")):
            mesh = meshio.read(path)
            name = os.path.basename(path).rsplit("_", 1)[0]
            organs[name] = (mesh.points + mesh.point_data["displacement"], surface(mesh))
    return dict(zip(kept[0], map(float, kept[-1]))), result, organs


def meshes_at(scene, options, time):
    """All that is to be seen at a time."""
    q, result, organs = replayed(options.scene, options.trajectory, time)
    meshes = []
    for organ, colour in zip(scene["organs"], ORGANS * len(scene["organs"])):
        meshes.append(Mesh(*organs[organ["name"]], colour, edges=True))
    several = len(scene["instruments"]) > 1
    for tool in scene["instruments"]:
        name = tool["name"] + "/"
        joints = {k[len(name) :]: v for k, v in q.items() if k.startswith(name)} if several else q
        place = tool.get("base") or {}
        base = pose(place.get("position", (0, 0, 0)), place.get("roll_pitch_yaw", (0, 0, 0)))
        path = os.path.join(os.path.dirname(options.scene), tool["urdf"])
        visuals, links = instrument(path, base, joints)
        meshes += visuals
        force = np.array([float(result[(name if several else "") + axis]) for axis in ("fx", "fy", "fz")])
        if np.linalg.norm(force) > 1e-3:
            meshes.append(arrow(links[tool["control_frame"]][:3, 3], options.arrow_scale * force))
    return meshes


def picture(meshes, options):
    """An image (height, width, 3)."""
    columns, rows = options.size
    width, height = SAMPLES * columns, SAMPLES * rows
    eye, target = np.array(options.eye), np.array(options.look_at)
    project, light, forward = camera(eye, target, width, height, options.angle)
    image, depth = np.tile(BACKGROUND, (height, width, 1)), np.full((height, width), np.inf)
    for mesh in meshes:
        draw(mesh, project, light, forward, image, depth)
    return image.reshape(rows, SAMPLES, columns, SAMPLES, 3).mean(axis=(1, 3))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scene")
    parser.add_argument("--trajectory", required=True)
    parser.add_argument("--time", type=float, nargs="+", required=True, help="[s]")
    parser.add_argument("--eye", type=float, nargs=3, required=True, help="[m]")
    parser.add_argument("--look-at", type=float, nargs=3, required=True, help="[m]")
    parser.add_argument("--angle", type=float, default=30.0, help="of view, upright [deg]")
    parser.add_argument("--arrow-scale", type=float, default=0.2, help="[m/N]")
    parser.add_argument("--size", type=int, nargs=2, default=(560, 460), help="of a moment [pixels]")
    parser.add_argument("--out", required=True)
    options = parser.parse_args()

    with open(options.scene, encoding="utf-8") as file:
        scene = yaml.safe_load(file)
    pictures = [picture(meshes_at(scene, options, time), options) for time in options.time]
    rule = np.ones((options.size[1], 6, 3))
    row = [part for image in pictures for part in (rule, image)][1:]
    imsave(options.out, np.clip(np.hstack(row), 0.0, 1.0))


if __name__ == "__main__":
    main()
