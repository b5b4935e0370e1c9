# SPDX-License-Identifier: GPL-3.0-or-later
"""D1 to D4: the system that the package carries on from, at its sizes and beside what came after it."""

import subprocess

import numpy as np
import yaml

from accuracy import plots
from accuracy.rows import table as table_of
from accuracy.solve import ROOT, Failed, program, read_table

from .program import figures
from .rows import Row, section

MU, KAPPA = 2000.0, 5800.0 / (3 * (1 - 2 * 0.45))  # [Pa], of the scenes' liver
LAWS = {
    "linear": ("linear", {"young_modulus": 5.8e3, "poisson_ratio": 0.45}),
    "St Venant-Kirchhoff": ("st_venant_kirchhoff", {"young_modulus": 5.8e3, "poisson_ratio": 0.45}),
    "neo-Hooke": ("neo_hookean", {"young_modulus": 5.8e3, "poisson_ratio": 0.45}),
    "Mooney-Rivlin, b1 = b2": ("mooney_rivlin", {"c10": MU / 4, "c01": MU / 4, "kappa": KAPPA}),
    "Yeoh, C1 = C2 = C3": ("yeoh", {"c1": MU / 2, "c2": MU / 2, "c3": MU / 2, "kappa": KAPPA}),
}
KIND = {"linear": "linear", "St Venant-Kirchhoff": "geometrically nonlinear"}
COLOUR = ["#8c8c8c", "#1f4e79", "#b5322a", "#3a7d44", "#8a5a00"]
COARSE, FINE = 0.1, 0.022  # edge_length of the two scenes [m]
BEGIN, SPEED, STEP = 0.108, 0.025, 0.01  # of the tip: z [m], down [m/s]; of a cycle [s]
WAY, FAR = 0.019, 0.034  # down, for methods and for laws [m]
AT = (-0.035, 0.0)  # where it goes down [m]
SHALLOW, DEEP = 0.005, 0.010  # depths of the table [m]
TOLERANCES = (0.3, 0.1, 0.03, 0.01, 1e-3, 1e-6)

TEXT = """The system that this package carries on from computes a cycle like this: the segment that is the tool is met
with the surface; where it meets a vertex, an edge or a face, displacements are prescribed; u_u = K_uu^-1 (f_u - K_uk u_k)
is solved by BiCGSTAB within Newton-Raphson's iteration; f_k = K_kk u_k + K_ku u_u (printed with a minus, (7.4)), of a
nonlinear body the internal forces, is the tool's. `contact.model: prescribed` with `method: newton_bicgstab` is that, with
what the print leaves open or wrong decided in [methods.md](../methods.md#with-a-segment-as-tool): the point is held and not its
nodes, a tool does not pull, and laws are stress-free at rest, W = C1 (I1bar - 3) + ... + kappa/2 (J - 1)^2, which
(4.50) to (4.55) are not. In the second Mooney-Rivlin constant S = 2 (b1 + 2 b2 (1 + tr E)) I - 4 b2 E, before the
volumetric part.

Below a stylus goes 25 mm/s straight down into the liver of `config/scenes/interface_2011.yaml`, E = 5.8 kPa, nu = 0.45, in
cycles of 10 ms, one thread. Depths count from where each mesh is touched first. Times are of cycles that touch, all of
which move. The converged force is that of `anp` elements under the default contact with a rounded tip of 2 mm, on edges of
{truth:g} mm about it ({coarser_off:+.0f} % on {coarser:g} mm, both 5 mm deep).

*Use it* to compare with that system, or where one point pulls or pushes a body of large faces. *Do not* where a force must
be right: a point has no area, so the force is that of the mesh, and on finer meshes it falls towards none; the default
method on the same mesh is nearer, on 516 nodes {quicker:.0f} times as fast, and converges. Nor with a tool of which more
than an end or one place of the side touches, friction, bone, a second organ or tool."""
LAWS_TEXT = """**Linear, geometrically and materially nonlinear**, as in its chapter 6: laws with the same moduli at rest,
mu = 2 kPa, under the same point. The constants beyond these are ours. The source finds that the models differ
so much that at least geometric nonlinearity is needed (6.2, 8.1). Under a tool that presses they part by a tenth
within 10 mm and by half within 20 mm; but geometric nonlinearity alone, St Venant-Kirchhoff, softens where tissue stiffens, and on the
finer mesh elements turn inside out."""
WHY_TIME = "its machine of 2011, a core of this machine here"
WHY_ITERATIONS = "to a residual of a tenth; the one asked for there is not given"


def write_motion(folder, way):
    times = np.arange(0.0, way / SPEED + 0.5 * STEP, STEP)
    zero = 0.0 * times
    rows = np.column_stack([times, zero + AT[0], zero + AT[1], BEGIN - SPEED * times - 0.25, zero, zero, zero])
    file = folder / "motion.csv"
    np.savetxt(file, rows, delimiter=",", header="t,x,y,z,roll,pitch,yaw", comments="", fmt="%.9g")
    return file, rows[:, 3] + 0.25


