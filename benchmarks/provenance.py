# SPDX-License-Identifier: GPL-3.0-or-later
"""Which state of the sources a page is made from; scripts/checks/check_pages.py reads what is written here."""

import dataclasses
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]
DIGITS = 12


def _git(*arguments, root=ROOT):
    """What git says, or None where there is no git or no clone."""
    try:
        return subprocess.run(["git", *arguments], cwd=root, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return None


@dataclasses.dataclass(frozen=True)
class State:
    """A commit, and the files outside docs/ that differ from it; `commit` None: it cannot be told. Pages
    and their pictures do not count: no figure is computed from them, and the run itself writes them."""
    commit: str
    changed: tuple

    @staticmethod
    def now(root=ROOT):
        top = _git("rev-parse", "--show-toplevel", root=root)
        if top is None or pathlib.Path(top.strip()).resolve() != pathlib.Path(root).resolve():
            return State(None, ())  # an export; a repository around it says nothing about it
        commit = _git("rev-parse", f"--short={DIGITS}", "HEAD", root=root)
        status = _git("status", "--porcelain", "--", ".", ":!docs", root=root)
        return State(commit and commit.strip(), tuple(line[3:] for line in (status or "").splitlines()))


def sentence(begin, end):
    """For the page's last lines: the state when the run began, and whether it stayed so until `end`."""
    if begin.commit is None:
        return "Made from sources without a commit"
    text = f"Commit {begin.commit}"
    if begin != end:
        return text + "-dirty (the sources changed while it ran)"
    if begin.changed:
        some = ", ".join(begin.changed[:4]) + (", ..." if len(begin.changed) > 4 else "")
        return text + f"-dirty (with changes that are in no commit: {some})"
    if os.environ.get("PALPATE_NO_BUILD"):
        return text + " (programs as they were built before)"
    return text
