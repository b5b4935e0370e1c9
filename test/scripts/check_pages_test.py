#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts/checks/check_pages.py says of pages of every origin, in a small repository; and that what
benchmarks/provenance.py writes is what it reads."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

SOURCES = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = SOURCES / "scripts" / "checks" / "check_pages.py"
sys.path.insert(0, str(SOURCES / "benchmarks"))
import provenance  # noqa: E402

PAGES = ("accuracy", "benchmarks", "coverage", "hands", "models", "stability")


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name).resolve()
        self.root = self.top / "clone"
        self.write("scripts/rooms.txt", (SOURCES / "scripts/rooms.txt").read_text())
        self.write("src/fem/one.cpp", "")
        self.write("src/ros/node.cpp", "")
        self.git("init", "-q")
        self.made_from()

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def git(self, *arguments, cwd=None):
        return subprocess.run(["git", "-c", "user.name=t", "-c", "user.email=t@t", *arguments],
                              cwd=cwd or self.root, check=True, capture_output=True, text=True).stdout.strip()

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "c", "--allow-empty")
        return self.git("rev-parse", "--short=12", "HEAD")

    def made_from(self, text=None):
        """All pages as the scripts write them, of the present sources, or with `text` as their origin."""
        if text is None:
            self.commit()
            state = provenance.State.now(self.root)
            with mock.patch.dict(os.environ, {"PALPATE_NO_BUILD": ""}):
                text = provenance.sentence(state, provenance.State.now(self.root))
        for page in PAGES:
            self.write(f"docs/results/{page}.md", f"# Page\n\n## Made with\n\n{text}; a processor; 1 minute.\n")
        self.commit()

    def check(self, root=None, options=()):
        done = subprocess.run([sys.executable, str(PROGRAM), *options, str(root or self.root)],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_of_the_present_sources(self):
        status, said = self.check()
        self.assertEqual(status, 0, said)
        self.assertEqual(said.count("nothing that decides its figures has changed since"), len(PAGES))
        self.assertEqual(self.check(options=["--release"])[0], 0)

    def test_changes_are_counted_and_are_no_failure(self):
        for k in range(3):
            self.write("src/fem/one.cpp", f"// {k}\n")
            self.commit()
        self.write("src/ros/node.cpp", "// decides no figure\n")
        self.write("benchmarks/work_precision/a.py", "# of one page only\n")
        self.commit()
        status, said = self.check()
        self.assertEqual(status, 0, said)
        self.assertIn("WARNING: docs/results/accuracy.md", said)
        self.assertIn("3 commits have since changed what decides its figures (fem 3)", said)
        self.assertIn("4 commits have since changed what decides its figures (fem 3, benchmarks 1)", said)
        self.assertEqual(self.check(options=["--release"])[0], 1)

    def test_a_page_is_as_old_as_the_oldest_of_its_parts(self):
        old = self.git("rev-parse", "--short=12", "HEAD")
        self.write("src/fem/one.cpp", "// later\n")
        new = self.commit()
        for first, second in ((old, new), (new, old)):
            self.made_from(f"Commit {first}; a processor\n\n## Part\n\nCommit {second}")
            status, said = self.check()
            self.assertEqual((status, said.count(f"is of {old}; 1 commits")), (0, len(PAGES)), said)
        self.made_from(f"Commit {new}\n\n## Part\n\nCommit 0123456789ab")
        self.assertEqual(self.check()[0], 1)

    def test_a_page_of_a_tree_with_changes_is_not_released(self):
        self.write("src/fem/one.cpp", "// in no commit\n")
        state = provenance.State.now(self.root)
        self.assertEqual(state.changed, ("src/fem/one.cpp",))
        self.made_from(provenance.sentence(state, state))
        status, said = self.check()
        self.assertEqual((status, said.count("WARNING"), said.count("changes that are in no commit")), (0, len(PAGES), len(PAGES)))
        self.assertEqual(self.check(options=["--release"])[0], 1)

    def test_sources_that_change_meanwhile_are_not_released(self):
        begin = provenance.State.now(self.root)
        self.write("src/fem/one.cpp", "// meanwhile\n")
        self.commit()
        self.made_from(provenance.sentence(begin, provenance.State.now(self.root)))
        self.assertEqual(self.check(options=["--release"])[0], 1)

    def test_a_page_that_is_written_is_no_change(self):
        self.write("docs/results/accuracy.md", "being written\n")
        self.assertEqual(provenance.State.now(self.root).changed, ())

    def test_a_commit_of_another_branch_and_none_fail(self):
        self.git("checkout", "-q", "-b", "other")
        other = self.commit()
        self.git("checkout", "-q", "-")
        self.made_from(f"Commit {other}")
        status, said = self.check()
        self.assertEqual((status, said.count("does not come from")), (1, len(PAGES)), said)
        self.made_from("Commit 0123456789ab")
        self.assertEqual(self.check()[0], 1)
        self.made_from("Made from sources without a commit")
        status, said = self.check()
        self.assertEqual((status, said.count("names no commit")), (1, len(PAGES)), said)

    def test_a_shallow_clone_and_an_export_cannot_tell(self):
        self.write("src/fem/one.cpp", "// later\n")
        self.commit()
        shallow = self.top / "shallow"
        self.git("clone", "-q", "--depth", "1", self.root.as_uri(), str(shallow), cwd=self.top)
        status, said = self.check(shallow)
        self.assertEqual((status, said.count("too shallow")), (0, len(PAGES)), said)
        export = self.top / "export"
        shutil.copytree(self.root, export, ignore=shutil.ignore_patterns(".git"))
        status, said = self.check(export)
        self.assertEqual((status, said.count("this is no clone")), (0, len(PAGES)), said)
        self.assertIsNone(provenance.State.now(export).commit)

    def test_an_export_within_a_repository_is_an_export(self):
        export = self.root / "third_party"
        shutil.copytree(self.root / "docs", export / "docs")
        shutil.copytree(self.root / "scripts", export / "scripts")
        self.commit()
        status, said = self.check(export)
        self.assertEqual((status, said.count("this is no clone")), (0, len(PAGES)), said)

    def test_a_room_that_nobody_sorted_fails(self):
        self.write("scripts/rooms.txt", (SOURCES / "scripts/rooms.txt").read_text() + "magnets:\n")
        status, said = self.check()
        self.assertEqual(status, 1)
        self.assertIn("room magnets is in neither MECHANICS nor OTHER", said)

    def test_a_link_that_leads_nowhere_fails(self):
        self.write("docs/one.md", "# One, `two`\n\n## Same\n\n## Same\n\n[a](#same-1) [b](other.md#a-b) [c](https://x.y/z)\n")
        self.write("docs/other.md", "# A b\n\n[d](one.md#one-two) ![e](../src/fem/one.cpp)\n")
        self.assertEqual(self.check()[0], 0)
        for link in ("gone.md", "one.md#same-2", "#d", "../gone/", "results/gone.md#x"):
            self.write("docs/other.md", f"# A b\n\n[d]({link})\n")
            status, said = self.check()
            self.assertEqual((status, said.count(f"docs/other.md: {link} leads")), (1, 1), said)

    def test_a_source_that_is_not_there_fails(self):
        self.write("docs/one.md", "See `src/fem/one.cpp`. Write\n\n`src/fem/new.cpp`:\n")
        self.assertEqual(self.check()[0], 0)
        self.write("docs/one.md", "See `src/fem/gone.cpp`.\n")
        status, said = self.check()
        self.assertEqual((status, said.count("docs/one.md: there is no src/fem/gone.cpp")), (1, 1), said)


if __name__ == "__main__":
    if shutil.which("git") is None:
        print("git is not installed, and the test makes a repository; run scripts/install_dependencies.sh build")
        sys.exit(77)
    unittest.main()
