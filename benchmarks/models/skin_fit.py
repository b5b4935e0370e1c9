# SPDX-License-Identifier: GPL-3.0-or-later
"""Two layers of skin at large strains, fitted to both measured profiles at once."""

import dataclasses

import numpy as np
from accuracy import meshes, plots
from accuracy.rows import table as table_of
from accuracy.solve import Failed, plane, solve
from scipy.optimize import least_squares
from scipy.stats import t as student

from .skin import Block

HALF, HEIGHT, SLAB, PATCH = 6.0, 4.5, 0.25, 0.25  # [mm]
YOUNG, POISSON = 0.2e6, 0.48  # of the upper layer: forces are known by it only
COLUMNS = [0, .125, .25, .3125, .375, .5, .625, .75, .875, 1, 1.25, 1.5, 1.75, 2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6]  # [mm]
STEPS = {1: 8, 2: 4}  # load steps by set, 1.8 and 0.83 mm deep
PENALTY = 1.0  # [mm] each reading, where no equilibrium is found
CONFIDENCE = 0.95
TEXT = """One law and one set of constants for both profiles, which no linear model can have: finite elements at large strains
(`palpate solve`), in plane strain, for the load was a line. Half of the block is meshed, {nodes} nodes of `tet10`; a strip
0.5 mm wide is pressed down as deep as the first reading, {deep:.3f} and {shallow:.3f} mm, and does not slide, so that no
depth has to be guessed; the {readings} readings beyond it count alike. Least squares (trust region of Levenberg and
Marquardt) start near what a wider search with coarser elements found. Intervals are those of a linear model about the
least, {confidence:.0f} %, from the Jacobian of residuals by differences. The interface may lie anywhere: rows of elements
follow it. E of the upper layer stays 0.2 MPa, for shapes under given depths know ratios only.

Laws: `linear`; `neo_hookean`; the upper layer of `demiray`, W = a/2b (exp(b (I_1 - 3)) - 1) with a = E/2(1 + nu), the lower
one neo-Hookean; both of it, each with its b; the first again with Poisson's ratio of the lower layer free, which is 0.48
otherwise. The ratio is that of shear moduli at rest; beside a free Poisson's ratio below, profiles hardly tell it. Forces are
not measured: those given are of E as assumed."""


@dataclasses.dataclass
class Model:
    name: str
    law: str
    parameters: tuple
    start: tuple  # their values, near the least of wider searches with coarser elements

    def materials(self, values):
        v = dict(zip(self.parameters, values))
        if self.law != "demiray":
            return [{"law": self.law, "young_modulus": YOUNG / r, "poisson_ratio": POISSON} for r in (1.0, v["ratio"])]
        mu, nu = YOUNG / (2 * (1 + POISSON)), v.get("nu lower", POISSON)
        upper = {"law": "demiray", "a": mu, "b": v["b upper"], "poisson_ratio": POISSON}
        if "b lower" in v:
            return [upper, {"law": "demiray", "a": mu / v["ratio"], "b": v["b lower"], "poisson_ratio": nu}]
        return [upper, {"law": "neo_hookean", "young_modulus": 2 * (1 + nu) * mu / v["ratio"], "poisson_ratio": nu}]


TWO = ("fraction", "ratio")
MODELS = [Model("linear", "linear", TWO, (0.5, 60.0)),
          Model("neo-Hookean", "neo_hookean", TWO, (0.5, 60.0)),
          Model("the upper layer stiffens", "demiray", (*TWO, "b upper"), (0.6, 20.0, 20.0)),
          Model("both stiffen", "demiray", (*TWO, "b upper", "b lower"), (0.65, 16.0, 28.0, 0.3)),
          Model("the upper one stiffens, nu lower free", "demiray", (*TWO, "b upper", "nu lower"),
                (0.6, 5.0, 30.0, 0.4))]
BOUNDS = {"fraction": (0.04, 0.92), "ratio": (0.05, 3000.0), "b upper": (0.01, 90.0), "b lower": (0.01, 90.0),
          "nu lower": (0.05, 0.49)}


def free(name, value):
    """What is varied: logarithms, but of numbers that have two ends."""
    return value if name in ("fraction", "nu lower") else np.log(value)


def given(name, value):
    return value if name in ("fraction", "nu lower") else np.exp(value)


def scale(name):
    return 0.1 if name in ("fraction", "nu lower") else 0.5


