# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables and curves of the literature, computed anew: see scripts/page.sh reproduce."""
