# SPDX-License-Identifier: GPL-3.0-or-later
"""Every model under the same tool: time of a cycle over error of the force, beside finite elements."""

import dataclasses

import numpy as np
from accuracy import plots
from accuracy.rows import table as table_of

from .scene import STEP, Replay, material

# t [s], x, z [mm] of the ball above where it would touch.
PRESS = [(0, 0, 2), (0.1, 0, 2), (0.5, 0, -3), (0.8, 0, -3), (1.6, 20, -3), (1.8, 20, -3), (2.0, 20, 5)]
DEEP = [(0, 0, 2), (0.1, 0, 2), (1.1, 0, -10), (1.3, 0, -10)]
PRESSED, SLID = (0.1, 0.8), (0.8, 1.8)  # [s]
SWAY = {"mass": 20.0}
EDGES = (0.010, 0.006, 0.004)  # [m]
REFERENCE = (0.001, 0.0007)  # adapt.finest of the reference and of its finer one [m]
MARK = {"fem": "o", "mass_spring": "s", "tensor_mass": "^", "hybrid": "<", "sampled_elasticity": "D",
        "honeycomb": "p", "bem": "*", "enriched": "X"}
COLOUR = ["#1f4e79", "#6b9ac4", "#444444", "#b5322a", "#d98880", "#8a5a00", "#7b4aa0", "#3a7d44", "#00807a", "#aa3377",
          "#c29a00", "#8c8c8c", "#5b2c6f", "#d35400"]

TEXT = """A ball of 5 mm presses a block 100 x 100 x 30 mm on a table 3 mm deep, slides 20 mm and leaves; a second time it
goes 10 mm deep. E = 10 kPa, nu = 1/4, steps of 5 ms, one thread, settings as shipped but for what the table names. Errors
are of the force against the converged one: that of neo-Hookean `anp` elements with edges of 0.7 mm around the ball
({held:.3f} N pressed, {deep:.3f} N deep; edges of 1 mm give {held_off:+.1f} % and {deep_off:+.1f} %), root mean square
over pressing and holding and over the slide, as a part of the largest there; 10 mm deep at the end. Times are of cycles in
which the tool touches. *As long as*: error in the press over that of `anp` elements that take as long (on or between the
meshes of the table). Models that are linear are off 10 mm deep whatever their mesh. Springs stand for nu = 1/4.
`honeycomb` is incompressible and takes of the material E alone: its truth, and that of the elements above it, has nu =
0.49 ({held_49:.3f} and {deep_49:.3f} N)."""


@dataclasses.dataclass
class Variant:
    name: str
    organ: dict
    mesh: str
    solver: dict = dataclasses.field(default_factory=dict)
    nu: float = 0.25


def on_edges(name, organ, solver=None, edges=EDGES):
    return [Variant(name, {**organ, "edge_length": edge}, f"{1e3 * edge:g} mm", solver or {}) for edge in edges]


def variants():
    springs = {"model": "mass_spring"}
    found = on_edges("`fem`, `anp`", {})
    found += [Variant("`fem`, `anp`, adapted", {"edge_length": 0.01, "adapt": {"finest": finest}},
                      f"10 mm to {1e3 * finest:g} mm") for finest in (0.004, 0.002)]
    found += on_edges("`fem`, `tet4`", {"element": "tet4"})
    found += on_edges("`fem`, `linear_precomputed`", {"element": "tet4"}, {"method": "linear_precomputed"}, EDGES[:2])
    found += on_edges("`mass_spring`", springs)
    found += on_edges("`mass_spring`, fitted", {**springs, "springs": {"constants": "fitted"}})
    found += on_edges("`mass_spring`, symplectic Euler", {**springs, "springs": {"scheme": "symplectic_euler"},
                                                          "damping": SWAY})
    found += on_edges("`tensor_mass`", {"model": "tensor_mass"})
    region = {"box": {"min": [-0.015, -0.015, 0.015], "max": [0.035, 0.015, 0.031]}}  # below the way of the ball
    found += on_edges("`hybrid`", {"model": "hybrid", "hybrid": {"region": region}}, edges=EDGES[:2])
    found += on_edges("`bem`", {"model": "bem"}, edges=(0.010, 0.0085, 0.007))
    found += [Variant("`sampled_elasticity`", {"model": "sampled_elasticity", "edge_length": 0.006,
                                               "sampling": {"coarsest": coarsest, "levels": 2},
                                               "damping": {**SWAY, "stiffness": 1e-3}},
                      f"particles {1e3 * coarsest:g} mm apart, half that where it bends") for coarsest in (0.01, 0.005)]
    fine = {"triangles": 600, "splits": 1, "samples": 30, "force": 0.5}
    found += on_edges("`enriched`", {"model": "enriched", "enriched": fine}, edges=EDGES[:2])
    found += on_edges("`fem`, `anp`, nu = 0.49", {}, edges=EDGES[:2])
    found += [Variant("`honeycomb`", {"model": "honeycomb", "edge_length": 0.01,
                                      "honeycomb": {"cell_size": size, "volume": "exact"}},
                      f"cells of {1e3 * size:g} mm")
              for size in (0.01, 0.006, 0.005)]
    for variant in found:
        if "0.49" in variant.name or variant.organ.get("model") == "honeycomb":
            variant.nu = 0.49
    return found


