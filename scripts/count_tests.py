#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts tests of a run of ctest; a program of gtest counts for each case that it ran.

usage: count_tests.py CTEST_OUTPUT LAST_TEST_LOG

Prints `PASSED FAILED SKIPPED`, then a line `skipped NAME: REASON` or `failed NAME (STATUS)` each.
"""
import re
import sys


def blocks(log):
    """Output of each test by name, from ctest's LastTest.log."""
    parts = re.split(r"^\d+/\d+ Testing: (.*)$", log, flags=re.M)
    return dict(zip(parts[1::2], parts[2::2]))


def cases(output):
    """Numbers of cases that passed and failed, and (name, reason) of those skipped; None without gtest."""
    if "[==========] Running" not in output:
        return None
    number = {kind: int(n) for kind, n in re.findall(r"^\[  (PASSED|FAILED)  \] (\d+) tests?[.,]", output, re.M)}
    skipped = re.findall(r"^\[ RUN      \] (\S+)\n(?:.*: Skipped\n(.*)\n)?(?:(?!\[ RUN).*\n)*?\[  SKIPPED \] \1 \(", output,
                         re.M)
    failed = sorted(set(re.findall(r"^\[  FAILED  \] (\w\S*?),? .*ms\)$", output, re.M)))
    return number.get("PASSED", 0), failed, skipped


def count(said, log):
    """(passed, [failed name and status], [(skipped name, reason)])"""
    outputs = blocks(log)
    passed, failed, skipped = 0, [], []
    for name, status in re.findall(r"^ *\d+/\d+ Test +#\d+: (\S+) \.\.+ *(Passed|\*\*\*[\w():, ]+?) +[\d.]+ sec", said, re.M):
        output = outputs.get(name, "")
        found = cases(output)
        if status == "Passed" and found:
            passed += found[0]
            skipped += [(f"{name}/{case}", reason or "it says no reason") for case, reason in found[2]]
        elif status == "Passed":
            passed += 1
        elif status.startswith("***Skipped") or "Disabled" in status:
            reason = re.search(r": Skipped\n(.+)|^(?:Output:\n-+\n)(.+)", output, re.M)
            skipped.append((name, next(filter(None, reason.groups())) if reason else "it says no reason"))
        else:
            if found:
                passed += found[0]
            which = [f"{name}/{case}" for case in found[1]] if found and found[1] else [name]
            failed += [f"{one} ({status.strip('* ')})" for one in which]
    return passed, failed, skipped


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    texts = [open(path, encoding="utf-8", errors="replace").read() for path in sys.argv[1:]]
    good, bad, left = count(*texts)
    print(good, len(bad), len(left))
    for name, reason in left:
        print(f"skipped {name}: {reason}")
    for line in bad:
        print(f"failed {line}")
