# SPDX-License-Identifier: GPL-3.0-or-later
"""The suites, in the order of the page. Each module has run(context) -> Section; one with
QUICK = True has a small version that takes seconds."""

from . import beam, cube, discretisation, graded, hand, kernels, organs, reach, size, skips, static, threads

SUITES = {"reach": reach, "hand": hand, "cube": cube, "organs": organs, "discretisation": discretisation,
          "graded": graded, "size": size, "threads": threads, "beam": beam, "static": static,
          "skips": skips, "kernels": kernels}