def folder(context, *words):
    return context.work / "touched" / "_".join("".join(c for c in w if c.isalnum() or c == ".") for w in words)


class Truth:
    """The converged force of a material."""

    def __init__(self, context, nu):
        def run(finest, waypoints, word):
            organ = {"edge_length": 0.012 if context.quick else 0.006, "adapt": {"finest": finest},
                     "material": material(nu)}
            return Replay(folder(context, "reference", word, f"{nu:g}", f"{finest:g}"), organ, waypoints)
        finest = (0.009, 0.008) if context.quick else REFERENCE
        coarser, self.press = (run(f, PRESS, "press") for f in finest)
        coarser_deep, self.deep = (run(f, DEEP, "deep") for f in finest)
        held = self.press.within(PRESSED[1] - 0.1, PRESSED[1])
        self.held = self.press.force[held, 2].mean()
        self.held_off = coarser.force[held, 2].mean() / self.held - 1
        self.deep_off = coarser_deep.force[-1, 2] / self.deep.force[-1, 2] - 1


def rms(replay, truth, phase):
    during = truth.within(*phase)
    off = np.linalg.norm(replay.force[during] - truth.force[during], axis=1)
    return np.sqrt(np.mean(off ** 2)) / np.linalg.norm(truth.force[during], axis=1).max()


def measure(context, variant, truth):
    organ = {**variant.organ, "material": material(variant.nu)}
    press = Replay(folder(context, variant.name, variant.mesh, "press"), organ, PRESS, variant.solver)
    deep = Replay(folder(context, variant.name, variant.mesh, "deep"), organ, DEEP, variant.solver)
    ms = press.ms[press.touches]
    context.progress(f"{variant.name}, {variant.mesh}")
    return {"name": variant.name, "mesh": variant.mesh, "nu": variant.nu, "nodes": press.nodes, "median": np.median(ms),
            "p99": np.percentile(ms, 99), "press": rms(press, truth.press, PRESSED),
            "slide": rms(press, truth.press, SLID),
            "held": press.force[press.within(PRESSED[1] - 0.1, PRESSED[1]), 2].mean(),
            "deep": deep.force[-1, 2] / truth.deep.force[-1, 2] - 1, "least": deep.least,
            "unsolved": int((~press.good).sum()), "unsolved_deep": int((~deep.good).sum())}


def as_long(row, elements):
    """Error over that of the elements that take as long, or nothing where none does."""
    times, errors = np.log([e["median"] for e in elements]), np.log([e["press"] for e in elements])
    order = np.argsort(times)
    if not times.min() <= np.log(row["median"]) <= times.max():
        return "faster than all" if np.log(row["median"]) < times.min() else "slower than all"
    return f"{row['press'] / np.exp(np.interp(np.log(row['median']), times[order], errors[order])):.1f}"


