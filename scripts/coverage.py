#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Of what gcovr counted: how much of each room the tests reach, and the errors that none of them raises.

    scripts/coverage.py LINES.json [--untested]

With --untested only the errors, as FILE:LINE: TEXT.
"""
import argparse
import collections
import json
import pathlib
import re

# What raises an error: an exception, or a status of a solve that the report carries.
RAISES = re.compile(r"\bthrow\b(?!;)|\b(fail|refuse|complain)[A-Z]?\w*\(|SolveStatus::k(NonFinite|Inverted|LineSearch)")
MACHINE = ("src/ros/", "include/palpate/ros/")


def room_of(path):
    parts = pathlib.PurePath(path).parts
    return parts[2] if parts[0] == "include" else parts[1]


def read(path):
    """{file: {line: count}}, of lines that make code; a template's line counts where any of its kinds ran."""
    files = collections.defaultdict(dict)
    for file in json.loads(pathlib.Path(path).read_text())["files"]:
        if file["file"].startswith(MACHINE):
            continue
        lines = files[file["file"]]
        for line in file["lines"]:
            if not line.get("gcovr/noncode"):
                number = line["line_number"]
                lines[number] = max(lines.get(number, 0), line["count"])
    return files


def branches(path):
    taken, every = collections.Counter(), collections.Counter()
    for file in json.loads(pathlib.Path(path).read_text())["files"]:
        if not file["file"].startswith(MACHINE):
            for line in file["lines"]:
                every[room_of(file["file"])] += len(line["branches"])
                taken[room_of(file["file"])] += sum(branch["count"] > 0 for branch in line["branches"])
    return taken, every


def statement(source, number):
    """From line `number` to its end, in one line."""
    text = ""
    for line in source[number - 1:number + 3]:
        text += " " + line.strip()
        if line.rstrip().endswith((";", "{", "}")):
            break
    return re.sub(r"\s+", " ", text).strip()


def untested(files):
    for name, lines in sorted(files.items()):
        source = pathlib.Path(name).read_text().splitlines()
        for number, count in sorted(lines.items()):
            if count == 0 and RAISES.search(source[number - 1]):
                yield name, number, statement(source, number)


def percent(part, whole):
    return "%.1f" % (100.0 * part / whole) if whole else "-"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lines")
    parser.add_argument("--untested", action="store_true")
    options = parser.parse_args()
    files = read(options.lines)
    errors = list(untested(files))
    if options.untested:
        for name, number, text in errors:
            print("%s:%d: %s" % (name, number, text))
        return
    taken, every = branches(options.lines)
    reached, lines_of = collections.Counter(), collections.Counter()
    for name, lines in files.items():
        lines_of[room_of(name)] += len(lines)
        reached[room_of(name)] += sum(count > 0 for count in lines.values())
    print("| room | lines | reached [%] | branches | taken [%] | errors that no test raises |")
    print("|---|---|---|---|---|---|")
    missing = collections.Counter(room_of(name) for name, _, _ in errors)
    for room in sorted(lines_of):
        print("| `%s` | %d | %s | %d | %s | %d |" % (room, lines_of[room], percent(reached[room], lines_of[room]),
                                                   every[room], percent(taken[room], every[room]), missing[room]))
    print("| all | %d | %s | %d | %s | %d |" % (
        sum(lines_of.values()), percent(sum(reached.values()), sum(lines_of.values())), sum(every.values()),
        percent(sum(taken.values()), sum(every.values())), len(errors)))
    print("\n| error that no test raises | |\n|---|---|")
    for name, number, text in errors:
        print("| `%s:%d` | `%s` |" % (name, number, text.replace("|", "\\|")))


if __name__ == "__main__":
    main()
