# SPDX-License-Identifier: GPL-3.0-or-later
"""Two layers of skin on bone: a published fit, computed anew."""

import re
import subprocess

import matplotlib.collections
import numpy as np
from accuracy import plots
from accuracy.rows import table as table_of
from accuracy.solve import Failed, program, read_table

from .rows import Row, rows_table

WIDTH, HEIGHT = 12.0, 4.5  # [mm]
VARIANTS = ["plane_stress_published", "plane_stress", "plane_strain", "axisymmetric"]
MESHES = [(16, 6), (32, 12), (64, 24)]
RATIOS = [2 ** (k / 16) for k in range(145)]  # 1 to 512; for a quick look every 16th
CRITERIA = {"larger of both": lambda a, b: np.maximum(a, b), "sum": lambda a, b: a + b,
            "weighted by readings, 0.6 and 0.4": lambda a, b: 0.6 * a + 0.4 * b}
SOLVED = r"solved in (\S+) ms"
ABOVE = "larger, all nodes above the bone"
ACCEPTABLE = 1.1  # times the least
SOURCE = "[Triantafyllopoulos 2005]"
COLOURS = ["#1f4e79", "#b5322a", "#3a7d44", "#8a5a00", "#7b4aa0"]
TEXT = """**Idea.** Skin and the fat below it, on bone, are two flat layers of a plane block, 12 x 4.5 mm, fixed below and at
its sides. A needle presses one node in the middle of the top down by a given depth; the surface around it is compared
with two digitised profiles of a primate's fingertip under a line load [Srinivasan 1989], which gives two parameters:
the upper layer's part of the height, and how much stiffer it is. `palpate skin` computes it, room `skin` has it.

**Equations** (see [theory.md](../theory.md#two-layers-of-skin)). Triangles of constant strain, K_e = B^T D B t A, with D =
E/(1 - nu^2) [[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu)/2]], E of the upper layer, E/ratio in the lower one. The print has 1 +
nu^2, and its program leaves out t A: shapes under a given depth stay, forces do not. The tables' errors are sqrt(sum
e^2)/n over n readings, not the mean square that the text gives. The depth that the curve is pinned with, at the reading
nearest to the needle, is corrected twice, from where the figure before left it; those of the other tables here are
converged.

**Parameters.** E = 0.2 MPa, nu = 0.48 for both layers, for which the source gives no reason; fraction 0.5 and ratio 10 are
its result.

**When to use it.** For a shape under a small depth, in microseconds once solved: everything is linear, so a depth scales one
solution. Not for forces of a needle: a point sinks for ever as the mesh is refined, and a plane has no point. Not for both
profiles at once: in a linear model they are proportional, in the readings they are not (at 1, 2 and 3 mm 0.75, 0.51 and
0.32 of the depth at 0.25 mm in one, 0.63, 0.34 and 0.19 in the other). That needs large strains, in the part after this."""


