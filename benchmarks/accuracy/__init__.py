# SPDX-License-Identifier: GPL-3.0-or-later
"""How right palpate is: cases with known answers, run through its programs; see docs/results/accuracy.md."""
