#!/usr/bin/env bash
# Fails if package.xml is not valid, disagrees with CMakeLists.txt about the version, or if a launch
# or URDF file is not well-formed XML, or a script of shell or Python does not parse.
set -euo pipefail
cd "$(dirname "$0")/../.."
/usr/bin/python3 - <<'PYTHON'
import glob
import re
import sys
import xml.etree.ElementTree

from catkin_pkg.package import parse_package

problems = []
package = parse_package("package.xml")
package.validate()
cmake = open("CMakeLists.txt", encoding="utf-8").read()
version = re.search(r"project\(\s*palpate\s+VERSION\s+([\d.]+)", cmake)
if not version or version.group(1) != package.version:
    problems.append("CMakeLists.txt and package.xml (%s) give different versions" % package.version)
listed = {d.name for d in package.build_depends + package.buildtool_depends}
components = re.search(r"find_package\(catkin[^)]*COMPONENTS([^)]*)\)", cmake)
for component in components.group(1).split() if components else []:
    if component not in listed:
        problems.append("CMakeLists.txt looks for %s, package.xml does not name it" % component)
for pattern in ("launch/*.launch", "test/**/*.launch", "test/**/*.test", "config/**/*.urdf"):
    for path in glob.glob(pattern, recursive=True):
        try:
            xml.etree.ElementTree.parse(path)
        except xml.etree.ElementTree.ParseError as error:
            # Tests may hold files that are broken on purpose; they say so in their name.
            if "bad" not in path and "broken" not in path:
                problems.append("%s: %s" % (path, error))
for folder in ("benchmarks", "scripts", "test"):
    for path in glob.glob(folder + "/**/*.py", recursive=True):
        try:
            compile(open(path, encoding="utf-8").read(), path, "exec")
        except SyntaxError as error:
            problems.append("%s:%s: %s" % (path, error.lineno, error.msg))
for problem in problems:
    print(problem, file=sys.stderr)
sys.exit(1 if problems else 0)
PYTHON
# Errors only. Ignored: messages are no part of what we export (MISSING_CATKIN_DEPEND); libraries that
# are found without catkin and roslaunch, an exec_depend that the tests use (the other two).
if command -v catkin_lint >/dev/null; then
  catkin_lint -q -W0 --ignore MISSING_CATKIN_DEPEND --ignore UNCONFIGURED_BUILD_DEPEND \
    --ignore MISSING_DEPEND .
fi
for script in scripts/*.sh scripts/*/*.sh .ci/run; do bash -n "$script"; done
echo "package.xml, launch files and scripts are well-formed."
