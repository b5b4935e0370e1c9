# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the scripts find the program `palpate`: in a checkout that was built, or where both are installed."""
import os
import shutil
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # of the repository, or share/palpate
PLACES = ["build/devel/lib/palpate/palpate", "build/src/cli/palpate",  # with and without catkin
          "../../lib/palpate/palpate", "../../bin/palpate"]


def program():
    places = [os.path.normpath(os.path.join(ROOT, place)) for place in PLACES]
    found = next((place for place in places if os.access(place, os.X_OK)), None) or shutil.which("palpate")
    if not found:
        sys.exit("palpate is not there: not in PATH, and none of %s; build it first" % ", ".join(places))
    return found
