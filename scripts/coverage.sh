#!/usr/bin/env bash
# Runs the tests of the core and of the command line with counters in every line, and says how much of each room
# they reach, and which errors none of them raises: build/coverage/coverage.md and build/coverage/lines.json.
#
#   scripts/coverage.sh [--sanitize | --report]
#
#   --sanitize   with AddressSanitizer and UBSan in the same build, as scripts/test.sh --sanitize: one run for both
#   --report     only the report, of what has run already
#
# The nodes are left out: a graph's processes are tested by rostest, which this build has none of. Two cores build
# for more than an hour. From the environment: PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

sanitize=() report=false
for argument in "$@"; do
  case $argument in
    -h | --help) sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --sanitize) sanitize=(--sanitize) ;;
    --report) report=true ;;
    *) echo "coverage.sh: unknown option '$argument'; see --help" >&2; exit 2 ;;
  esac
done
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build test dev coverage; fi

out=build/coverage
mkdir -p "$out"
status=0
if ! $report; then
  if [ -d build-coverage ]; then find build-coverage -name '*.gcda' -delete; fi
  PALPATE_NO_INSTALL=1 scripts/test.sh --coverage "${sanitize[@]}" || status=$?
fi
[ -d build-coverage ] || { echo "coverage.sh: --report: nothing has run yet" >&2; exit 2; }
gcovr --root . --filter src/ --filter include/ --exclude-throw-branches --exclude-unreachable-branches \
  --gcov-ignore-parse-errors -j "$(nproc)" --json "$out/lines.json" build-coverage
/usr/bin/python3 -B scripts/coverage.py "$out/lines.json" >"$out/coverage.md"
head -n 40 "$out/coverage.md"
echo "$out/coverage.md"
exit "$status"