def write_scene(folder, organ, contact, solver):
    """The shipped scene with this in the place of its own."""
    source = ROOT / "config/scenes/interface_2011.yaml"
    scene = yaml.safe_load(source.read_text(encoding="utf-8"))
    scene["organs"][0].update(surface=str(ROOT / "config/organs/liver.obj"))
    scene["organs"][0].update(organ)
    scene["instruments"][0]["urdf"] = str(ROOT / "config/instruments/stylus.urdf")
    if contact is not None:
        scene["contact"] = contact
    scene["solver"].update(solver)
    file = folder / "scene.yaml"
    file.write_text(yaml.safe_dump(scene, sort_keys=False), encoding="utf-8")
    return file


class Press:
    """Of one variant: depth [m], force [N] and ms of the cycles that touch, linear iterations in a step of Newton's."""

    def __init__(self, context, name, organ, contact=None, solver=None, way=WAY):
        folder = context.work / "interface" / "".join(c for c in name if c.isalnum() or c == ".")
        folder.mkdir(parents=True, exist_ok=True)
        motion, z = write_motion(folder, way)
        out = folder / "replay.csv"
        command = [program(), "replay", write_scene(folder, organ, contact, solver or {}), "--trajectory", motion,
                   "--out", out, "--threads", "1"]
        done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if done.returncode not in (0, 1):  # 1: cycles that did not converge
            raise Failed(done.stderr.strip() or f"palpate replay: status {done.returncode}")
        rows = read_table(out)

        def column(key):
            return np.array([float(r[key]) for r in rows])
        good = np.array([r["status"] == "converged" for r in rows])
        touches = column("contacts") > 0
        first = int(np.argmax(touches))
        self.unsolved = int((~good[first:]).sum())
        self.depth = (z[first - 1] - z)[touches & good]
        self.force = column("fz")[touches & good]
        self.ms = column("step_ms")[touches & good]
        newton = column("newton_iterations")[touches & good]
        self.newton = newton.mean()
        self.iterations = column("cg_iterations")[touches & good].sum() / max(1.0, newton.sum())
        self.nodes = int(column("nodes")[first])
        self.least = column("min_jacobian").min()
        context.progress(f"interface: {name}")

    def at(self, depth):
        return np.interp(depth, self.depth, self.force) if self.depth[-1] >= depth else np.nan


def liver(edge, element="tet4", **more):
    return {"edge_length": edge, "element": element, **more}


def default(integrator="static"):
    return {"method": "implicit_pcg", "integrator": integrator}


def variants(quick):
    """Name, Press arguments; the first two are the published system."""
    plain = {"organs": False}
    found = [("segment, 150 tetrahedra", (liver(COARSE),)), ("segment, 516 nodes", (liver(FINE),))]
    if quick:
        return found[:1]
    found += [(f"segment, edges of {1e3 * edge:g} mm", (liver(edge),)) for edge in (0.045, 0.016)]
    for edge, size in ((COARSE, "150 tetrahedra"), (FINE, "516 nodes")):
        found += [(f"surface points, {size}", (liver(edge), plain)),
                  (f"`implicit_pcg`, `tet4`, {size}", (liver(edge), plain, default())),
                  (f"`implicit_pcg`, `anp`, {size}", (liver(edge, "anp"), plain, default()))]
    found += [("`implicit_pcg`, `anp`, adapted to 2 mm", (liver(FINE, "anp", adapt={"finest": 0.002}), plain, default()))]
    return found


def truth(context):
    finest = (0.008, 0.006) if context.quick else (0.0007, 0.0005)
    return finest, [Press(context, f"truth {f:g}", liver(FINE, "anp", adapt={"finest": f}), {"organs": False}, default())
                    for f in finest]


def number(value, form):
    return format(value, form) if np.isfinite(value) else "-"


def methods_table(measured, right):
    def off(run, depth):
        return number(100 * (run.at(depth) / right.at(depth) - 1), "+.0f")
    lines = [[name, str(r.nodes), f"{np.median(r.ms):.2f}", f"{np.percentile(r.ms, 99):.1f}",
              f"{1e3 / np.mean(r.ms):.0f}", f"{r.newton:.1f}", f"{r.iterations:.1f}", number(r.at(SHALLOW), ".3f"),
              off(r, SHALLOW), number(r.at(DEEP), ".3f"), off(r, DEEP), f"{r.least:.2f}", str(r.unsolved)]
             for name, r in measured.items()]
    return table_of(["contact, mesh", "nodes", "ms: median", "p99", "cycles a second", "Newton steps",
                     "linear iterations each", "5 mm deep [N]", "off [%]", "10 mm deep [N]", "off [%]", "least det F",
                     "not solved"], lines)


