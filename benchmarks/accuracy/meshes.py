# SPDX-License-Identifier: GPL-3.0-or-later
"""Tetrahedral meshes of the cases: boxes, and prisms over flat triangulations, bent by a map."""

import itertools

import meshio
import numpy as np

EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))  # of the mid-edge nodes, in VTK's order


class Mesh:
    """points (n, 3) [m]; tets (m, 4) or, with mid-edge nodes in VTK's order, (m, 10)."""

    def __init__(self, points, tets):
        self.points = np.asarray(points, float)
        self.tets = np.asarray(tets, int)

    @property
    def quadratic(self):
        return self.tets.shape[1] == 10

    def size(self):
        return f"{len(self.tets)} tetrahedra, {len(self.points)} nodes"

    def mapped(self, function):
        """The same tetrahedra with every node moved: function (n, 3) -> (n, 3)."""
        return Mesh(function(self.points), self.tets).positive()

    def positive(self):
        """Nodes swapped where needed so that all volumes are positive."""
        x = self.points[self.tets[:, :4]]
        volume = np.linalg.det(x[:, 1:] - x[:, :1])
        turned = self.tets[:, [0, 2, 1, 3, 6, 5, 4, 7, 9, 8][: self.tets.shape[1]]]
        return Mesh(self.points, np.where((volume < 0)[:, None], turned, self.tets))

    def with_midnodes(self):
        """A node in the middle of every edge; bend the mesh afterwards to bend the edges too."""
        pairs = np.sort(np.stack([self.tets[:, e] for e in EDGES], axis=1), axis=2)
        unique, index = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
        middle = self.points[unique].mean(axis=1)
        mids = len(self.points) + index.reshape(-1, 6)
        return Mesh(np.vstack([self.points, middle]), np.hstack([self.tets, mids]))

    def for_element(self, element):
        """With mid-edge nodes where the element has them."""
        return self.with_midnodes() if is_quadratic(element) else self

    def volume(self):
        """Of the tetrahedra between the corner nodes [m^3]."""
        x = self.points[self.tets[:, :4]]
        return np.linalg.det(x[:, 1:] - x[:, :1]).sum() / 6.0

    def write(self, file):
        kind = "tetra10" if self.quadratic else "tetra"
        meshio.write(file, meshio.Mesh(self.points, [(kind, self.tets)]), file_format="vtu")


def is_quadratic(element):
    """Whether its tetrahedra have 10 nodes."""
    return element.startswith("tet10")


def box(size, cells, origin=(0, 0, 0), flips=None):
    """A box of cells with six tetrahedra each. `flips`: per axis, in which cells the tetrahedra
    are mirrored, so that a mesh can have the symmetry of its body."""
    axes = [np.linspace(0, s, n + 1) + o for s, n, o in zip(size, cells, origin)]
    return grid(axes, flips)


def grid(axes, flips=None):
    """As box(), with the coordinates of the cells' ends along each axis."""
    n = np.array([len(a) for a in axes])
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    flips = flips or [np.zeros(k - 1, bool) for k in n]
    cells = np.stack(np.meshgrid(*[np.arange(k - 1) for k in n], indexing="ij"), -1).reshape(-1, 3)
    flip = np.stack([np.asarray(f, bool)[cells[:, k]] for k, f in enumerate(flips)], axis=1)
    tets = []
    for order in itertools.permutations(range(3)):  # paths from a corner to the opposite one
        corner = np.zeros(3, bool)
        path = [corner.copy()]
        for axis in order:
            corner[axis] = True
            path.append(corner.copy())
        nodes = [cells + (c ^ flip) for c in path]
        tets.append(np.stack([(i[:, 0] * n[1] + i[:, 1]) * n[2] + i[:, 2] for i in nodes], axis=1))
    return Mesh(points, np.vstack(tets)).positive()


def prisms(plane_points, triangles, layers):
    """Layers of prisms over a triangulation (n, 2), (m, 3), three tetrahedra each; the third
    coordinate takes the values `layers`. Diagonals start at the lower node number, so that
    neighbours agree."""
    plane_points, triangles = np.asarray(plane_points), np.sort(triangles, axis=1)
    n, levels = len(plane_points), len(layers)
    points = np.hstack([np.tile(plane_points, (levels, 1)), np.repeat(layers, n)[:, None]])
    a, b, c = triangles.T
    tets = []
    for k in range(levels - 1):
        low, high = k * n, (k + 1) * n
        tets += [np.stack([a + low, b + low, c + low, c + high], 1),
                 np.stack([a + low, b + low, b + high, c + high], 1),
                 np.stack([a + low, a + high, b + high, c + high], 1)]
    return Mesh(points, np.vstack(tets)).positive()


def triangle(n):
    """Barycentric points (k, 3) and triangles of a triangle whose sides are cut into n."""
    index, points = {}, []
    for i in range(n + 1):
        for j in range(n + 1 - i):
            index[i, j] = len(points)
            points.append([1 - (i + j) / n, i / n, j / n])
    triangles = []
    for i, j in index:
        if i + j < n:
            triangles.append([index[i, j], index[i + 1, j], index[i, j + 1]])
        if i + j < n - 1:
            triangles.append([index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]])
    return np.array(points), np.array(triangles)


def disc(radii, segments, quarter=False):
    """Points and triangles of a disc about the origin, or of its quarter x, y >= 0. Ring k has the
    radius radii[k] and is cut into segments[k] parts (of the quarter, or of the whole)."""
    angle = np.pi / 2 if quarter else 2 * np.pi
    points, rings, triangles = [[0.0, 0.0]], [[0]], []
    for radius, m in zip(radii, segments):
        ring = []
        for j in range(m + 1 if quarter else m):
            t = j / m * angle
            c, s = np.cos(t), np.sin(t)
            if quarter and j == m:
                c = 0.0  # on the plane of symmetry, to the last bit
            ring.append(len(points))
            points.append([radius * c, radius * s])
        rings.append(ring if quarter else ring + ring[:1])
    for inner, outer in zip(rings, rings[1:]):
        i, j = 0, 0
        p, q = max(len(inner) - 1, 1), len(outer) - 1
        while j < q or i < len(inner) - 1:  # advance on the ring that lags behind
            if i == len(inner) - 1 or (j < q and (j + 1) / q <= (i + 1) / p):
                triangles.append([inner[i], outer[j], outer[j + 1]])
                j += 1
            else:
                triangles.append([inner[i], outer[j], inner[i + 1]])
                i += 1
    return np.array(points), np.array(triangles)


def graded(first, last, growth):
    """0, first, ... last: steps that grow by the factor `growth`, stretched to end at `last`."""
    values, step = [0.0], first
    while values[-1] < last:
        values.append(values[-1] + step)
        step *= growth
    return np.array(values) * (last / values[-1])
