#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts/checks/check_tidy.sh runs: clang-tidy over the core and the command line.

usage: tidy.py CLANG_TIDY BUILD_DIR [--all | FILE ...]

Most of clang-tidy's time goes into the headers of libraries. So several sources are checked as one
translation unit; where that finds something, or where names in them collide, its halves are checked,
down to single files, whose findings are printed.

A source is not checked again if it passed before with the same text of its own, of all headers of
ours that it includes, of its flags and of the rules (BUILD_DIR/tidy/passed), or if none of these
files has changed since the commit that the file .clang-tidy-passed names. --all checks everything;
if it finds nothing in a tree without changes, it writes that file, to be committed.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

RECORD = pathlib.Path(".clang-tidy-passed")
RULES = [".clang-tidy", "scripts/checks/check_tidy.sh", "scripts/checks/tidy.py"]
SOURCES = ["include", "src"]
BATCH = 12  # sources a translation unit
# Sources that see CGAL take minutes each, almost all of it in CGAL's templates: they are left to the
# compiler's warnings and to review. src/ros sees ROS's headers, which have their own manner.
LEFT_OUT = re.compile(r'#include *[<"](CGAL/|palpate/.*cgal|(mesh/)?cgal/)')
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.M)
QUIET = ["--quiet", "--extra-arg=-Wno-unknown-warning-option",
         "--extra-arg=-Wno-ignored-optimization-argument",
         "--extra-arg=-Wno-unused-command-line-argument"]


