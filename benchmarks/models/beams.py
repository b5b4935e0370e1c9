# SPDX-License-Identifier: GPL-3.0-or-later
"""B8: clamped beams."""

from accuracy import plots

from .program import figures
from .rows import Row, section

TEXT = """A beam of 32 cm, clamped at both ends (two masses each), with 2 n spacings between the clamps, under a force
in the middle. Its stiffness as a part of 192 E I/L^3, beside the closed form of appendix A."""


def appendix_a(n):
    """(2 E I/U^3) (12 n + 6)/(n^4 + 2 n^3 + 2 n^2 + n), as a part of 192 E I/(2 n U)^3."""
    return n * n * (n + 0.5) / (n ** 3 + 2 * n ** 2 + 2 * n + 1)


def run(context):
    found = dict(zip(*(figures(context, "beams")[k] for k in ("n", "ratio"))))
    shown = [n for n in (2, 4, 8, 16, 32, 64) if n in found]
    rows = [Row(f"force over deflection, n = {n}", appendix_a(n), "(A.20)", found[n],
                "the closed form is exact for this network; what is left is rounding") for n in shown]
    worst = max(found, key=lambda n: abs(found[n] / appendix_a(n) - 1))
    rows.append(Row(f"n = 2 to {max(found):g}, the one farthest off (n = {worst:g})", appendix_a(worst), "(A.20)",
                    found[worst], "rounding, which grows with n^4"))
    rows.append(Row(f"limit of many masses, at n = {max(found):g}", 1.0, "5.2.3", found[max(found)],
                    "that of (A.20) itself, which is 1 - 3/(2 n) and smaller terms"))
    fig, ax = plots.figure()
    ax.plot(list(found), [appendix_a(n) for n in found], color=plots.COLOUR["reference"],
            label="appendix A, closed form")
    ax.plot(list(found), list(found.values()), ".", color=plots.COLOUR["anp"], label="palpate")
    ax.set(xlabel="n, half of the spacings", ylabel="stiffness over 192 E I/L$^3$", ylim=(0, 1.02))
    ax.legend()
    return section("B8: clamped beam (5.2.3)", TEXT, rows,
                   [(plots.save(fig, context.images, "clamped_beam.svg"), "Stiffness of a clamped beam over n")])
