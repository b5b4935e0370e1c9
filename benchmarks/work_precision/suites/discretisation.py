# SPDX-License-Identifier: GPL-3.0-or-later
"""What the mesh costs: time of a cycle over the true error of the force, by element and kind of mesh."""

import dataclasses
import math

from accuracy.rows import Section, table

from .. import bracket, converged, norms
from ..charts import work_precision
from ..runs import Config

QUICK = False


@dataclasses.dataclass(frozen=True)
class Scene:
    """A panel of the picture: what is pressed, and which meshes go through it."""
    title: str
    config: Config
    uniform: dict  # {element: values of `size`}
    graded: dict  # {element: edges where the tool goes [m]}
    adapted: dict  # {element: edges where the tool is [m]}
    start: dict  # the coarse mesh that adapts
    size: str = "tets"  # the field of Config that makes a uniform mesh finer

    def limit(self):
        """Arguments of converged()."""
        return self.config.scene, self.config.poisson_ratio, self.config.duration

    def meshes(self):
        """(kind, element, Config), of each kind and element from coarse to fine."""
        for element, values in self.uniform.items():
            for value in values:
                yield "uniform", element, self.config.but(element=element, **{self.size: value})
        for element, values in self.graded.items():
            for value in values:
                yield "graded", element, self.config.but(element=element, finest=value)
        for element, values in self.adapted.items():
            for value in values:
                yield "adapted", element, self.config.but(element=element, adapt=value, **self.start)


# In real time or near it: cycles of 10 ms, default tolerances and contact.
BASE = {"method": "implicit_pcg", "step": 0.01}
ADAPTED_CUBE = {"anp": (0.012, 0.008, 0.006, 0.004, 0.003), "tet10p": (0.015, 0.010)}, {"tets": 384}
CUBE = {"tet4": (1080, 4860, 20250, 48000), "anp": (1080, 4860, 20250, 48000), "tet10": (162, 750),
        "tet10p": (162, 750, 2058)}
SCENES = (
    Scene("cube, nu = 0.45", Config("cube", poisson_ratio=0.45, **BASE), CUBE,
          {"anp": (0.015, 0.010, 0.0075, 0.006), "tet10": (0.015, 0.010), "tet10p": (0.015, 0.010)},
          *ADAPTED_CUBE),
    Scene("cube, nu = 0.499", Config("cube", poisson_ratio=0.499, **BASE), CUBE,
          {"anp": (0.015, 0.010, 0.0075, 0.006), "tet10": (0.015, 0.010), "tet10p": (0.015, 0.010)},
          *ADAPTED_CUBE),
    Scene("liver", Config("liver", duration=4.0, **BASE),
          {"tet4": (0.0225, 0.0155, 0.0103, 0.00775), "anp": (0.0225, 0.0155, 0.0103, 0.00775, 0.0055, 0.004),
           "tet10": (0.030, 0.0225), "tet10p": (0.030, 0.0225)},
          {"anp": (0.010, 0.007, 0.005, 0.004), "tet10": (0.012, 0.008), "tet10p": (0.012, 0.008)},
          {"anp": (0.006, 0.004, 0.003, 0.002, 0.0015), "tet10p": (0.008, 0.006, 0.004)},
          {"edge_length": 0.0155}, size="edge_length"),
    Scene("thin flap", Config("flap", **BASE),
          {"tet4": (360, 2880, 9720, 23040), "anp": (360, 2880, 9720, 23040), "tet10": (360,),
           "tet10p": (360, 1215)},
          {"anp": (0.006, 0.004, 0.003, 0.002), "tet10": (0.008, 0.006),
           "tet10p": (0.008, 0.006)},
          {"anp": (0.004, 0.003, 0.002, 0.0015), "tet10p": (0.008, 0.006)},
          {"tets": 360, "growth": 0.1}))
AT, FASTER = 0.08, 10.0  # error at which kinds are compared, and how much faster adapted meshes should be
FROM = 0.15  # error from which on down adapted meshes should be on the hull


def run(context):
    converged.prepare(context, [scene.limit() for scene in SCENES])
    panels, lines, limits, cases, races = {}, [], [], [], []
    for scene in SCENES:
        limit = converged.converged(context, *scene.limit())
        limits.append([*limit.line(scene.title), converged.beside(context, limit, *scene.limit())])
        panel = panels[scene.title] = {}
        for kind, element, config in scene.meshes():
            run = context.attempt(config, repeats=1, seconds=10.0)
            if run is None:
                continue
            rms, largest = limit.errors(run)
            panel.setdefault(element, []).append((rms, run.step_ms, kind))
            if not run.failed:
                cases.append((f"{scene.title}, {kind} `{element}`, {size(config, run)}", limit.bracket(run)))
            lines.append([scene.title, f"{kind}, `{element}`, {size(config, run)}", int(run.column("nodes").max()),
                          f"{run.step_ms:.2f}", f"{run.median_ms:.2f}", run.p99_text, f"{100 * rms:.1f} %",
                          f"{100 * largest:.1f} %", f"{run.summary['peak_force']:.3f} N",
                          run.summary["failed_cycles"] or ""])
        races.append([scene.title, *race(panel)])
    figure = work_precision(context.images, "discretisation.svg", panels, "mean time of a cycle [ms]",
                            "RMS error against the converged force [%]", join_variants=False)
    return Section("What the mesh costs, by element", TEXT, [],
                   [(figure, "Time of a cycle over the true error of the force")],
                   [RACES + table(["scene", "best uniform", "best graded", "adapted", "times faster than uniform",
                                   f"on the hull from {100 * FROM:g} % down"], races),
                    LIMITS + table([*converged.HEAD, "beside it, RMS"], limits),
                    table(["scene", "mesh", "nodes, at most", "ms a cycle", "median", "p99",
                           "true force error, RMS", "largest", "peak force", "failed cycles"], lines),
                    BRACKETS + bracket.tabled(cases)])


