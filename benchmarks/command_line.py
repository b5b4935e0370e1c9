# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command lines of the benchmarks share."""

import argparse
import contextlib
import sys
import traceback

SKIPPED = 77  # what ctest takes for a skipped test


@contextlib.contextmanager
def needs(packages, ours):
    """For imports: ends the program as skipped where a Python module is missing that is not one of
    `ours`; `packages` is what scripts/install_dependencies.sh calls them."""
    try:
        yield
    except ModuleNotFoundError as missing:
        if missing.name.split(".")[0] in ours:
            raise
        print(f"no Python module {missing.name}; run scripts/install_dependencies.sh {packages}")
        sys.exit(SKIPPED)


def parse(script, description, what, known, flags):
    """The arguments: `names`, some of `known` (none: all), `quick`, `list`, and `flags` {name: help}.

    what: one of the known, "case". With --list it prints them and ends the program."""
    parser = argparse.ArgumentParser(prog=script, description=description)
    parser.add_argument("names", nargs="*", metavar=what.upper(), help="default: all of " + " ".join(known))
    parser.add_argument("--quick", action="store_true", help=f"small versions of the quick {what}s")
    for name, text in flags.items():
        parser.add_argument("--" + name, action="store_true", help=text)
    parser.add_argument("--list", action="store_true", help="print the names and do nothing")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(known))
        sys.exit(0)
    unknown = [name for name in arguments.names if name not in known]
    if unknown:
        parser.error(f"no {what} {' '.join(unknown)}; known: {' '.join(known)}")
    return arguments


def attempt(run, failed):
    """(What `run` returns, None), or (None, why it did not): the text of a `failed`, else where the
    exception came from, so that one that is broken is reported like one that fails."""
    try:
        return run(), None
    except failed as error:
        return None, str(error)
    except Exception:
        return None, traceback.format_exc(limit=-3)


def outcome(failure, seconds):
    """For the line of progress at the end of a case."""
    return f"{'FAILED: ' + failure if failure else 'done'} ({seconds:.0f} s)"
