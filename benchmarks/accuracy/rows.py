# SPDX-License-Identifier: GPL-3.0-or-later
"""What a case hands to the report."""

import dataclasses
import math
from typing import Optional


@dataclasses.dataclass
class Row:
    """One figure beside the right one; `bound` None: shown, not checked. The error is a part of
    the reference unless it is given."""
    case: str
    mesh: str
    element: str
    quantity: str
    value: float
    reference: float
    source: str
    bound: Optional[float] = None
    error: Optional[float] = None

    def __post_init__(self):
        if self.error is None:
            self.error = (self.value - self.reference) / abs(self.reference)

    @property
    def passed(self):
        """A figure that is not a number passes no bound."""
        return self.bound is None or (math.isfinite(self.error) and abs(self.error) <= self.bound)


@dataclasses.dataclass
class Section:
    """A case's part of the page. Without `tables` (Markdown) the rows are the table."""
    title: str
    text: str
    rows: list
    figures: list = dataclasses.field(default_factory=list)  # (file name, caption)
    tables: list = dataclasses.field(default_factory=list)
    headline: str = ""  # Markdown for the first screen of the page


def table(head, lines):
    """A Markdown table."""
    out = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    out += ["| " + " | ".join(str(cell) for cell in line) + " |" for line in lines]
    return "\n".join(out)


BALANCE = 1e-6  # static solves end at 1e-8 to 1e-9 of the forces; over all nodes that may add up to some times


def balance(case, mesh, element, supports, load, bound=BALANCE):
    """A row that says how well the forces of all supports carry the load (both vectors)."""
    size = max(abs(x) for x in list(load) + list(supports))
    gap = max(abs(a + b) for a, b in zip(supports, load))
    return Row(case, mesh, element, "supports + load, as a part of the largest force", gap, 0.0,
               "equilibrium", bound, gap / size)
