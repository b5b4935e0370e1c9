# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball pressed into a half space and into a bonded layer, through the real cycle with contact."""

import numpy as np
from scipy.optimize import brentq

from .. import bounds, meshes, replay
from ..plots import COLOUR, figure, save
from ..report import rows_table
from ..rows import Row, Section

CASE = "ball on a half space"
ELEMENT, RADIUS, YOUNG, POISSON = "anp", 0.01, 5.0e3, 0.49  # [m], [Pa]
DEPTHS = (0.001, 0.002, 0.005)  # [m]
LAYER = 0.05  # [m]
SIZE = 0.4  # [m], radius and depth of the block that stands for the half space
HERTZ = "closed form for small depths [Hertz 1882]"
SNEDDON = "closed form for a ball at any depth, small strains [Sneddon 1965]"
DIMITRIADIS = "series for a bonded layer [Dimitriadis et al. 2002, eq. 8]"
SPACING, RATIO, COARSER = 0.00075, 1.5, (2, 1, 0)  # [m]; how often all elements are larger by the ratio
STIFFNESS, SMOOTHING = 3e8, 1e-5  # of contact [Pa/m], [m]
ORDER = 1  # at least, for the surface has a kink in its curvature where the contact ends


def hertz(depth, poisson=POISSON):
    return 4 / 3 * YOUNG / (1 - poisson ** 2) * np.sqrt(RADIUS) * depth ** 1.5


def sneddon(depth, poisson=POISSON):
    """The ball's own shape instead of the parabola that Hertz puts in its place."""
    def depth_of(a):
        return a / 2 * np.log((RADIUS + a) / (RADIUS - a))
    a = brentq(lambda r: depth_of(r) - depth, 1e-9, RADIUS * (1 - 1e-9))
    return YOUNG / (2 * (1 - poisson ** 2)) * ((a ** 2 + RADIUS ** 2) * np.log((RADIUS + a) / (RADIUS - a))
                                               - 2 * a * RADIUS)


def dimitriadis(depth, poisson=POISSON, thickness=LAYER):
    """Hertz times a series in sqrt(R d)/thickness, for a layer that is bonded to its ground."""
    alpha = -(1.2876 - 1.4678 * poisson + 1.3442 * poisson ** 2) / (1 - poisson)
    beta = (0.6387 - 1.0277 * poisson + 1.5164 * poisson ** 2) / (1 - poisson)
    x = np.sqrt(RADIUS * depth) / thickness
    series = (1 - 2 * alpha / np.pi * x + 4 * alpha ** 2 / np.pi ** 2 * x ** 2
              - 8 / np.pi ** 3 * (alpha ** 3 + 4 * np.pi ** 2 / 15 * beta) * x ** 3
              + 16 * alpha / np.pi ** 4 * (alpha ** 3 + 3 * np.pi ** 2 / 5 * beta) * x ** 4)
    return hertz(depth, poisson) * series


def bound(depth, formula, thickness, values):
    """Of a force beside a formula for a parabola or a ball: what refining may still change; what the block's
    ground changes of a half space; what a ball's own shape does, for formulas of small strain differ among
    each other by that; and that the tissue goes some way into the ball, force ~ depth^1.5."""
    gap = formula / (np.pi * RADIUS * depth) / STIFFNESS + SMOOTHING / 2
    ground = bounds.held(formula, YOUNG, POISSON, thickness, depth) if thickness == SIZE else 0.0
    return (bounds.refined([RATIO ** k for k in COARSER], values, formula, ORDER) + ground
            + abs(sneddon(depth) / hertz(depth) - 1) + 1.5 * gap / depth)


def body(depth, coarser):
    """A cylinder with its top at z = 0: elements of SPACING where the ball touches, growing away. `coarser`
    times all elements are larger by RATIO."""
    fine, larger = 0.009, RATIO ** coarser
    spacing = fine / round(fine / (SPACING * larger))
    radii = np.concatenate([spacing * np.arange(1, round(fine / spacing) + 1),
                            fine + meshes.graded(spacing, SIZE - fine, 1.5 ** larger)[1:]])
    points, triangles = meshes.disc(radii, [min(6 * (k + 1), round(36 / larger)) for k in range(len(radii))])
    return meshes.prisms(points, triangles, -meshes.graded(spacing, depth, 1.3 ** larger)[::-1])


def press(folder, element, law, thickness, coarser, step=0.1):
    """Force [N] at each depth, penetration [m], mesh."""
    mesh = body(thickness, coarser)
    heights = [RADIUS + 1e-3] + [RADIUS - d for d in DEPTHS]
    organ = {**replay.tetrahedra(folder, mesh, element),
             "material": {"law": law, "young_modulus": YOUNG, "poisson_ratio": POISSON}}
    forces, depth, _ = replay.press(
        folder, organ, {"plane": {"axis": "z", "at": -thickness}}, RADIUS, heights,
        {"stiffness": STIFFNESS, "smoothing": SMOOTHING}, {**SOLVER, "step": step}, hold=HOLD)
    return forces[1:, 2], depth[1:], mesh