def git(*arguments):
    """Lines of git's output, or None where it fails."""
    try:
        done = subprocess.run(["git", *arguments], capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return None
    return done.stdout.splitlines() if done.returncode == 0 else None


class Build:
    """Flags of the sources that a build compiles, without gcc's precompiled headers."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        self.flags, self.search, self.unit = {}, {}, {}
        root = pathlib.Path.cwd()
        for entry in json.loads((self.folder / "compile_commands.json").read_text()):
            source = pathlib.Path(entry["directory"], entry["file"]).resolve()
            flags = self.plain(shlex.split(entry["command"]))
            for part in self.parts(source):
                if root in part.parents:
                    name = str(part.relative_to(root))
                    self.flags[name] = flags
                    self.search[name] = [pathlib.Path(f[2:]).resolve() for f in flags if f.startswith("-I")]
                    self.unit[name] = str(source) if part != source else ""

    @staticmethod
    def parts(source):
        """The sources that CMake compiles as one, or the one source."""
        if source.parent.name != "Unity":
            return [source]
        return [pathlib.Path(name).resolve() for name in INCLUDE.findall(source.read_text())]

    @staticmethod
    def plain(command):
        """The compiler's flags alone: no files, and no `-include` of a precompiled header."""
        flags, words = [], iter(command[1:])
        for word in words:
            if word in ("-o", "-c", "-MF", "-MT"):
                next(words, None)
            elif word == "-include":
                header = next(words)
                flags += [] if "cmake_pch" in header else [word, header]
            elif word not in ("-Winvalid-pch", "-MD"):
                flags.append(word)
        return flags


class Includes:
    """Which files of ours a source reads."""

    def __init__(self):
        self.text, self.found = {}, {}

    def read(self, file):
        if file not in self.text:
            self.text[file] = pathlib.Path(file).read_bytes()
        return self.text[file]

    def closure(self, source, search):
        """`source` and all that it includes by quotes, as paths from here."""
        root, seen, left = pathlib.Path.cwd(), set(), [source]
        while left:
            file = left.pop()
            if file in seen:
                continue
            seen.add(file)
            for name in INCLUDE.findall(self.read(file).decode("utf-8", "replace")):
                for folder in [(root / file).parent, *search]:
                    path = pathlib.Path(os.path.normpath(folder / name))
                    if path.is_file() and root in path.parents:
                        left.append(str(path.relative_to(root)))
                        break
        return seen


def changed_since_record():
    """Names of files that differ from the recorded commit; None if that cannot be told."""
    words = RECORD.read_text().split() if RECORD.exists() else []
    differ = git("diff", "--name-only", words[0], "--") if words else None
    new = git("ls-files", "--others", "--exclude-standard", "--", *SOURCES, *RULES)
    if differ is None or new is None or set(RULES) & {*differ, *new}:
        return None
    return {*differ, *new}


def record():
    """Notes the commit that is checked out, if it is what was checked."""
    dirty = git("status", "--porcelain", "--untracked-files=all", "--", *SOURCES, *RULES)
    head = git("rev-parse", "HEAD")
    if dirty or not head:
        print("check_tidy.sh: the tree has changes, so .clang-tidy-passed stays as it is")
        return
    RECORD.write_text(head[0] + "\n")
    print(f"check_tidy.sh: .clang-tidy-passed is {head[0]} now; commit it")


class Tidy:
    """Runs clang-tidy and remembers what passed."""

    def __init__(self, program, build):
        self.program, self.build = program, build
        self.folder = build.folder / "tidy"
        (self.folder / "passed").mkdir(parents=True, exist_ok=True)

    def command(self, file, flags):
        return [self.program, *QUIET, str(file), "--", *flags]

    def check(self, batch):
        """Sources of `batch` that have findings, which are printed. A source is (name, key)."""
        name, flags = batch[0][0], self.build.flags[batch[0][0]]
        if len(batch) > 1:
            name = self.folder / (hashlib.sha1(repr(batch).encode()).hexdigest() + ".cpp")
            name.write_text("".join(f'#include "{os.path.abspath(source)}"'
                                    "  // NOLINT(bugprone-suspicious-include)\n"
                                    for source, _ in batch))
        done = subprocess.run(self.command(name, flags), capture_output=True, text=True, check=False)
        if len(batch) > 1:
            name.unlink()
        if done.returncode == 0:
            for _, key in batch:
                (self.folder / "passed" / key).touch()
            return []
        if len(batch) > 1:
            middle = len(batch) // 2
            return self.check(batch[:middle]) + self.check(batch[middle:])
        # --quiet still counts what it suppressed.
        said = [l for l in done.stderr.splitlines() if not re.match(r"\d+ warnings? ", l)]
        print("\n".join([done.stdout.rstrip(), *said]), flush=True)
        return [batch[0][0]]


def chosen(build, includes, arguments):
    """(source, key) of all that is to be checked, and how many there are altogether."""
    named = [a for a in arguments if a != "--all"]
    if named:
        names = [str(pathlib.Path(n).resolve().relative_to(pathlib.Path.cwd())) for n in named]
    else:
        names = sorted(n for n in build.flags if n.startswith("src/") and
                       not n.startswith("src/ros/") and
                       not LEFT_OUT.search(includes.read(n).decode("utf-8", "replace")))
    names = [n for n in names if n in build.flags]
    changed = None if arguments else changed_since_record()
    rules = b"".join(includes.read(r) for r in RULES)
    picked = []
    for name in names:
        files = sorted(includes.closure(name, build.search[name]))
        if changed is not None and not changed.intersection(files):
            continue
        digest = hashlib.sha1(rules + repr(build.flags[name]).encode())
        for file in files:
            digest.update(file.encode() + b"\0" + includes.read(file))
        picked.append((name, digest.hexdigest()))
    return picked, len(names)


def batches(sources, build):
    """Lists of sources with the same flags, at least one list a processor: those that the build compiles as one
    together, for they share headers and no names. Others of one room go to different lists."""
    groups = {}
    for source in sources:
        groups.setdefault((tuple(build.flags[source[0]]), build.unit[source[0]]), []).append(source)
    size = max(1, min(BATCH, -(-len(sources) // (os.cpu_count() or 1))))
    lists = []
    for group in groups.values():
        count = -(-len(group) // size)
        lists += [group[k::count] for k in range(count)]
    return lists


def main(program, folder, *arguments):
    build, includes = Build(folder), Includes()
    picked, count = chosen(build, includes, arguments)
    if count == 0:
        sys.exit(f"check_tidy.sh: no such file is part of the build in {folder}")
    tidy = Tidy(program, build)
    left = [s for s in picked if not (tidy.folder / "passed" / s[1]).exists()]
    failed = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(tidy.check, batches(left, build)):
            failed += found
    if failed:
        sys.exit(f"clang-tidy: findings in {' '.join(failed)}")
    print(f"clang-tidy finds nothing in {count} files; {len(left)} of them were looked at.")
    if "--all" in arguments:
        record()


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