def tracking_table(found):
    lines = [[f"{s['triangles']:.0f}", f"{1e6 * s['fit']:.1f}", f"{1e6 * s['query']:.2f}", f"{1e6 * s['walk']:.2f}",
              f"{s['steps']:.2f}", f"{s['query'] / s['walk']:.1f}", f"{(s['fit'] + s['query']) / s['walk']:.0f}",
              f"{s['other']:.0f}"] for s in found]
    return table_of(["triangles", "tree fitted [us]", "tree asked [us]", "walk [us]", "edges crossed", "asked / walk",
                     "fitted and asked / walk", "other triangle"], lines)


def iterations_table(solved):
    return table_of(["linear_tolerance", *(f"{size}: iterations, Newton steps, ms" for size in solved)],
                    [[f"{tolerance:g}", *(f"{runs[tolerance].iterations:.1f}, {runs[tolerance].newton:.1f}, "
                                          f"{np.median(runs[tolerance].ms):.2f}" for runs in solved.values())]
                     for tolerance in TOLERANCES])


def laws_table(curves):
    lines = []
    for size, runs in curves.items():
        straight = runs["linear"]
        for law, r in runs.items():
            forces = [number(r.at(d), ".3f") for d in (0.005, 0.010, 0.020)]
            parts = [number(r.at(d) / straight.at(d), ".2f") for d in (0.005, 0.010, 0.020)]
            lines.append([size, law, KIND.get(law, "materially nonlinear"), *forces, *parts,
                          f"{1e3 * r.depth[-1]:.1f}", f"{r.least:.2f}", str(r.unsolved)])
    return table_of(["liver", "law", "", "5 mm [N]", "10 mm [N]", "20 mm [N]", "over linear", "10 mm", "20 mm",
                     "solved to [mm]", "least det F", "not solved"], lines)


def picture(context, curves):
    fig, axes = plots.figure(max(2, len(curves)), width=9.0, height=3.8)
    for ax, (size, runs) in zip(axes, curves.items()):
        for (law, r), colour in zip(runs.items(), COLOUR):
            ax.plot(1e3 * r.depth, r.force, color=colour, label=law, linestyle="--" if law == "linear" else "-")
        ax.set(xlabel="depth [mm]", title=size)
    axes[0].set(ylabel="force [N]")
    axes[0].legend(fontsize=8)
    return plots.save(fig, context.images, "interface.svg")


def run(context):
    found = figures(context, "tracking")["surfaces"]
    finest, (coarser, right) = truth(context)
    measured = {name: Press(context, name, *arguments) for name, arguments in variants(context.quick)}
    sizes = {"150 tetrahedra": COARSE} if context.quick else {"150 tetrahedra": COARSE, "516 nodes": FINE}
    curves = {size: {law: Press(context, f"{size} {law}", liver(edge, material={"law": word, **constants,
                                                                                "density": 1060.0}), way=FAR)
                     for law, (word, constants) in LAWS.items()} for size, edge in sizes.items()}
    solved = {size: {tolerance: Press(context, f"{size} {tolerance:g}", liver(edge), solver={"linear_tolerance": tolerance})
                     for tolerance in TOLERANCES} for size, edge in sizes.items()}
    most = max(found, key=lambda surface: surface["triangles"])
    rows = [Row(f"D1 triangles asked in a cycle, of {most['triangles']:.0f}", "drastically fewer than by the tree", "7.4",
                1.0 + most["steps"], "0.25 mm a cycle on edges of 2.5 mm")]
    for size, name in zip(sizes, measured):
        r = measured[name]
        rows += [Row(f"D2 ms of a cycle, {size}", 10.0, "7", np.median(r.ms), WHY_TIME),
                 Row(f"D3 iterations of BiCGSTAB, {size}", 18.5, "7: 17 to 20", r.iterations, WHY_ITERATIONS)]
    fine, rival = "segment, 516 nodes", "`implicit_pcg`, `anp`, 516 nodes"
    quicker = np.mean(measured[fine].ms) / np.mean(measured[rival].ms) if fine in measured else np.nan
    text = TEXT.format(truth=1e3 * finest[1], coarser=1e3 * finest[0], quicker=quicker,
                       coarser_off=100 * (coarser.at(SHALLOW) / right.at(SHALLOW) - 1))
    text += (f"\n\n{methods_table({**measured, 'converged': right}, right)}\n\n"
             "Iterations of BiCGSTAB in a step of Newton's, by the part of its residual that is left:\n\n"
             f"{iterations_table(solved)}\n\n"
             "**Walk and tree.** A tool 8 mm below the top of livers of several sizes goes about a circle of 15 mm, 0.25 mm\n"
             "a cycle. The tree keeps its boxes where the surface moves, if they are fitted to it before they are asked:\n\n"
             f"{tracking_table(found)}\n\n{LAWS_TEXT}\n\n{laws_table(curves)}")
    return section("D: the published interface (Castillo Leon 2011, ch. 6, 7)", text, rows,
                   [(picture(context, curves), "Force over depth of five laws, on two meshes")])
