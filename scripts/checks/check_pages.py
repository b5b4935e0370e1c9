#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how old the measured pages of docs/results/ are: each names the commits that made it. Fails if one names
none, or a commit that HEAD does not come from, if a relative link between pages leads nowhere, and if a page names a
source file that is not there.

That a page is of a tree with changes that are in no commit, and how many commits have since changed what decides its
figures, is information: a page takes up to an hour of a quiet machine and is made anew before a release, not with
each commit. With --release a page of a tree with changes, or older than what decides its figures, fails. Without git,
in an export and in a clone that is too shallow it says that it cannot tell.

    scripts/checks/check_pages.py [--release] [ROOT]
"""
import pathlib
import re
import subprocess
import sys

# Rooms whose code decides a force or a shape, and those that only read, write, show or advise.
MECHANICS = ["base", "material", "mesh", "fem", "solver", "springs", "bem", "instrument", "contact", "tissue", "scene", "sim"]
OTHER = ["keys", "formats", "organs", "skin", "enrichment", "haptics", "advice", "analysis", "io", "start",
         "torture", "cli", "ros"]
BUILD = ["CMakeLists.txt", "cmake", "src/CMakeLists.txt"]
PAGES = {  # page: (what makes it, what decides its figures besides MECHANICS and BUILD)
    "docs/results/accuracy.md": ("scripts/page.sh accuracy", [
        "include/palpate/analysis", "src/analysis", "benchmarks/accuracy", "test/accuracy"]),
    "docs/results/benchmarks.md": ("scripts/page.sh benchmark", [
        "include/palpate/organs", "src/organs", "src/cli", "config", "benchmarks"]),
    "docs/results/coverage.md": ("scripts/checks/coverage.sh", ["include", "src", "test"]),
    "docs/results/hands.md": ("scripts/page.sh hands", [
        "include/palpate/haptics", "src/haptics", "config", "benchmarks/hands"]),
    "docs/results/models.md": ("scripts/page.sh reproduce", [
        "include/palpate/analysis", "src/analysis", "include/palpate/skin", "src/skin", "include/palpate/enrichment",
        "src/enrichment", "benchmarks/models"]),
    "docs/results/stability.md": ("scripts/page.sh torture --kept --again", ["include/palpate/torture", "src/torture"])}
MADE_FROM = re.compile(r"^Commit ([0-9a-f]{7,40})(-dirty)?\b", re.MULTILINE)
LINK = re.compile(r"\]\(([^)\s]+)\)")  # of Markdown
HEADING = re.compile(r"^#{1,6} +(.+?) *$", re.MULTILINE)


class CannotTell(Exception):
    """Why."""


def git(root, *arguments):
    return subprocess.run(["git", *arguments], cwd=root, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def look_for_clone(root):
    try:
        top = git(root, "rev-parse", "--show-toplevel")
    except OSError as error:
        raise CannotTell("git is not installed") from error
    if top.returncode != 0 or pathlib.Path(top.stdout.strip()).resolve() != root:
        raise CannotTell("this is no clone")


def is_shallow(root):
    return git(root, "rev-parse", "--is-shallow-repository").stdout.strip() == "true"


def paths(page):
    rooms = [f"{top}/{room}" for room in MECHANICS for top in ("include/palpate", "src")]
    return rooms + BUILD + PAGES[page][1]


def changes(root, commit, page):
    """How many commits after `commit` changed what: {room or folder: number}, and how many in all."""
    log = git(root, "log", "--no-merges", "--format=%x00", "--name-only", f"{commit}..HEAD", "--", *paths(page))
    if log.returncode != 0:
        raise CannotTell(log.stderr.strip())
    touched, commits = {}, log.stdout.split("\0")[1:]
    for files in commits:
        for place in {f.removeprefix("include/palpate/").removeprefix("src/").split("/")[0]
                      for f in files.split()}:
            touched[place] = touched.get(place, 0) + 1
    return touched, len(commits)


def check(root, page):
    """(problem or None, what there is to say) about a page, by the part of it that is oldest. @throws CannotTell"""
    found = sorted(set(MADE_FROM.findall((root / page).read_text(encoding="utf-8"))))
    if not found:
        return f"{page} names no commit; run {PAGES[page][0]}", ""
    parts = [check_commit(root, page, commit, dirty) for commit, dirty in found]
    problem, said, _ = max(parts, key=lambda part: (part[0] is not None, part[2]))
    return problem, said


def check_commit(root, page, commit, dirty):
    """The same of a part that is of this commit, and how old it is. @throws CannotTell"""
    command = PAGES[page][0]
    if dirty:
        said = f"WARNING: {page} was made with changes that are in no commit, on top of {commit}; run {command}."
        return None, said, sys.maxsize
    look_for_clone(root)
    known = git(root, "cat-file", "-e", commit + "^{commit}").returncode == 0
    if not known and is_shallow(root):
        raise CannotTell(f"this clone is too shallow to have {commit}, of which {page} is")
    if not known or git(root, "merge-base", "--is-ancestor", commit, "HEAD").returncode != 0:
        if known and is_shallow(root):
            raise CannotTell(f"this clone is too shallow to say whether it comes from {commit}")
        return f"{page} is of {commit}, which this branch does not come from; run {command}", "", 0
    touched, number = changes(root, commit, page)
    if number == 0:
        return None, f"{page} is of {commit}: nothing that decides its figures has changed since.", 0
    most = sorted(touched, key=lambda place: (-touched[place], place))
    said = (f"WARNING: {page} is of {commit}; {number} commits have since changed what decides its figures "
            f"({', '.join(f'{p} {touched[p]}' for p in most)}). Run {command} before you rely on them.")
    return None, said, number


def check_lists(root):
    """A room that nobody has sorted into MECHANICS or OTHER, and one that is gone."""
    text = (root / "scripts/rooms.txt").read_text(encoding="utf-8")
    rooms = {line.split("#")[0].split(":")[0].strip() for line in text.splitlines() if not line.startswith(" ")} - {""}
    listed = set(MECHANICS + OTHER)
    here = "scripts/checks/check_pages.py"
    return ([f"room {r} is in neither MECHANICS nor OTHER of {here}" for r in sorted(rooms - listed)]
            + [f"{here} knows a room {r}; scripts/rooms.txt does not" for r in sorted(listed - rooms)])


def anchors(text):
    """What a link may name of a page: its headings as GitHub and GitLab spell them."""
    names = set()
    for heading in HEADING.findall(text):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        name = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        names.add(next(n for n in (name, *(f"{name}-{k}" for k in range(1, 100))) if n not in names))
    return names


def check_links(root):
    """Relative links of pages that lead to no file, or to no heading of a page."""
    pages = [*root.glob("*.md"), *root.glob("docs/**/*.md")]
    texts = {page.resolve(): page.read_text(encoding="utf-8") for page in pages}
    problems = []
    for page in sorted(texts):
        for link in LINK.findall(texts[page]):
            if re.match(r"[a-z]+:", link):
                continue  # elsewhere
            name, _, anchor = link.partition("#")
            target = (page.parent / name).resolve() if name else page
            if not target.exists():
                problems.append(f"{page.relative_to(root)}: {link} leads nowhere")
            elif anchor and target in texts and anchor not in anchors(texts[target]):
                problems.append(f"{page.relative_to(root)}: {link} leads to no heading")
    return problems


def check_names(root):
    """Source files that pages to be read name, and that are not there."""
    problems = []
    for page in sorted([*root.glob("*.md"), *root.glob("docs/*.md")]):
        text = page.read_text(encoding="utf-8")
        written = set(re.findall(r"^`([\w/.]+)`:$", text, re.M))  # files that the page says how to write
        for name in re.findall(r"`((?:src|include|test|scripts|config|cmake)/[\w/.]+\.\w+)`", text):
            if name not in written and not (root / name).exists():
                problems.append(f"{page.relative_to(root)}: there is no {name}")
    return problems


def main():
    release = "--release" in sys.argv[1:]
    places = [a for a in sys.argv[1:] if a != "--release"]
    root = pathlib.Path(places[0] if places else pathlib.Path(__file__).parents[2]).resolve()
    problems = check_lists(root) + check_links(root) + check_names(root)
    for page in PAGES:
        try:
            problem, said = check(root, page)
        except CannotTell as why:
            problem, said = None, f"{page}: whether the sources have changed since cannot be told: {why}."
        if release and not problem and said.startswith("WARNING"):
            problem = said
        if problem:
            problems.append(problem)
        else:
            print(said)
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
