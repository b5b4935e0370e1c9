# SPDX-License-Identifier: GPL-3.0-or-later
"""The page docs/results/accuracy.md and the table on the terminal."""

import os
import platform

from .rows import table

INTRODUCTION = """# Accuracy

How far off are the forces and the shapes that palpate computes? Each section below puts a problem
whose answer is known from theory, from a published benchmark or from another program beside what
palpate gives. `scripts/page.sh accuracy` runs everything and writes this page; it fails if an error is
larger than the bound that is written beside it. Nothing on this page was typed in by hand.

**Where the bounds come from.** None comes from the error that it judges. Where meshes are refined it is
Roache's grid convergence index [1994]: 1.25 times what the last refinement changed, divided by r^p - 1, r the ratio
of the elements' sizes and p the least order that theory promises; and beside it what is unknown of the
reference. Elsewhere it is what theory leaves out, the digits of the other program, or rounding. The reason
stands beside each bound in `benchmarks/accuracy/cases`.

"""

WORDS = """
**How to read the tables.** `tet4` is the plain linear tetrahedron, `anp` the linear tetrahedron
with pressure averaged over the nodes, `p1p1` the one with a stabilised pressure at the nodes,
`tet10` the quadratic one, `tet10p` that with pressures at its corners. The error is a part of the reference unless a table says otherwise. A
line without a bound is there for comparison and is not checked. Poisson's ratio says how much a
material resists a change of volume: soft organs, full of water, are near 0.5.
"""


def number(value):
    return f"{value:.6g}"


def percent(error, bound=None):
    """Errors that matter to a hand in per cent, tiny ones as they are."""
    small = abs(error) < 1e-4 and (bound is None or bound < 1e-3)
    return f"{error:.1e}" if small else f"{100 * error:+.2f} %" if bound is None or bound >= 1e-3 \
        else f"{error:.1e}"


def limit(bound):
    return "" if bound is None else f"{100 * bound:.3g} %" if bound >= 1e-3 else f"{bound:g}"


def verdict(row):
    return "" if row.bound is None else "yes" if row.passed else "**NO**"


def rows_table(rows):
    head = ["mesh", "element", "quantity", "palpate", "reference", "error", "bound", "within"]
    return table(head, [[r.mesh, f"`{r.element}`" if r.element else "", r.quantity, number(r.value),
                         number(r.reference), percent(r.error, r.bound), limit(r.bound), verdict(r)]
                        for r in rows])


def _sources(rows):
    names = sorted({r.source for r in rows})
    return "Reference: " + "; ".join(names) + "." if names else ""


def _anchor(title):
    kept = "".join(c for c in title.lower() if c.isalnum() or c in " -_")
    return kept.replace(" ", "-")


def summary(sections):
    lines = []
    for section in sections.values():
        checked = [r for r in section.rows if r.bound is not None]
        if not checked:
            continue
        worst = max(checked, key=lambda r: abs(r.error) / r.bound)
        missed = sum(not r.passed for r in checked)
        lines.append([f"[{section.title}](#{_anchor(section.title)})", len(checked),
                      percent(worst.error, worst.bound), limit(worst.bound),
                      "yes" if missed == 0 else f"**{missed} not**"])
    return table(["case", "checks", "error nearest to its bound", "its bound", "all within"], lines)


NEAR = 0.9  # of a bound


def near_bounds(sections):
    """Who is within 10 % of its bound, in words: what will miss it next."""
    close = [(s, r) for s in sections.values() for r in s.rows
             if r.bound is not None and r.passed and abs(r.error) > NEAR * r.bound]
    if not close:
        return "No figure is within 10 % of its bound.\n"
    lines = [f"- {s.title}: {f'`{r.element}`, ' if r.element else ''}{r.mesh}, {r.quantity}: "
             f"{percent(r.error, r.bound)} of {limit(r.bound)}" for s, r in close]
    return "**Near to a bound.** Each of these is within 10 % of its bound, and the next to miss it:\n\n" + \
        "\n".join(lines) + "\n"


def page(sections, failures, made):
    """The whole page; sections by name, failures as {name: message}; `made`: see made_with()."""
    parts = [INTRODUCTION]
    parts += [s.headline + "\n" for s in sections.values() if s.headline]
    parts += ["\n## All cases\n\n", summary(sections), "\n\n", near_bounds(sections), WORDS]
    for name, message in failures.items():
        parts.append(f"\n**The case `{name}` did not run:** {message}\n")
    for section in sections.values():
        parts.append(f"\n## {section.title}\n\n{section.text}\n")
        for file, caption in section.figures:
            parts.append(f"\n![{caption}](images/accuracy/{file})\n")
        for markdown in section.tables or [rows_table(section.rows)]:
            parts.append(f"\n{markdown}\n")
        parts.append(f"\n{_sources(section.rows)}\n")
    parts.append(f"\n## Made with\n\n{made}\n")
    return "".join(parts)


def made_with(source, seconds, what="all cases"):
    """The page's last line: the commit (provenance.sentence()), the machine, how long it took."""
    cpu = platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            cpu = next(line.split(":")[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return (f"{source}; {cpu}, {os.cpu_count()} cores, {platform.system()} {platform.release()}; "
            f"{what} took {seconds / 60:.1f} minutes.")


def terminal(sections):
    """One line a row, for the eye of whoever ran it."""
    lines = []
    for name, section in sections.items():
        for r in section.rows:
            mark = "     " if r.bound is None else "ok   " if r.passed else "MISS "
            lines.append(f"{mark}{name:14} {r.element:6} {r.mesh[:34]:34} {r.quantity[:58]:58} "
                         f"{number(r.value):>12} {number(r.reference):>12} "
                         f"{percent(r.error, r.bound):>10} {limit(r.bound):>8}")
    return "\n".join(lines)
