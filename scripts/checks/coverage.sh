#!/usr/bin/env bash
# Runs the tests of the core and of the command line with counters in every line of the core, and says how much of
# each room they reach, and which errors none of them raises: build/coverage/coverage.md, which is copied to docs/results/
# for a release, and lines.json.
#
#   scripts/checks/coverage.sh [--report] [CTEST_REGEX]
#
#   --report     only the report, of what has run already
#   CTEST_REGEX  only the tests whose names match
#
# Only the core is built anew, in build-coverage/; the tests of build/ run with it in place of their own. Nodes are
# left out: what rostests reach of the core is not counted. Two cores compile the core for half an hour, and
# take hours for the tests. Exit status 1: a test failed. From the environment: PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

report=false only=
for argument in "$@"; do
  case $argument in
    -h | --help) sed -n '2,14s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --report) report=true ;;
    -*) echo "coverage.sh: unknown option '$argument'; see --help" >&2; exit 2 ;;
    *) only=$argument ;;
  esac
done
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build test dev coverage; fi

out=build/coverage
mkdir -p "$out"
status=0
cores=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)
if ! $report; then
  scripts/build.sh all tests
  # With -Bsymbolic it calls its own inline functions, which count, not those of a test; nor does it see the table
  # of models that changing_mesh_test has in place of its own.
  BUILD_DIR=build-coverage BUILD_TYPE=RelWithDebInfo \
    CXXFLAGS="-O1 -fno-omit-frame-pointer --coverage -fprofile-update=atomic" \
    CMAKE_ARGS="-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-g1 -DCMAKE_SHARED_LINKER_FLAGS=-Wl,-Bsymbolic" \
    scripts/build.sh palpate_core
  find build-coverage -name '*.gcda' -delete
  # shellcheck disable=SC1091
  . scripts/env.sh
  core=$(find "$PWD/build-coverage" -name libpalpate_core.so | head -n 1)
  export LD_LIBRARY_PATH="${core%/*}:${LD_LIBRARY_PATH:-}"
  (cd build && ctest -j "$cores" --timeout 1800 -E '^(_ctest_|soak$|changing_mesh_test$)' ${only:+-R "$only"} --output-on-failure </dev/null) \
    >"$out/tests.log" 2>&1 || status=1
  grep -E '^ *[0-9]+% tests passed|\((Failed|Timeout|SEGFAULT)\)$' "$out/tests.log" || true
fi
[ -d build-coverage ] || { echo "coverage.sh: --report: nothing has run yet" >&2; exit 2; }
gcovr --root . --filter src/ --filter include/ --exclude-throw-branches --exclude-unreachable-branches \
  --gcov-ignore-parse-errors -j "$cores" --json "$out/lines.json" build-coverage
# Of a run that was cut short not all tests came to their end.
ended=$(grep -oE 'Test +#[0-9]+: .*Passed' "$out/tests.log" | grep -oE '#[0-9]+' | sort -u | wc -l || true)
all=$(grep -oE '/[0-9]+ Test +#' "$out/tests.log" | grep -oE '[0-9]+' | sort -n | tail -n 1 || true)
commit=$(git rev-parse --short=12 HEAD 2>/dev/null || echo -)
if [ -n "$(git status --porcelain -- . ':!docs' 2>/dev/null)" ]; then commit+=-dirty; fi
/usr/bin/python3 -B scripts/checks/coverage.py "$out/lines.json" --commit "$commit" --tests "$ended of $all" >"$out/coverage.md"
head -n 40 "$out/coverage.md"
echo "$out/coverage.md"
exit "$status"