class Block:
    """What `palpate skin` says of one block: sets, profiles, sweep."""

    def __init__(self, folder, *options):
        done = subprocess.run([program(), "skin", "--out", str(folder), *map(str, options)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            raise Failed(done.stderr.strip() or f"palpate skin {options}: {done.stdout[-300:]}")
        self.folder, self.said = folder, done.stdout
        sets = re.findall(r"set \d, \d mm +(\S+) +(\S+) +(\S+) +(\S+) +(\S+)", done.stdout)
        self.depth, self.error, self.rms, self.largest, self.force = np.array(sets, float).T if sets else [[]] * 5

    def number(self, pattern):
        return float(re.search(pattern, self.said).group(1))

    def per_mm(self):
        return self.number(r"ms, (\S+) N by mm")

    def table(self, name):
        rows = read_table(self.folder / f"{name}.csv")
        return {key: np.array([float(r[key]) for r in rows]) for key in rows[0]}

    def sweep(self):
        """Fractions, ratios, and errors of both sets, (2, fractions, ratios) [mm]."""
        found = self.table("sweep")
        fractions, ratios = np.unique(found["fraction"]), np.unique(found["ratio"])
        return fractions, ratios, found["published_error_mm"].reshape(2, len(fractions), len(ratios))

    def below_the_bone(self):
        """Whether a node is, at the larger depth, (fractions, ratios)."""
        found, (fractions, ratios, _) = self.table("sweep"), self.sweep()
        return (found["depth"] > found["bone_depth"]).reshape(2, len(fractions), len(ratios)).any(axis=0)


def published(context):
    """A table of how many printed figures are met."""
    block = Block(context.work / "skin_published", "--published")
    rows, lines = read_table(block.folder / "published.csv"), []
    for table in sorted({r["table"] for r in rows}):
        for which in ("1", "2"):
            part = [r for r in rows if r["table"] == table and r["set"] == which]
            off = max(abs(float(r["ours"]) / float(r["printed"]) - 1) for r in part)
            ratios = [float(r["el_f"]) for r in part]
            lines.append([table, which, f"{part[0]['nx']} x {part[0]['nz']}", f"{min(ratios):g} to {max(ratios):g}",
                          len(part), f"{off:.1e}"])
    return block.number(r"(\d+) of 576"), table_of(
        ["table", "set", "squares", "ratios", "figures", "largest difference, of the print"], lines)


def best_of(block):
    """By criterion: fraction, ratio, both errors, how many points are acceptable, of how many, and whether a node is below
    the bone."""
    fractions, ratios, errors = block.sweep()
    below, found = block.below_the_bone(), {}
    for name, value in [*((name, criterion(*errors)) for name, criterion in CRITERIA.items()),
                        (ABOVE, np.where(below, np.inf, np.maximum(*errors)))]:
        i, j = np.unravel_index(value.argmin(), value.shape)
        found[name] = (fractions[i], ratios[j], errors[0, i, j], errors[1, i, j],
                       int((value <= ACCEPTABLE * value.min()).sum()), value.size, below[i, j])
    return found


def ratios_of(context):
    return ",".join(f"{r:.6g}" for r in RATIOS[::16 if context.quick else 1])


def optima(context):
    lines, blocks, where = [], {}, []
    for nx, nz in MESHES[:2] if context.quick else MESHES:
        block = blocks[nx] = Block(context.work / f"skin_{nx}", "--mesh", f"{nx}x{nz}", "--ratios", ratios_of(context))
        lines.append([f"{nx} x {nz}", "as published", "1/2", "10", f"{block.error[0]:.4f}", f"{block.error[1]:.4f}", "", ""])
        for name, (fraction, ratio, a, b, count, size, below) in best_of(block).items():
            lines.append([f"{nx} x {nz}", name, f"{round(fraction * nz)}/{nz}", f"{ratio:.3g}", f"{a:.4f}", f"{b:.4f}",
                          f"{count} of {size}", "below the bone" if below else ""])
            if name == ABOVE:
                where.append(f"{round(fraction * nz)}/{nz} and {ratio:.3g} on {nx} x {nz}")
        context.progress(f"skin: {nx} x {nz} swept")
    return blocks, "; ".join(where), table_of(["squares", "criterion", "fraction", "ratio", "set 1 [mm]",
                                               "set 2 [mm]", f"within {100 * (ACCEPTABLE - 1):.0f} %", "a node"], lines)


def mesh_study(context):
    lines = []
    columns = (16, 32, 64) if context.quick else (16, 32, 64, 128, 256)
    for name, patch in (("a node", 0.0), ("0.375 mm", 0.1875), ("1.5 mm", 0.75)):
        last = None
        for nx in columns:
            if abs(patch * nx / WIDTH - round(patch * nx / WIDTH)) > 1e-9:
                continue
            block = Block(context.work / f"skin_mesh_{nx}", "--mesh", f"{nx}x{3 * nx // 8}", "--ratios", "none", "--patch",
                          1e-3 * patch)
            lines.append([name, f"{nx} x {3 * nx // 8}", f"{block.depth[0]:.3f}", f"{block.depth[1]:.3f}",
                          f"{block.error[0]:.4f}", f"{block.error[1]:.4f}", f"{1e3 * block.per_mm():.2f}",
                          "" if last is None else f"{100 * (block.per_mm() / last - 1):+.1f} %",
                          f"{block.number(SOLVED):.1f}"])
            last = block.per_mm()
    return table_of(["pressed", "squares", "depth 1 [mm]", "depth 2 [mm]", "set 1 [mm]", "set 2 [mm]", "mN by mm",
                     "change", "solved in [ms]"], lines)


def variants(context):
    lines = []
    for variant in VARIANTS:
        block = Block(context.work / f"skin_{variant}", "--variant", variant, "--mesh", "32x12", "--diagonals",
                      "alternating", "--patch", 0.375e-3, "--ratios", ratios_of(context))
        fraction, ratio, a, b, *_ = best_of(block)[ABOVE]
        per = f"{1e3 * block.per_mm():.1f}" + (" in all" if variant == "axisymmetric" else "")
        lines.append([f"`{variant}`", per, f"{block.error[0]:.4f}", f"{block.error[1]:.4f}", f"{round(12 * fraction)}/12",
                      f"{ratio:.3g}", f"{a:.4f}", f"{b:.4f}"])
    return table_of(["variant", "mN by mm", "1/2 and 10: set 1 [mm]", "set 2 [mm]",
                     "least larger one above the bone: fraction", "ratio", "set 1 [mm]", "set 2 [mm]"], lines)


def sweep_figure(context):
    fig, axes = plots.figure(2, nrows=2, width=9.2, height=6.4)
    for row, (ratios, name) in enumerate((("geometric", "1 to 511"), ("linear", "7 to 15"))):
        block = Block(context.work / f"skin_{ratios}", "--ratios", ratios, "--protocol", "published")
        fractions, at, errors = block.sweep()
        for which in range(2):
            for k, fraction in enumerate(fractions):
                axes[row, which].plot(at, errors[which, k], "o-", color=COLOURS[k], label=f"{round(6 * fraction)}/6")
            axes[row, which].set(xlabel=f"ratio, {name}", ylabel="error [mm]", title=f"set {which + 1}")
            if row == 0:
                axes[row, which].set_xscale("log", base=2)
    axes[0, 0].legend(title="upper layer")
    return plots.save(fig, context.images, "skin_sweep.svg")


def region_figure(context, blocks):
    fig, axes = plots.figure(len(blocks), width=4.2 * len(blocks), height=3.6)
    for ax, (nx, block) in zip(axes, blocks.items()):
        fractions, ratios, errors = block.sweep()
        value = np.maximum(*errors)
        levels = np.linspace(0.015, 0.06, 10)
        shown = ax.contourf(ratios, fractions, value, levels, cmap="Blues_r", extend="both")
        i, j = np.nonzero(value <= ACCEPTABLE * value.min())
        ax.plot(ratios[j], fractions[i], ".", color=plots.COLOUR["tet4"], label="within 10 % of the least")
        ax.contourf(ratios, fractions, block.below_the_bone(), [0.5, 1.5], colors="none", hatches=["///"])
        ax.plot(10, 0.5, "+", color="black", markersize=11, markeredgewidth=2, label="as published")
        ax.set(xscale="log", ylim=(0, 1), xlabel="ratio", ylabel="fraction", title=f"{nx} x {3 * nx // 8}")
    axes[0].legend(loc="upper left", frameon=True, fontsize=8)
    fig.colorbar(shown, ax=axes, label="larger error [mm]")
    return plots.save(fig, context.images, "skin_region.svg")


def deformed_figure(context, block):
    """The mesh at both depths; readings; the surface before its depth was corrected."""
    nodes, triangles, profile = block.table("nodes"), block.table("triangles"), block.table("profiles")
    corners = np.stack([triangles[c] for c in "abc"], axis=1).astype(int)
    rest = 1e3 * np.stack([nodes["x"], nodes["z"]], axis=1)
    unit = np.stack([nodes["ux_by_depth"], nodes["uz_by_depth"]], axis=1)
    top = np.flatnonzero(nodes["z"] == 0.0)
    fig, axes = plots.figure(2, width=10.4, height=3.6)
    for k, ax in enumerate(axes):
        x = rest + block.depth[k] * unit
        for layer, colour in ((1, "#f3d9c9"), (2, "#fbf1d3")):
            ax.add_collection(matplotlib.collections.PolyCollection(
                x[corners[triangles["layer"] == layer]], facecolor=colour, edgecolor="#999999", linewidth=0.5))
        start = rest + (1.8, 0.9)[k] * unit
        ax.plot(*start[top].T, ":", color="black", label=f"depth not corrected, {(1.8, 0.9)[k]} mm")
        ax.plot(*x[top].T, color=plots.COLOUR["anp"], label=f"corrected, {block.depth[k]:.2f} mm")
        mine = profile["set"] == k + 1
        for side in (-1, 1):
            ax.plot(0.5 * WIDTH + side * 1e3 * profile["radius"][mine], 1e3 * profile["measured"][mine], "+x"[k],
                    color=plots.COLOUR["tet4"], markersize=7, label="readings" if side < 0 else None)
        ax.set(xlim=(-0.2, WIDTH + 0.2), ylim=(HEIGHT + 0.1, -0.2), aspect="equal", title=f"set {k + 1}", xlabel="x [mm]",
               ylabel="depth [mm]")
        ax.grid(False)
        ax.legend(loc="lower left", fontsize=7, frameon=True)
    return plots.save(fig, context.images, "skin_deformed.svg")


def run(context):
    met, tables = published(context)
    blocks, where, best = optima(context)
    coarse, fine = blocks[16], blocks[32]
    rows = [Row("figures of Tables 3.3, 3.4, 3.6, 3.7, to the last digit", 576, "3.4, 3.6", met, "same protocol"),
            Row("error of set 1, 1/2 and 10, 16 x 6 [mm]", 0.017824, "Table 3.5", coarse.error[0], "converged depth"),
            Row("error of set 2", 0.019866, "Table 3.5", coarse.error[1], "converged depth"),
            Row("error of set 1, 32 x 12 [mm]", 0.0143, "Table 3.8", fine.error[0], "converged depth"),
            Row("error of set 2", 0.0179, "Table 3.8", fine.error[1], "converged depth"),
            Row("depth of set 1, 16 x 6 [mm]", 2.0, "as the experiment is called", coarse.depth[0],
                "what is pressed is a node: see below"),
            Row("depth of set 2", 1.0, "as the experiment is called", coarse.depth[1], "likewise"),
            Row("largest e of set 1 [mm]", "not given", "", coarse.largest[0], ""),
            Row("largest e of set 2 [mm]", "not given", "", coarse.largest[1], "")]
    pictures = [(sweep_figure(context), "Errors over the ratio for each layer, logarithmic above, linear below"),
                (deformed_figure(context, coarse), "Deformed meshes with both sets of readings"),
                (region_figure(context, blocks), "Larger error over fraction and ratio; hatched: nodes are pressed below the bone")]
    shown = [f"\n![{caption}](images/models/{file})\n" for file, caption in pictures]
    return f"""### Two layers of skin on bone {SOURCE}

{TEXT}

{rows_table(rows)}

{tables}
{shown[0]}{shown[1]}
The source finds 1/2 and 10 "independent of subdivision". Thick, stiff upper layers fit both sets
better by pressing nodes through the bone, of which a linear model knows nothing. Without those the larger error is least at
{where}; other criteria choose others. Ratios go by {100 * (RATIOS[1] - 1):.1f} %:

{best}
{shown[2]}
A node that is pressed has no limit; a patch has. Fraction 1/2, ratio 10, a slab of 1 mm, plane stress as published:

{mesh_study(context)}

The ratio is one of plane stress. On 32 x 12 squares with alternating diagonals, pressed over 0.75 mm, for a slab of 1 mm:

{variants(context)}
"""
