#!/usr/bin/env bash
# Fails if CHANGELOG.rst is not in the form of REP 132, or package.xml and it disagree.
set -euo pipefail
cd "$(dirname "$0")/../.."
/usr/bin/python3 - <<'PYTHON'
import re
import sys
import xml.etree.ElementTree

problems = []
lines = open("CHANGELOG.rst", encoding="utf-8").read().split("\n")
package = xml.etree.ElementTree.parse("package.xml").getroot()
name, version = package.findtext("name"), package.findtext("version")

title = "Changelog for package " + name
if lines[1:2] != [title]:
    problems.append("line 2 must be '%s'" % title)
elif not all(re.fullmatch(r"\^+", l) and len(l) >= len(title) for l in (lines[0], lines[2])):
    problems.append("the title needs a line of ^ above and below, at least as long as it")

heading = re.compile(r"Forthcoming|\d+\.\d+\.\d+ \(\d{4}-\d{2}-\d{2}\)")
sections = []
for i in range(3, len(lines) - 1):
    if re.fullmatch(r"-+", lines[i + 1]) and lines[i].strip():
        sections.append(lines[i])
        if not heading.fullmatch(lines[i]):
            problems.append("line %d: '%s' is neither Forthcoming nor 'X.Y.Z (YYYY-MM-DD)'" % (i + 1, lines[i]))
        if len(lines[i + 1]) < len(lines[i]):
            problems.append("line %d: the underline is shorter than the heading" % (i + 2))
if not sections:
    problems.append("there is no section")
elif "Forthcoming" in sections[1:]:
    problems.append("Forthcoming must be the first section")
released = [s.split()[0] for s in sections if s != "Forthcoming"]
if released and released[0] != version:
    problems.append("package.xml says %s, the newest released section %s" % (version, released[0]))

for i, line in enumerate(lines[3:], 4):
    if line != line.rstrip():
        problems.append("line %d: space at the end" % i)
    if len(line) > 120:
        problems.append("line %d: longer than 120 characters" % i)
    if "\t" in line:
        problems.append("line %d: a tab" % i)
    plain = line.strip() and not re.fullmatch(r"-+", line) and not heading.fullmatch(line)
    if plain and not re.match(r"\* |  +\S", line):
        problems.append("line %d: neither a list item ('* ...') nor its continuation" % i)

for problem in problems:
    print("CHANGELOG.rst: " + problem, file=sys.stderr)
sys.exit(1 if problems else 0)
PYTHON
echo "CHANGELOG.rst is in the form of REP 132."
