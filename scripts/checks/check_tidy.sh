#!/usr/bin/env bash
# Fails if clang-tidy 14 finds anything in the core or the command line. Needs a configured build.
#
#   scripts/checks/check_tidy.sh [--all | FILE ...]
#
# Without arguments it looks at the sources that, with the headers they include, have changed since
# the commit in .clang-tidy-passed. --all looks at every source and then renews that file; do so and
# commit it when many have changed since. scripts/checks/tidy.py does the work.
set -euo pipefail
cd "$(dirname "$0")/../.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
build_dir=${BUILD_DIR:-build}

tidy=$(command -v clang-tidy-14 || command -v clang-tidy) || {
  echo "check_tidy.sh: no clang-tidy; run scripts/install_dependencies.sh dev" >&2
  exit 1
}
if [ ! -f "$build_dir/compile_commands.json" ]; then
  echo "check_tidy.sh: $build_dir/compile_commands.json is missing; run scripts/build.sh" >&2
  exit 1
fi
exec /usr/bin/python3 scripts/checks/tidy.py "$tidy" "$build_dir" "$@"
