#!/usr/bin/env bash
# Runs random scenes on all cores and says in which of them something blows up.
#
#   scripts/page.sh torture [--count N] [--seed S] [--out FOLDER] [--kept] [OPTION ...]
#
# By default 10000 scenes of seed 1 in build/torture; further options are those of `palpate torture`. Scenes
# that FOLDER has a line of are not run again, so that it goes on where it was stopped; a scene in which the
# program ends is noted as a crash, and the others go on. --kept goes on from docs/results/stability.csv.xz, the
# scenes that were run before, in a FOLDER that has none yet, and with --again runs also those of it that failed or
# were left off by another commit. It ends with FOLDER/stability.md and FOLDER/stability.csv.xz; copied to
# docs/results/ they are what this release does. Several machines: PART=i/n on each, on a FOLDER of its own, and the
# tables results_*.csv copied together.
#
# From the environment: JOBS (cores), PALPATE_NO_BUILD=1 takes the program that is built,
# PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
# shellcheck disable=SC1091
. scripts/env.sh

count=10000
seed=1
out=build/torture
kept=false
options=()
while [ $# -gt 0 ]; do
  case $1 in
    --count | --seed | --out) [ $# -gt 1 ] || { echo "$1 needs a value" >&2; exit 2; } ;;&
    --count) count=$2; shift 2 ;;
    --seed) seed=$2; shift 2 ;;
    --out) out=$2; shift 2 ;;
    --kept) kept=true; shift ;;
    *) options+=("$1"); shift ;;
  esac
done

if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then scripts/build.sh palpate; fi
program=${BUILD_DIR:-build}/devel/lib/palpate/palpate
jobs=${JOBS:-$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)}
first=0 of=1
if [ -n "${PART:-}" ]; then first=$((${PART%/*} - 1)) of=${PART#*/}; fi
mkdir -p "$out"
if $kept && ! compgen -G "$out/results*.csv" >/dev/null; then xz -dc docs/results/stability.csv.xz >"$out/results.csv"; fi
commit=$(git rev-parse --short=12 HEAD 2>/dev/null || echo -)
if [ -n "$(git status --porcelain -- . ':!docs' 2>/dev/null)" ]; then commit+=-dirty; fi

# One core's part; where the program ended by itself it is started again, and notes that.
part() {
  local status
  while true; do
    status=0
    "$program" torture --count "$count" --seed "$seed" --out "$out" --part "$1" --commit "$commit" \
      "${@:2}" || status=$?
    if [ "$status" -lt 126 ]; then return "$status"; fi
    if [ "$status" = 130 ] || [ "$status" = 143 ]; then return "$status"; fi  # it was asked to
  done
}
export -f part
export program count seed out commit

parts=()
for ((k = 0; k < jobs; ++k)); do parts+=("$((first * jobs + k + 1))/$((of * jobs))"); done
failed=0
if command -v parallel >/dev/null; then
  parallel --line-buffer -j "$jobs" part {} "${options[@]@Q}" ::: "${parts[@]}" || failed=1
else
  printf '%s\0' "${parts[@]}" |
    xargs -0 -P "$jobs" -I{} bash -c 'part "$@"' part {} "${options[@]}" || failed=1
fi

"$program" torture --report "$out" >"$out/stability.md"
"$program" torture --table "$out" | xz -9e >"$out/stability.csv.xz"
grep -m1 ' scenes: ' "$out/stability.md"
echo "$out/stability.md  $out/stability.csv.xz"
exit $failed