def readings(context):
    """Radii and depths by set [mm]."""
    found = Block(context.work / "skin_readings", "--ratios", "none").table("profiles")
    return {k: (1e3 * found["radius"][found["set"] == k], 1e3 * found["measured"][found["set"] == k]) for k in (1, 2)}


def mesh_of(fraction, element, finer):
    split = HEIGHT * (1 - fraction)
    columns = np.array(COLUMNS)
    for _ in range(finer - 1):
        columns = np.sort(np.append(columns, 0.5 * (columns[1:] + columns[:-1])))
    rows = np.append(np.linspace(0, split, 5 * finer + 1), np.linspace(split, HEIGHT, 5 * finer + 1)[1:])
    return meshes.grid([1e-3 * columns, [0, 1e-3 * SLAB], 1e-3 * rows]).for_element(element)


def surface(folder, materials, fraction, depth, steps, element, finer):
    """x and depth of the top nodes where they are [mm], from the middle outwards, and the force on a slab of 1 mm
    [N]."""
    mesh = mesh_of(fraction, element, finer)
    tip, split, top = 1e-7, 1e-3 * HEIGHT * (1 - fraction), 1e-3 * HEIGHT
    pressed = {"box": {"min": [-tip, -1, top - tip], "max": [1e-3 * PATCH + tip, 1, 1]}}
    boundary = [{"select": plane("y", y), "displacement": [None, 0, None]} for y in (0, 1e-3 * SLAB)]
    boundary += [{"select": plane("x", 0), "displacement": [0, None, None]},
                 {"select": plane("x", 1e-3 * HALF), "displacement": [0, 0, 0]},
                 {"select": plane("z", 0), "displacement": [0, 0, 0]},
                 {"select": pressed, "displacement": [0, 0, -1e-3 * depth]}]
    lower = {"name": "lower", "select": {"half_space": {"point": [0, 0, split], "normal": [0, 0, -1]}},
             "material": materials[1]}
    probe = {"name": "pressed", "select": pressed, "quantity": "reaction"}
    for more in (1, 3, 9):
        try:
            result = solve(folder, mesh, element, materials[0], boundary, [probe],
                           {"load_steps": more * steps, "tolerance": 1e-7}, regions=[lower])
            break
        except Failed:
            if more == 9:
                raise
    nodes = np.flatnonzero((mesh.points[:, 2] > top - tip) & (mesh.points[:, 1] < tip))
    nodes = nodes[np.argsort(mesh.points[nodes, 0])]
    force = -2 * result.force("pressed")[2] / SLAB  # both halves
    return (1e3 * (mesh.points[nodes, 0] + result.displacement[nodes, 0]), -1e3 * result.displacement[nodes, 2], force,
            len(mesh.points))


def depths_at(x, depth, radii):
    """Of a surface that may hang over: what lies farthest out."""
    found = []
    for r in radii:
        k = np.flatnonzero((x[:-1] <= r) & (r < x[1:]) | (x[1:] <= r) & (r < x[:-1]))
        k = k[-1] if len(k) else len(x) - 2
        found.append(depth[k] + (depth[k + 1] - depth[k]) * (r - x[k]) / (x[k + 1] - x[k]))
    return np.array(found)


class Fit:
    """`model` on a mesh: residuals [mm] of both sets in one row, set 1 first."""

    def __init__(self, context, model, data, element, finer):
        self.folder = context.work / f"skin_fit_{MODELS.index(model)}"
        self.model, self.data, self.element, self.finer = model, data, element, finer
        self.solves = self.failures = 0

    def surfaces(self, values):
        """By set: x, depth, force, nodes."""
        materials, found = self.model.materials(values), {}
        for k, (_, measured) in self.data.items():
            steps = 1 if self.model.law == "linear" else STEPS[k]
            found[k] = surface(self.folder, materials, values[0], measured[0], steps, self.element, self.finer)
            self.solves += 1
        return found

    def residuals(self, variables):
        values = [given(n, v) for n, v in zip(self.model.parameters, variables)]
        try:
            found = self.surfaces(values)
        except Failed:
            self.failures += 1
            return np.full(sum(len(r) - 1 for r, _ in self.data.values()), PENALTY)
        return np.concatenate([depths_at(*found[k][:2], radii[1:]) - measured[1:]
                               for k, (radii, measured) in self.data.items()])

    def least(self, start, evaluations):
        names = self.model.parameters
        low, high = np.transpose([[free(n, b) for b in BOUNDS[n]] for n in names])
        return least_squares(self.residuals, [free(n, v) for n, v in zip(names, start)], bounds=(low, high),
                             x_scale=[scale(n) for n in names], diff_step=5e-3, xtol=1e-3, ftol=1e-4, max_nfev=evaluations)


