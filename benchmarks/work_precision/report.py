# SPDX-License-Identifier: GPL-3.0-or-later
"""The page docs/results/benchmarks.md."""

INTRODUCTION = """# Benchmarks

How long does a cycle take, and how wrong is the force meanwhile? A time without an error says little:
every method is fast if it may be wrong. Each section below runs palpate's own cycle (contact, solve,
wrench; `palpate bench`) on a fixed scene and puts the time beside the error against a reference.

`scripts/page.sh benchmark` runs everything, one measurement after the other, and writes this page;
`scripts/page.sh benchmark SUITE` runs one section, `palpate bench --scene S ...` one line. No figure on
this page was typed in by hand. All figures as a table: [benchmarks.csv](benchmarks.csv).
Other models than finite elements, each under the same tool: [models.md](models.md#under-a-tool).

**How errors are measured.** The reference of a run is the same scene on the same mesh with the same
element and law, stepped by `bdf2` with steps of 0.5 ms to a relative tolerance of 1e-7 and one of 1 nm
of the positions: at least ten times tighter in each setting than what is judged. It is solved by
factorisation (`implicit_direct`) on meshes of less than 3000 tetrahedra and by conjugate gradients on
larger ones. Such an error is that of method, step and tolerance: a solver may be within 1 % of it while the
hand feels twice the force. So beside it stands the error against the **converged force**, in which the mesh
counts as well; the section on what the mesh costs says how that is found. "Failed cycles" are cycles whose solve did not end in a usable state; a run with any has no
error.

**How times are measured.** One process a configuration, nothing else running; around the cycle alone,
loading apart. Each configuration is repeated from its start while a few seconds last; shown is the
fastest repeat (all repeats do the same work, bit for bit) and its median. The 99th percentile is that
of all cycles of all repeats together and stands only where these are 500 or more; "-" says that a run
is too slow for that. The scenes have contact's default stiffness, as a scene file without the key has.

"""


def page(sections, failures, made):
    """The whole page; sections by name, failures as {name: message}; `made`: accuracy.report.made_with()."""
    parts = [INTRODUCTION]
    for name, message in failures.items():
        parts.append(f"\n**The suite `{name}` did not run:** {message}\n")
    for name, section in sections.items():
        parts.append(f"\n## {section.title}\n\n{section.text}\n")
        for file, caption in section.figures:
            parts.append(f"\n![{caption}](images/benchmarks/{file})\n")
        for markdown in section.tables:
            parts.append(f"\n{markdown}\n")
        parts.append(f"\n`scripts/page.sh benchmark {name}`\n")
    parts.append(f"\n## Made with\n\n{made}\n")
    return "".join(parts)
