#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails if a room uses one that is not above it, another room's private header, or a library that it
must not see, or if a file of a room with folders uses one of a folder that is not above its own.
scripts/rooms.txt says what is right.

    scripts/checks/check_rooms.py [--self-test]

--self-test: breaks each rule in a small tree and looks whether that is said.
"""
import pathlib
import re
import sys
import tempfile

LIBRARIES = {  # how their headers' names begin
    "Eigen": ["Eigen/"],
    "yaml-cpp": ["yaml-cpp/"],
    "CGAL": ["CGAL/"],
    "zlib": ["zlib.h"],
    "tinyxml2": ["tinyxml2.h"],
    "SuiteSparse": ["cholmod", "SuiteSparse", "amd.h", "colamd.h", "camd.h", "ccolamd.h"],
    "urdfdom": ["urdf_model/", "urdf_parser/", "urdf_world/", "urdf_exception/", "console_bridge/"],
    "KDL": ["kdl/", "kdl_parser/"],
    "CLI11": ["CLI/"],
}
SYSTEM = re.compile(  # C++ has no '.' in its headers' names; then what we use of C, POSIX and the compiler
    r"[a-z_0-9]+$|(stdlib|locale|fcntl|unistd|dlfcn|sched|pthread|immintrin|malloc|time|errno)\.h$|sys/[a-z]+\.h$")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(["<])([^">]+)[">]')
SHARED_SOURCES = {"start"}  # rooms without include/ whose headers in src/ are for others


class Rooms:
    """What rooms.txt says: the order, the libraries of each room, public and in all, and its folders in src/."""

    def __init__(self, text):
        self.order, self.public, self.all, self.line, self.folders = [], {}, {}, {}, {}
        for number, line in enumerate(text.splitlines(), 1):
            goes_on = line.startswith(" ")
            line = line.split("#")[0].strip()
            if not line:
                continue
            if goes_on:
                self.folders.setdefault(self.order[-1], []).extend(line.split())
                continue
            name, libraries = line.split(":")
            public, private, folders = (libraries + ";;").split(";")[:3]
            if folders.strip():
                self.folders[name] = folders.split()
            self.order.append(name)
            self.line[name] = number
            self.public[name] = {"Eigen", *public.split()}
            self.all[name] = {*self.public[name], *private.split()}

    def sees(self, user, used):
        return self.order.index(used) <= self.order.index(user)

    def has_place(self, path):
        """Whether a file of src/ is in a folder of its room, if that has a list of folders."""
        order = self.folders.get(path.parts[0])
        return order is None or folder_of(path) in order

    def sees_folder(self, user, used):
        """Whether a file of src/ may include another one of its room by the order of the room's folders."""
        order = self.folders.get(user.parts[0])
        if order is None or user.name.endswith("_main.cpp") or not self.has_place(user) or not self.has_place(used):
            return True
        return order.index(folder_of(used)) <= order.index(folder_of(user))


def folder_of(path):
    """The folder of a file of src/ in its room, as rooms.txt names it; "." for the room's own."""
    return "/".join(path.parts[1:-1]) or "."


def sources(root, folder):
    return sorted(p for p in (root / folder).rglob("*") if p.suffix in (".h", ".cpp"))


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) == '"', match.group(2)


def library_of(name):
    for library, beginnings in LIBRARIES.items():
        if any(name.startswith(beginning) for beginning in beginnings):
            return library
    return None


def private_header(root, path, name):
    """The file in src/ that `name` in quotes means in `path`, or None."""
    places = [path.parent, root / "src", *sorted(p for p in (root / "src").iterdir() if p.is_dir())]
    for place in places:
        found = (place / name).resolve()
        if found.is_file() and (root / "src").resolve() in found.parents:
            return found
    return None


def check_include(root, rooms, path, room, quoted, name):
    """What is wrong with an include in a file of `room`, or None."""
    in_source = path.relative_to(root).parts[0] == "src"
    if ".." in name.split("/"):
        return f"'{name}' climbs out of its folder"
    if name.startswith("palpate/"):
        if not (root / "include" / name).is_file():
            generated = room == "ros" and name.count("/") == 1
            return None if generated else f"'{name}' is no header of ours"
        used = name.split("/")[1]
        if used not in rooms.order:
            return f"room '{room}' includes '{name}' of '{used}', which is no room"
        if not rooms.sees(room, used):
            return f"room '{room}' includes '{name}' of room '{used}', which is not above it"
        return None
    if quoted:
        found = private_header(root, path, name)
        if found is None:
            return f"room '{room}' includes '{name}', which is no header of ours"
        if not in_source:
            return f"a public header of room '{room}' includes '{name}' of src/"
        found = found.relative_to((root / "src").resolve())
        used = found.parts[0]
        if used != room and used not in SHARED_SOURCES:
            return f"room '{room}' includes the private header '{name}' of room '{used}'"
        if not rooms.sees(room, used):
            return f"room '{room}' includes '{name}' of room '{used}', which is not above it"
        user = path.relative_to(root / "src")
        if used == room and not rooms.sees_folder(user, found):
            return f"folder '{folder_of(user)}' of room '{room}' includes '{name}' of a folder that is not above it"
        return None
    library = library_of(name)
    allowed = (rooms.all if in_source else rooms.public)[room]
    if "*" in allowed or library in allowed or (library is None and SYSTEM.match(name)):
        return None
    where = "src/" if in_source else "public headers"
    what = f"{library}'s <{name}>" if library else f"<{name}>, which rooms.txt does not know"
    return f"room '{room}' includes {what}; {where} of this room may see {', '.join(sorted(allowed))}"