def size(config, run):
    """Of a mesh, in words."""
    edge = config.adapt or config.finest
    return f"{1e3 * edge:g} mm at the tool" if edge else f"{run.summary['tets']} tetrahedra"


def race(panel):
    """What an error of AT costs by each kind of mesh, of its best element, how much faster adapted meshes are, and
    whether nothing that is as good is faster. panel: {element: [(error, cost, kind)]}."""
    found = {}
    for kind in ("uniform", "graded", "adapted"):
        series = {e: [(error, cost) for error, cost, k in points if k == kind] for e, points in panel.items()}
        costs = {e: norms.cost_at(AT, *zip(*points)) for e, points in series.items() if points}
        there = {e: c for e, c in costs.items() if math.isfinite(c)}
        best = min(there, key=there.get, default=None)
        finest = [(error, cost) for points in series.values() for error, cost in points if math.isfinite(error)]
        found[kind] = there.get(best), best, min(finest, default=(math.nan, math.nan))
    texts = [f"{cost:.2f} ms (`{e}`)" if e else f"never; {100 * least[0]:.1f} % for {least[1]:.2f} ms"
             for cost, e, least in found.values()]
    cost, element, _ = found["adapted"]
    if element is None:
        return [*texts, "**missed: never so good**", on_hull(panel)]
    other, beside, least = found["uniform"]
    ratio = (other if beside else least[1]) / cost
    verdict = "reached" if ratio >= FASTER else f"**missed: {FASTER:g} asked for**"
    return [*texts, f"{'' if beside else 'more than '}{ratio:.1f} ({verdict})", on_hull(panel)]


def on_hull(panel):
    """Of the adapted meshes with an error of FROM and less, those that nothing beats."""
    points = [p for series in panel.values() for p in series]
    front = norms.pareto([p[0] for p in points], [p[1] for p in points])
    asked = [i for i, p in enumerate(points) if p[2] == "adapted" and p[0] <= FROM]
    there = len(set(asked) & set(front))
    return f"{there} of {len(asked)}" + ("" if asked and there == len(asked) else " (**missed**)")


TEXT = """The pressed and slid cube, four seconds of the recorded palpation of the liver, and a flap (60 x
40 x 3 mm, E = 50 kPa, held at both ends, pressed 6 mm deep by a ball of 5 mm that then slides), in cycles of
10 ms with default tolerances and contact, one thread. The error is the true one: of mesh, step, tolerance and
contact's samples together, against the converged force. "Uniform" meshes have the same edges everywhere,
"graded" ones short edges where the tool goes, as far as 1.6 of its radii, and 0.3 longer for each unit of
distance beyond; "adapted" ones follow the tool from a coarse mesh on
([meshes.md](../meshes.md#meshes-that-follow-the-tool)), and their times are those of the changes too. Near the
incompressible the plain `tet4` pays for its locking with any number of tetrahedra, and a flap of one layer of linear tetrahedra is two to three times too stiff. Contact's samples are
half a tool's radius apart by default, here 7.5 mm on the cube: between them the tool cuts into the tissue, which
takes some per cent off the force and hides as much of a mesh's stiffness."""

RACES = f"""**What an error of {100 * AT:g} % costs**, mean of a cycle of the best element of each kind, along
the line between the meshes next to it. Adapted meshes should be {FASTER:g} times faster there than the best uniform one and, from
{100 * FROM:g} % down, beaten by nothing.

"""

BRACKETS = """**The error beside the force**, `mesh_error`, where the converged force is largest: an estimate of what the
force is too large by. It knows of the mesh alone; what steps, tolerance and samples do is in the true error too.

"""

LIMITS = """**The converged force** is that of three graded meshes (`anp`; `tet10` for the flap), `bdf2` with
steps of 5 ms, a tolerance of 1e-5 and samples of contact 2.5 mm apart; at each time the two finest are
extrapolated by second order. What this adds to the finest stands beside it: no error below that means much.
Of the cube another element has its say. Where the tool is a ball in a block, such a limit is compared with an
axisymmetric solution of dolfinx in [accuracy.md](accuracy.md#a-ball-pressed-deep-into-a-block).

"""
