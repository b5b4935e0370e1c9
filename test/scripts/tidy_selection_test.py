#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which sources scripts/checks/tidy.py looks at, in a small repository, with a stand-in for clang-tidy."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "checks" / "tidy.py"

# Notes what it is called with, and finds something where a source, or one that it includes, says BAD.
STAND_IN = """#!/usr/bin/python3
import pathlib, re, sys
file = next(a for a in sys.argv[1:] if not a.startswith("-"))
text = pathlib.Path(file).read_text()
sources = re.findall('#include "(.*[.]cpp)"', text) or [file]
with open("calls", "a") as calls:
    calls.write(" ".join(pathlib.Path(s).name for s in sources) + " | " + " ".join(sys.argv) + "\\n")
bad = [s for s in sources if "BAD" in pathlib.Path(s).read_text()]
print("finding in", *bad)
sys.exit(1 if bad else 0)
"""


class Tidy(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name).resolve()
        self.write("include/palpate/inner.h", "")
        self.write("include/palpate/outer.h", '#include "palpate/inner.h"\n')
        self.write("src/a/one.cpp", '#include "palpate/outer.h"\n')
        self.write("src/a/own.h", "")
        self.write("src/a/two.cpp", '#include "own.h"\n')
        self.write("src/b/three.cpp", "#include <vector>\n")
        self.write("src/b/cgal.cpp", "#include <CGAL/Surface_mesh.h>\n")
        self.write("src/ros/node.cpp", "#include <vector>\n")
        for rule in (".clang-tidy", "scripts/checks/check_tidy.sh", "scripts/checks/tidy.py"):
            self.write(rule, "rules\n")
        self.write(".gitignore", "build\ncalls\ntidy\n")
        self.write("tidy", STAND_IN).chmod(0o755)
        self.write("build/compile_commands.json", json.dumps([
            {"directory": str(self.root), "file": str(file), "command":
             f"c++ -I{self.root}/include -O3 -Winvalid-pch -include {self.root}/x/cmake_pch.hxx"
             f" -o x.o -c {file}"} for file in sorted(self.root.glob("src/*/*.cpp"))]))
        self.git("init", "-q")
        self.commit()

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def git(self, *arguments):
        return subprocess.run(
            ["git", "-c", "user.name=t", "-c", "user.email=t@t", *arguments], cwd=self.root,
            check=True, capture_output=True, text=True).stdout

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "c", "--allow-empty")

    def run_tidy(self, *arguments, forget=True):
        """The exit status, what was said, and the sources that were looked at, in their order."""
        if forget:  # a fresh clone remembers nothing
            shutil.rmtree(self.root / "build/tidy", ignore_errors=True)
        (self.root / "calls").unlink(missing_ok=True)
        done = subprocess.run([sys.executable, PROGRAM, self.root / "tidy", "build", *arguments],
                              cwd=self.root, capture_output=True, text=True, check=False)
        calls = (self.root / "calls").read_text() if (self.root / "calls").exists() else ""
        self.calls = calls.splitlines()
        return done.returncode, done.stdout + done.stderr, sorted(
            {word for call in self.calls for word in call.split(" | ")[0].split()})

    def record(self):
        self.assertEqual(self.run_tidy("--all")[0], 0)
        self.commit()

    def test_all_where_nothing_is_recorded(self):
        status, said, seen = self.run_tidy()
        self.assertEqual((status, seen), (0, ["one.cpp", "three.cpp", "two.cpp"]), said)

    def test_nothing_after_all_passed(self):
        self.record()
        self.assertEqual(self.run_tidy()[2], [])
        self.assertEqual(self.run_tidy("--all")[2], ["one.cpp", "three.cpp", "two.cpp"])

    def test_who_includes_what_changed(self):
        self.record()
        self.write("include/palpate/inner.h", "// changed\n")
        self.assertEqual(self.run_tidy()[2], ["one.cpp"])
        self.commit()
        self.assertEqual(self.run_tidy()[2], ["one.cpp"])
        self.write("src/a/own.h", "// changed\n")
        self.assertEqual(self.run_tidy()[2], ["one.cpp", "two.cpp"])

    def test_a_new_header_and_a_moved_one(self):
        self.record()
        self.write("src/b/new.h", "")
        self.write("src/b/three.cpp", '#include "new.h"\n')
        self.git("mv", "src/a/own.h", "include/palpate/own.h")
        self.write("src/a/two.cpp", '#include "palpate/own.h"\n')
        self.assertEqual(self.run_tidy()[2], ["three.cpp", "two.cpp"])

    def test_all_after_a_change_of_the_rules(self):
        self.record()
        self.write(".clang-tidy", "others\n")
        self.assertEqual(self.run_tidy()[2], ["one.cpp", "three.cpp", "two.cpp"])

    def test_all_where_the_recorded_commit_is_unknown(self):
        self.record()
        self.write(".clang-tidy-passed", "0123456789" * 4 + "\n")
        self.assertEqual(self.run_tidy()[2], ["one.cpp", "three.cpp", "two.cpp"])

    def test_findings_are_named_and_not_remembered(self):
        self.write("src/a/two.cpp", "// BAD\n")
        status, said, _ = self.run_tidy()
        self.assertEqual(status, 1)
        self.assertIn("finding in src/a/two.cpp", said)
        self.assertIn("findings in src/a/two.cpp", said)
        status, said, seen = self.run_tidy(forget=False)
        self.assertEqual((status, seen), (1, ["two.cpp"]), said)
        self.write("src/a/two.cpp", "// good\n")
        self.assertEqual(self.run_tidy(forget=False)[0], 0)
        self.assertEqual(self.run_tidy(forget=False)[2], [])

    def test_only_what_is_committed_is_recorded(self):
        self.write("src/a/two.cpp", "// good\n")
        self.assertEqual(self.run_tidy("--all")[0], 0)
        self.assertFalse((self.root / ".clang-tidy-passed").exists())
        self.commit()
        head = self.git("rev-parse", "HEAD")
        self.run_tidy("--all")
        self.assertEqual((self.root / ".clang-tidy-passed").read_text(), head)

    def test_flags_are_those_of_the_build_less_the_precompiled_header(self):
        self.assertEqual(self.run_tidy("src/a/one.cpp")[2], ["one.cpp"])
        self.assertTrue(self.calls[0].endswith(f"src/a/one.cpp -- -I{self.root}/include -O3"))

    def test_each_source_of_those_that_are_compiled_as_one(self):
        sources = sorted(self.root.glob("src/*/*.cpp"))
        unit = self.write("build/src/Unity/unity_0_cxx.cxx", "".join(f'#include "{s}"\n' for s in sources))
        self.write("build/compile_commands.json", json.dumps([
            {"directory": str(self.root), "file": str(unit), "command": f"c++ -O3 -o x.o -c {unit}"}]))
        status, said, seen = self.run_tidy("src/a/two.cpp")
        self.assertEqual((status, seen), (0, ["two.cpp"]), said)
        self.assertTrue(self.calls[0].endswith("src/a/two.cpp -- -O3"), self.calls)


if __name__ == "__main__":
    if not shutil.which("git"):
        print("git is not installed, and the test makes a repository; run scripts/install_dependencies.sh build")
        sys.exit(77)
    os.environ.update(GIT_CONFIG_GLOBAL="/dev/null", GIT_CONFIG_NOSYSTEM="1")
    unittest.main()