def check_page(root, rooms, present):
    """The tables in docs/architecture.md have the rooms and folders that there are, in their order."""
    page = root / "docs/architecture.md"
    lines = page.read_text(encoding="utf-8").splitlines()
    table = [m.group(1) for m in (re.match(r"\| `([a-z_/]+)`( \(src only\))? \|", line) for line in lines) if m]
    listed = [room for room in table if room in rooms.order]
    problems = []
    if listed != sorted(listed, key=rooms.order.index):
        problems.append(f"{page.relative_to(root)}: the table's order differs from rooms.txt: {listed}")
    for room in present:
        if room not in listed:
            problems.append(f"{page.relative_to(root)}: the table lacks room '{room}'")
    for room, order in rooms.folders.items():
        listed = [name for name in table if name.startswith(room + "/")]
        if listed != [f"{room}/{folder}" for folder in order if folder != "."]:
            problems.append(f"{page.relative_to(root)}: the table of folders of '{room}' differs from rooms.txt: {listed}")
    return problems


def check(root):
    """@returns (problems, number of includes looked at)"""
    rooms = Rooms((root / "scripts/rooms.txt").read_text(encoding="utf-8"))
    problems, count, present = [], 0, set()
    for top in ("include/palpate", "src"):
        for path in sources(root, top):
            inside = path.relative_to(root / top)
            where = path.relative_to(root)
            room = inside.parts[0]
            if len(inside.parts) < 2 or room not in rooms.order:
                problems.append(f"{where}: is in no room of scripts/rooms.txt")
                continue
            present.add(room)
            if top == "src" and not rooms.has_place(inside):
                problems.append(f"{where}: is in no folder that scripts/rooms.txt names of room '{room}'")
            for number, quoted, name in includes(path):
                count += 1
                wrong = check_include(root, rooms, path, room, quoted, name)
                if wrong:
                    problems.append(f"{where}:{number}: {wrong}")
    for room in rooms.order:
        if room not in present:
            problems.append(f"scripts/rooms.txt:{rooms.line[room]}: room '{room}' has no file in include/palpate or src")
    for top in ("test", "benchmarks"):
        for path in sources(root, top):
            for number, _, name in includes(path):
                count += 1
                if ".." in name.split("/"):
                    problems.append(f"{path.relative_to(root)}:{number}: '{name}' climbs out of its folder")
    return problems + check_page(root, rooms, sorted(present, key=rooms.order.index)), count


SELF_TEST_ROOMS = "base:\nmesh: ; CGAL ; . kernels\nfem:\nstart:\nros: ; * ; guard\n node/live node\ncli: ; CLI11\n"
SELF_TEST_PAGE = ("| `base` | \n| `mesh` | \n| `fem` | \n| `start` (src only) | \n| `ros` | \n| `cli` | \n"
                  "| `mesh/kernels` | \n| `ros/guard` | \n| `ros/node/live` | \n| `ros/node` | \n")
