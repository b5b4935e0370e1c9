#!/usr/bin/env bash
# Configures and builds into build/.
#
#   scripts/build.sh [TARGET ...]      default: all (tests are the target `tests`)
#
# From the environment: BUILD_DIR (build), BUILD_TYPE (Release), JOBS, CMAKE_ARGS (more options).
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

build_dir=${BUILD_DIR:-build}
build_type=${BUILD_TYPE:-Release}
if [ $# -eq 0 ]; then set -- all; fi

# One source, CGAL's meshing, needs 3.4 GB to compile: not more jobs than memory carries.
if [ -z "${JOBS:-}" ]; then
  JOBS=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)  # which heeds them
  memory_jobs=$(awk '/MemAvailable/ {print int($2 / 3145728)}' /proc/meminfo 2>/dev/null || echo 1)
  if [ "${memory_jobs:-1}" -lt "$JOBS" ]; then JOBS=$memory_jobs; fi
  if [ "$JOBS" -lt 1 ]; then JOBS=1; fi
fi

generator=()
if [ ! -f "$build_dir/CMakeCache.txt" ] && command -v ninja >/dev/null; then generator=(-G Ninja); fi

step() {
  echo "+ $*"
  "$@"
}
# shellcheck disable=SC2086  # CMAKE_ARGS is a list of words
step cmake -S . -B "$build_dir" "${generator[@]}" \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$PWD/scripts/compiler_launcher.sh" \
  -DCMAKE_BUILD_TYPE="$build_type" ${CMAKE_ARGS:-}
step cmake --build "$build_dir" -j "$JOBS" --target "$@"
