#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Of what gcovr counted: how much of each room the tests reach, and the errors that none of them raises.

    scripts/checks/coverage.py LINES.json [--untested | --commit HASH --tests "N of M"]

With --untested only the errors, as FILE:LINE: TEXT. Else the page, of this commit and of so many tests.
"""
import argparse
import collections
import json
import pathlib
import re

# What raises an error: an exception, or a status of a solve that the report carries.
RAISES = re.compile(r"\bthrow\b(?!;)|\b(fail|refuse\w*|complain)\(|"
                    r"((?<![<>=!])=|return) (solver::)?SolveStatus::k(NonFinite|Inverted|LineSearch)")
# What rostests run, which a build with counters has none of.
NODES = ("src/ros/", "include/palpate/ros/")


def room_of(path):
    parts = pathlib.PurePath(path).parts
    return parts[2] if parts[0] == "include" else parts[1]


def read(path):
    """{file: {line: count}}, of lines that make code; a template's line counts where any of its kinds ran."""
    files = collections.defaultdict(dict)
    for file in json.loads(pathlib.Path(path).read_text())["files"]:
        if file["file"].startswith(NODES):
            continue
        lines = files[file["file"]]
        for line in file["lines"]:
            if not line.get("gcovr/noncode"):
                number = line["line_number"]
                lines[number] = max(lines.get(number, 0), line["count"])
    return files


def read_branches(path):
    """{file: {line: [count]}}."""
    files = collections.defaultdict(dict)
    for file in json.loads(pathlib.Path(path).read_text())["files"]:
        if not file["file"].startswith(NODES):
            for line in file["lines"]:
                counts = [branch["count"] for branch in line["branches"]]
                files[file["file"]].setdefault(line["line_number"], []).extend(counts)
    return files


def statement(source, number):
    """From line `number` to its end, in one line."""
    text = ""
    for line in source[number - 1:number + 3]:
        text += " " + line.strip()
        if line.rstrip().endswith((";", "{", "}")):
            break
    return re.sub(r"\s+", " ", text).strip()


def untested(files, branches):
    """Lines that raise and were not reached; of `if (a || b) throw` in one line, where a way was not taken."""
    for name, lines in sorted(files.items()):
        source = pathlib.Path(name).read_text().splitlines()
        for number, count in sorted(lines.items()):
            text = source[number - 1]
            never = count == 0 or "if (" in text and 0 in branches[name].get(number, [])
            if never and RAISES.search(text):
                yield name, number, statement(source, number)


HEAD = """# Coverage

What the tests of the core and of the command line reach of the core, and which errors none of them raises: exceptions,
refusals, and the solvers' own failures. What only rostests reach of it counts as not reached; branches are those of
optimised code, without what throws in libraries. This page is written by

    scripts/checks/coverage.sh        # copied from build/coverage/coverage.md

Commit %s; %s tests passed. The others, if any, failed or were cut off, and count as not run: what is
said of `tissue` and `sim`, whose tests are the slowest, is then less than what they reach.
"""


def percent(part, whole):
    return "%.1f" % (100.0 * part / whole) if whole else "-"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lines")
    parser.add_argument("--untested", action="store_true")
    parser.add_argument("--commit", default="-")
    parser.add_argument("--tests", default="-")
    options = parser.parse_args()
    files = read(options.lines)
    branches = read_branches(options.lines)
    errors = list(untested(files, branches))
    if options.untested:
        for name, number, text in errors:
            print("%s:%d: %s" % (name, number, text))
        return
    reached, lines_of, taken, every = (collections.Counter() for _ in range(4))
    for name, lines in branches.items():
        every[room_of(name)] += sum(len(counts) for counts in lines.values())
        taken[room_of(name)] += sum(count > 0 for counts in lines.values() for count in counts)
    for name, lines in files.items():
        lines_of[room_of(name)] += len(lines)
        reached[room_of(name)] += sum(count > 0 for count in lines.values())
    print(HEAD % (options.commit, options.tests))
    print("| room | lines | reached [%] | branches | taken [%] | errors that no test raises |")
    print("|---|---|---|---|---|---|")
    missing = collections.Counter(room_of(name) for name, _, _ in errors)
    for room in sorted(lines_of):
        print("| `%s` | %d | %s | %d | %s | %d |" % (room, lines_of[room], percent(reached[room], lines_of[room]),
                                                   every[room], percent(taken[room], every[room]), missing[room]))
    print("| all | %d | %s | %d | %s | %d |" % (
        sum(lines_of.values()), percent(sum(reached.values()), sum(lines_of.values())), sum(every.values()),
        percent(sum(taken.values()), sum(every.values())), len(errors)))
    print("\n## Errors that no test raises\n")
    file = None
    for name, _, text in errors:
        if name != file:
            print("%s`%s`:\n" % ("" if file is None else "\n", name))
            file = name
        print("- `%s`" % text)


if __name__ == "__main__":
    main()