def intervals(found, model):
    """Value, low and high end of each parameter; no ends where it is at one of its bounds, as if it were given."""
    inside = np.array([min(abs(x - free(n, b)) for b in BOUNDS[n]) > 0.05 * scale(n)
                       for n, x in zip(model.parameters, found.x)])
    jac, n, p = found.jac[:, inside], len(found.fun), inside.sum()
    spread = np.linalg.inv(jac.T @ jac) * (found.fun @ found.fun) / (n - p)
    reach = np.full(len(inside), np.nan)
    reach[inside] = student.ppf(0.5 + 0.5 * CONFIDENCE, n - p) * np.sqrt(np.diag(spread))
    return [[given(name, v) for v in (x, x - r, x + r)] for name, x, r in zip(model.parameters, found.x, reach)]


def fitted(context, model, data):
    fit = Fit(context, model, data, "anp" if context.quick else "tet10", 1)
    found = fit.least(model.start, 2 if context.quick else 30)
    context.progress(f"skin_fit: {model.name}: {1e3 * np.sqrt(np.mean(found.fun ** 2)):.1f} um, {fit.solves} solves, "
                     f"{fit.failures} without an equilibrium; {found.message}")
    return fit, found


def rms(residuals, first):
    return [np.sqrt(np.mean(part ** 2)) for part in (residuals[:first], residuals[first:], residuals)]


def run(context):
    data = readings(context)
    first = len(data[1][0]) - 1
    fits, lines, constants, shown, nodes = {}, [], [], {}, 0
    for model in MODELS[:3] if context.quick else MODELS:
        fit, found = fitted(context, model, data)
        values = [given(n, v) for n, v in zip(model.parameters, found.x)]
        surfaces = fit.surfaces(values)
        finer = Fit(context, model, data, fit.element, 2).residuals(found.x)
        fits[model.name], shown[model.name], nodes = found, surfaces, surfaces[1][3]
        a, b, both = rms(found.fun, first)
        lines.append([model.name, len(values), f"{a:.4f}", f"{b:.4f}", f"{both:.4f}", f"{np.abs(found.fun).max():.3f}",
                      f"{rms(finer, first)[2]:.4f}", f"{surfaces[1][2]:.4f}", f"{surfaces[2][2]:.4f}"])
        for name, (value, low, high) in zip(model.parameters, intervals(found, model)):
            span = f"{low:.3g} to {high:.3g}" if np.isfinite(low) else "at its bound"
            constants.append([model.name, name, f"{value:.3g}", span])
    fig, axes = plots.figure(2, width=9.2, height=3.6)
    for k, ax in zip(data, axes):
        ax.plot(*data[k], "+", color="black", markersize=8, label="readings")
        for colour, (name, found) in zip(("tet4", "p1p1", "anp", "tet10p", "tet10"), shown.items()):
            ax.plot(found[k][0], found[k][1], color=plots.COLOUR[colour], label=name)
        ax.set(xlabel="from the middle [mm]", ylabel="depth of the surface [mm]", title=f"set {k}", xlim=(0, 6.1))
        ax.invert_yaxis()
    axes[0].legend(loc="lower right", fontsize=8)
    picture = plots.save(fig, context.images, "skin_fit.svg")
    text = TEXT.format(nodes=nodes, deep=data[1][1][0], shallow=data[2][1][0], readings=len(next(iter(fits.values())).fun),
                       confidence=100 * CONFIDENCE)
    return f"""### Two layers of skin at large strains, both profiles at once

{text}

{table_of(["law", "parameters", "rms of set 1 [mm]", "set 2 [mm]", "both [mm]", "largest [mm]",
           "both on a mesh twice as fine [mm]", "force, set 1, slab of 1 mm [N]", "set 2 [N]"], lines)}

![Fitted surfaces and readings of both sets](images/models/{picture})

{table_of(["law", "parameter", "value", f"{100 * CONFIDENCE:.0f} %"], constants)}
"""