def best(measured):
    """Of each model the least error pressed among its meshes whose cycle takes no longer than its step, over that of
    the finite elements of the same material."""
    real_time = [r for r in measured if r["median"] <= 1e3 * STEP]
    lines = []
    for name in dict.fromkeys(r["name"] for r in measured):
        rows = [r for r in real_time if r["name"] == name]
        row = min(rows, key=lambda r: r["press"], default=None)
        if not row:
            lines.append([name, "none is", "-", "-", "-"])
            continue
        rivals = [r for r in real_time if r["name"].startswith("`fem`, `anp`") and r["nu"] == row["nu"]]
        times = row["press"] / min(r["press"] for r in rivals)
        lines.append([name, row["mesh"], f"{row['median']:.2f}", f"{100 * row['press']:.0f} %", f"{times:.1f}"])
    return table_of(["model", "best mesh in real time", "ms", "press", "over the best elements"], lines)


def table(measured, elements):
    def percent(x):
        return f"{100 * x:.0f} %"

    def unsolved(row):
        return f"{row['unsolved']} / {row['unsolved_deep']}"
    return table_of(
        ["model", "mesh", "nodes", "ms: median", "p99", "over real time", "press", "slide", "held [N]", "as long as",
         "10 mm deep", "least det F", "cycles not solved, press / deep"],
        [[r["name"], r["mesh"], str(r["nodes"]), f"{r['median']:.2f}", f"{r['p99']:.1f}",
          f"{1e-3 * r['median'] / STEP:.2f}", percent(r["press"]), percent(r["slide"]), f"{r['held']:.3f}",
          as_long(r, elements), f"{100 * r['deep']:+.0f} %", f"{r['least']:.2f}", unsolved(r)] for r in measured])


def picture(context, measured):
    fig, axes = plots.figure(3, width=10.0, height=4.0)
    names = list(dict.fromkeys(r["name"] for r in measured))
    assert len(names) <= len(COLOUR)
    for ax, phase in zip(axes, ("press", "slide")):
        for name, colour in zip(names, COLOUR):
            rows = [r for r in measured if r["name"] == name]
            mark = next(m for word, m in [*MARK.items(), ("", "v")] if word in name)
            ax.loglog([r["median"] for r in rows], [100 * r[phase] for r in rows], "-" + mark, color=colour,
                      label=name.replace("`", ""))
        ax.axvline(1e3 * STEP, color="#999999", linestyle=":")
        ax.set(xlabel="median cycle in contact [ms]", title=phase)
    most = 120.0 * max(max(r["press"], r["slide"]) for r in measured)
    least = 80.0 * min(min(r["press"], r["slide"]) for r in measured)
    for ax in axes[:2]:
        ax.set_ylim(least, most)
    axes[0].set(ylabel="error of the force, RMS [%]")
    axes[2].axis("off")
    axes[2].legend(*axes[0].get_legend_handles_labels(), loc="center left", fontsize=8)
    return plots.save(fig, context.images, "touched.svg")


def figures(context):
    """All that is measured, once a run: it is asked for by two parts of the page."""
    if not hasattr(context, "touched"):
        truths, measured = {}, []
        chosen = [v for v in variants() if not context.quick or v.mesh.endswith("10 mm")]
        for variant in chosen:
            if variant.nu not in truths:
                truths[variant.nu] = Truth(context, variant.nu)
            measured.append(measure(context, variant, truths[variant.nu]))
        context.touched = measured, truths
    return context.touched


def run(context):
    measured, truths = figures(context)
    truth = truths[0.25]
    elements = [r for r in measured if r["name"].startswith("`fem`, `anp`") and "0.49" not in r["name"]]
    stiff = truths.get(0.49, truth)
    text = TEXT.format(held=truth.held, deep=truth.deep.force[-1, 2], held_off=100 * truth.held_off,
                       deep_off=100 * truth.deep_off, held_49=stiff.held, deep_49=stiff.deep.force[-1, 2])
    return (f"### Under a tool\n\n{text}\n\n![Time of a cycle over error of the force]"
            f"(images/models/{picture(context, measured)})\n\n{table(measured, elements)}\n\n"
            "The best of each model's meshes on which a cycle takes no longer than it simulates, and how many times\n"
            f"the error of the best elements there, of the same material, it has:\n\n{best(measured)}\n")
