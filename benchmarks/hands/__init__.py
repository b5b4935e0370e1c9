# SPDX-License-Identifier: GPL-3.0-or-later
"""Loops through simulated hands, measured: see scripts/page.sh hands."""
