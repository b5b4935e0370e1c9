# SPDX-License-Identifier: GPL-3.0-or-later
"""A published figure beside ours."""

import dataclasses
import math
from typing import Optional, Union

from accuracy.rows import table as table_of


@dataclasses.dataclass
class Row:
    """`published` is a number, or what the source says in words; then `limit`, if any, is the number that it
    promises ours not to exceed."""
    quantity: str
    published: Union[float, str]
    source: str
    ours: float
    reason: str
    limit: Optional[float] = None
    percent: bool = False  # both are relative errors: shown in per cent, their difference in points

    def shown(self, value):
        return f"{100 * value:+.1f} %" if self.percent and not isinstance(value, str) else number(value)

    def difference(self):
        if self.percent:
            return f"{100 * (self.ours - self.published):+.1f} points"
        if not isinstance(self.published, str):
            if self.published == 0.0:
                return number(self.ours)
            part = self.ours / self.published - 1.0
            return "none" if abs(part) < 1e-9 else f"{part:+.1e}" if abs(part) < 5e-5 else f"{100 * part:+.2f} %"
        if self.limit is None:
            return ""
        return "kept" if abs(self.ours) <= self.limit else "**not kept**"


def number(value):
    if isinstance(value, str):
        return value
    return f"{value:.4g}" if math.isfinite(value) else "none"


def rows_table(rows):
    return table_of(["quantity", "published", "where", "ours", "difference", "reason"],
                    [[r.quantity, r.shown(r.published), r.source, r.shown(r.ours), r.difference(), r.reason]
                     for r in rows])


def section(title, text, rows, figures=()):
    """A part of the page; figures: (file name, caption)."""
    pictures = "".join(f"\n![{caption}](images/models/{file})\n" for file, caption in figures)
    return f"### {title}\n\n{text}\n{pictures}\n{rows_table(rows)}\n"