SELF_TEST_FILES = {  # all that is allowed
    "include/palpate/base/types.h": "#include <Eigen/Core>\n#include <vector>\n",
    "include/palpate/mesh/tets.h": '#include "palpate/base/types.h"\n',
    "src/mesh/fill.h": "",
    "src/mesh/fill.cpp": '#include <CGAL/Random.h>\n#include <unistd.h>\n#include "fill.h"\n',
    "src/mesh/kernels/wide.h": "",
    "src/mesh/kernels/wide.cpp": '#include "mesh/fill.h"\n',
    "src/fem/loads.cpp": '#include "palpate/mesh/tets.h"\n',
    "src/start/environment.h": "",
    "src/ros/node/live/thread.h": '#include "ros/guard/ending.h"\n',
    "src/ros/node/cycle.h": '#include "live/thread.h"\n#include "ros/guard/ending.h"\n',
    "src/ros/node/cycle.cpp": '#include <ros/ros.h>\n#include "environment.h"\n#include "palpate/StepReport.h"\n',
    "src/ros/guard/ending.h": "",
    "src/ros/guard/guard_main.cpp": '#include "ros/node/cycle.h"\n',
    "src/cli/main.cpp": '#include <CLI/CLI.hpp>\n#include "environment.h"\n',
    "test/mesh/fill_test.cpp": '#include "mesh/fill.h"\n',
}
SELF_TEST_BREAKS = [  # (file, its new line 1, what must be said of it)
    ("src/mesh/fill.cpp", '#include "palpate/fem/loads.h"', "'palpate/fem/loads.h' of room 'fem', which is not above"),
    ("src/fem/loads.cpp", '#include "mesh/fill.h"', "room 'fem' includes the private header 'mesh/fill.h' of room 'mesh'"),
    ("src/fem/loads.cpp", '#include "fill.h"', "room 'fem' includes the private header 'fill.h' of room 'mesh'"),
    ("src/fem/loads.cpp", '#include "../mesh/fill.h"', "climbs out"),
    ("src/fem/loads.cpp", "#  include <CGAL/Random.h>", "room 'fem' includes CGAL's <CGAL/Random.h>"),
    ("src/fem/loads.cpp", "#include <ros/ros.h>", "<ros/ros.h>, which rooms.txt does not know"),
    ("src/fem/loads.cpp", '#include "palpate/mesh/gone.h"', "is no header of ours"),
    ("src/fem/loads.cpp", '#include "environment.h"', "of room 'start', which is not above it"),
    ("include/palpate/mesh/tets.h", "#include <CGAL/Random.h>", "public headers of this room may see Eigen"),
    ("include/palpate/mesh/tets.h", '#include "mesh/fill.h"', "a public header of room 'mesh' includes"),
    ("src/cli/main.cpp", '#include "node.h"', "is no header of ours"),
    ("src/ros/guard/ending.h", '#include "ros/node/cycle.h"', "of a folder that is not above it"),
    ("src/ros/node/live/thread.h", '#include "ros/node/cycle.h"', "of a folder that is not above it"),
    ("src/mesh/fill.h", '#include "mesh/kernels/wide.h"', "folder '.' of room 'mesh' includes"),
    ("src/mesh/tables/fill.cpp", "", "is in no folder"),
    ("src/ros/node/dead/thread.h", "", "is in no folder"),
    ("src/ros/cycle.cpp", "", "is in no folder"),
    ("src/ros/pictures/view.cpp", "", "is in no folder"),
    ("test/mesh/fill_test.cpp", '#include "../../src/mesh/fill.h"', "climbs out"),
    ("src/attic/old.cpp", "", "is in no room"),
    ("scripts/rooms.txt", "gone:\n" + SELF_TEST_ROOMS, "room 'gone' has no file"),
    ("docs/architecture.md", SELF_TEST_PAGE.replace("| `mesh` | \n", ""), "lacks room 'mesh'"),
    ("docs/architecture.md", SELF_TEST_PAGE.replace("| `ros/node` | \n", ""), "table of folders of 'ros' differs"),
    ("docs/architecture.md", "| `fem` | \n" + SELF_TEST_PAGE.replace("| `fem` | \n", ""), "order differs"),
]


def self_test():
    files = {**SELF_TEST_FILES, "include/palpate/fem/loads.h": "", "scripts/rooms.txt": SELF_TEST_ROOMS,
             "docs/architecture.md": SELF_TEST_PAGE}
    failures = []
    for broken, line, wanted in [(None, "", None), *SELF_TEST_BREAKS]:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {**files, **({broken: line + "\n"} if broken else {})}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            said, _ = check(root)
        place = broken if broken is None or broken.endswith(".md") or not line else broken + ":1:"
        right = not said if broken is None else len(said) == 1 and wanted in said[0] and said[0].startswith(place)
        if not right:
            failures.append(f"{broken}: {line!r} gave {said}, not {wanted!r}")
    for failure in failures:
        print(failure, file=sys.stderr)
    print(f"{len(SELF_TEST_BREAKS) - len(failures)} of {len(SELF_TEST_BREAKS)} broken rules are found.")
    return not failures


def main():
    if sys.argv[1:] == ["--self-test"]:
        return 0 if self_test() else 1
    if sys.argv[1:]:
        print(__doc__.strip(), file=sys.stderr)
        return 1
    problems, count = check(pathlib.Path(__file__).resolve().parents[2])
    for problem in problems:
        print(problem, file=sys.stderr)
    if not problems:
        print(f"{count} includes keep to the order of the rooms.")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
