# SPDX-License-Identifier: GPL-3.0-or-later
"""B2, B3: straight lines for the ideal springs."""

from .program import figures
from .rows import Row, section

TEXT = """The forces of ideal springs are replaced by straight lines through the limit of no curvature, whose square
errors G1 (structural) and G2 (flexion) up to the curvature rho0 depend on the rest lengths L1 and L2. The text has
least errors at L1 = 0 and L2 = 6 U, gives values of G1 and G2 there, and neither E I nor U: what can be compared is
G2/G1. Errors are in (E I)^2/U^3, for triangles with (1 + nu) D U/sqrt(3) in place of E I."""
SMALL = "the least error goes to the text's rest length only as the curvature goes to 0"


def said(published, which):
    return f"{published[which]:g} of an unknown unit" if published else "near 0"


def run(context):
    found = figures(context, "ideal")
    rows = []
    for name, key, rho, where, published in (("beam", "beam", "sqrt(2)/U", "4.2.2, 4.2.3", (0.08, 0.58, 0.005, 0.005)),
                                             ("beam", "beam_of_tenth_curvature", "sqrt(2)/(10 U)", "4.2.3", None),
                                             ("triangles", "triangles", "sqrt(2)/(10 U)", "4.3.2, 4.3.3",
                                              (4e-12, 3e-11, 5e-13, 5e-12))):
        v, at = found[key], f"{name}, rho0 = {rho}"
        rows += [Row(f"L1/U of the least error, {at}", 0.0, where, v["structural_rest_length"], SMALL),
                 Row(f"L2/U of the least error, {at}", 6.0, where, v["flexion_rest_length"], SMALL),
                 Row(f"G1 at L1 = 0, {at}", said(published, 0), where, v["structural_error_at_0"], ""),
                 Row("the same at the best L1", "that", where, v["structural_error_at_best"],
                     "the best rest length is not that of the text"),
                 Row(f"G2 at L2 = 6 U, {at}", said(published, 1), where, v["flexion_error_at_6U"], ""),
                 Row("the same at the best L2", "that", where, v["flexion_error_at_best"],
                     "the best rest length is not that of the text")]
        if published:
            G1, G2, half_1, half_2 = published  # and half of their last digits
            low, high = (G2 - half_2) / (G1 + half_1), (G2 + half_2) / (G1 - half_1)
            ours = v["flexion_error_at_6U"] / v["structural_error_at_0"]
            allowed = f"the digits given allow {low:.2f} to {high:.2f}"
            rows.append(Row(f"G2/G1 at L1 = 0 and L2 = 6 U, {at}", G2 / G1, where, ours,
                            allowed if low <= ours <= high else f"**not explained**: {allowed}"))
            if key == "beam":
                unit = found["beam_of_unit_curvature"]
                rows.append(Row("the same, rho0 = 1/U", G2 / G1, where,
                                unit["flexion_error_at_6U"] / unit["structural_error_at_0"],
                                "a curvature with which the ratio is within the digits"))
    return section("B2, B3: rest lengths of the least error (4.2, 4.3)", TEXT, rows)
