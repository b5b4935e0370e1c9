#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails if something that users need is not installed, or a link in what is installed leads nowhere.

    scripts/checks/check_installed.py FOLDER [MORE ...]

FOLDER is where `cmake --install` put it, by DESTDIR or --prefix. MORE: folders of the repository beside config, docs
and msg that must be there as well.
"""
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILES = ["README.md", "LICENSE", "CHANGELOG.rst", "CONTRIBUTING.md"]
SCRIPTS = ["analyse_bag.py", "demo_scene.py", "data/make_demo_bag.py", "render_replay.py"]
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")  # of Markdown, to a file
PATH = re.compile(r":\s*\{?(?:file:\s*)?(\.\./[^\s,}]+)")  # of YAML, to a file


def check(share, more):
    wanted = [ROOT / name for name in FILES]
    for folder in "config", "docs", "msg", *more:
        wanted += [path for path in (ROOT / folder).rglob("*") if path.is_file()]
    problems = []
    for path in wanted:
        if not (share / path.relative_to(ROOT)).is_file():
            problems.append("%s is not installed" % path.relative_to(ROOT))
    for page in [share / "README.md", *share.glob("docs/**/*.md")]:
        for link in LINK.findall(page.read_text(encoding="utf-8")):
            if not (page.parent / link).exists():
                problems.append("%s: leads to %s" % (page.relative_to(share), link))
    scenes = sorted(share.glob("config/scenes/*.yaml"))
    for scene in scenes:
        for path in PATH.findall(scene.read_text(encoding="utf-8")):
            if not (scene.parent / path).exists():
                problems.append("%s: needs %s" % (scene.relative_to(share), path))
    for name in SCRIPTS:
        script = share / "scripts" / name
        if not os.access(script, os.X_OK):
            problems.append("scripts/%s is not installed as a program" % name)
            continue
        done = subprocess.run([script, "--help"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd="/",
                              env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}, universal_newlines=True, check=False)
        if done.returncode != 0:
            problems.append("scripts/%s --help: %s" % (name, done.stdout.strip()))
    return problems, len(scenes)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    shares = sorted(pathlib.Path(sys.argv[1]).rglob("share/palpate/config"))
    if len(shares) != 1:
        sys.exit("%s: share/palpate/config is there %d times" % (sys.argv[1], len(shares)))
    problems, scenes = check(shares[0].parent, sys.argv[2:])
    for problem in problems:
        print(problem, file=sys.stderr)
    sys.exit(1 if problems or scenes == 0 else 0)


if __name__ == "__main__":
    main()