SOLVER = {"integrator": "static", "tolerance": 1e-5, "position_tolerance": 1e-9, "threads": 1,
          "max_newton_iterations": 50, "max_linear_iterations": 5000}
HOLD = 4  # steps of 0.1 s at rest after each move: ten times the time that waves need


def run(context):
    rows, forces = [], {}
    runs = [("linear", SIZE, k) for k in COARSER]
    runs += [] if context.quick else [*(("linear", LAYER, k) for k in COARSER), ("neo_hookean", SIZE, 0)]
    for law, thickness, coarser in runs:
        name = f"{law}_{1e3 * thickness:g}_{coarser}"
        f, penetration, mesh = press(context.folder(CASE, name), ELEMENT, law, thickness, coarser)
        context.progress(f"{name}: {', '.join(f'{v:.5f} N' for v in f)}; penetration at most "
                         f"{1e6 * penetration.max():.0f} um")
        found = forces.setdefault((law, thickness), [])
        found.append(f)
        where = "half space" if thickness == SIZE else f"layer of {1e3 * LAYER:g} mm"
        size = f"elements of {1e3 * SPACING * RATIO ** coarser:.3g} mm, {mesh.size()}"
        for k, depth in enumerate(DEPTHS):
            quantity = f"force, {where}, `{law}`, d = {1e3 * depth:g} mm [N]"
            beside = {"": (dimitriadis(depth), DIMITRIADIS)} if thickness == LAYER else {
                "": (hertz(depth), HERTZ), ", ball's own shape": (sneddon(depth), SNEDDON)}
            for what, (formula, source) in beside.items():
                checked = law == "linear" and coarser == 0 and depth <= 0.2 * RADIUS
                limit = bound(depth, formula, thickness, [v[k] for v in found]) if checked else None
                rows.append(Row(CASE, size, ELEMENT, quantity + what, f[k], formula, source, limit))
    figures = [] if context.quick else [_plot(context, forces)]
    return Section("A ball pressed into a half space and into a layer", TEXT, rows, figures,
                   [rows_table(rows)])


TEXT = (f"A frictionless ball, R = {1e3 * RADIUS:g} mm, is lowered into soft tissue, E = {YOUNG / 1e3:g} kPa, "
        f"nu = {POISSON:g}, by `palpate replay`: the cycle that the hand feels, with its contact search, its "
        "penalty and its iterative solver, lowered in steps and held until the tissue rests, and solved "
        "until no node would move by more than a nanometre: the default of 10 um leaves 3 % in the force of "
        "0.03 N at d = 1 mm, 0.5 % at 2 mm. The half "
        f"space is a cylinder of {1e3 * SIZE:g} mm; the layer is {1e3 * LAYER:g} mm thick and bonded to the "
        "ground. Hertz's formula takes small strains and a parabola in the place of the ball, which is "
        "too stiff once d is not small beside R: at d = R/2 the ball's own shape gives 5 % less. Both "
        "formulas are those of linear elasticity, so the bound applies to the law `linear`; "
        "`neo_hookean` shows what finite strain makes of it. Beyond d = R/5 no formula holds: all three take "
        "the pressure for vertical, while at d = R/2 the ball's side leans by 40 degrees and pushes the "
        "tissue outwards. What palpate gives there is shown without a bound.")


def _plot(context, forces):
    fig, axis = figure()
    d = np.linspace(1e-5, 5.2e-3, 100)
    axis.plot(1e3 * d, hertz(d), "--", color=COLOUR["reference"], label="Hertz")
    axis.plot(1e3 * d, [sneddon(x) for x in d], color=COLOUR["reference"], label="Sneddon, ball's own shape")
    axis.plot(1e3 * d, dimitriadis(d), ":", color=COLOUR["tet10"], label=f"Dimitriadis, {1e3 * LAYER:g} mm layer")
    style = {("linear", SIZE): ("o", COLOUR["anp"]), ("linear", LAYER): ("s", COLOUR["tet10"]),
             ("neo_hookean", SIZE): ("x", COLOUR["tet4"])}
    for (law, thickness), found in forces.items():
        f = found[-1]
        marker, colour = style[law, thickness]
        where = "half space" if thickness == SIZE else "layer"
        axis.plot([1e3 * x for x in DEPTHS], f, marker, color=colour, label=f"palpate, {where}, {law}")
    axis.set(xlabel="depth d [mm]", ylabel="force [N]")
    axis.legend()
    return save(fig, context.images, "hertz.svg"), "Force on the ball over its depth"
