#!/usr/bin/env bash
# Gives what reads files those that libFuzzer makes, on all cores, and says what became of them.
#
#   scripts/checks/fuzz.sh [--quick] [--seconds S | --executions N] [TARGET ...]
#
#   --quick         only what reads files is built for fuzzing, in build-fuzz-quick/; the rest of the
#                   core is that of build/ (scripts/test.sh runs so, 2000 files of each, always the same)
#   --seconds S     of each target; by default 60
#   --executions N  of each target
#   TARGET          a kind of file; by default all. `scripts/checks/fuzz.sh --list` prints them
#
# What a target has found to be new stays in build-fuzz/corpus/TARGET, so that the next run goes on from
# there. Files with which something was wrong lie in build-fuzz/crashes/TARGET, beside those that took more
# than ten seconds (`slow`). Exit status 1: there are some of the former; the command that tries one again
# is printed.
#
# From the environment: JOBS (cores), PALPATE_NO_BUILD=1 takes the programs that are built,
# PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

die() {
  echo "fuzz.sh: $*" >&2
  exit 2
}

quick=false
list=false
limit=(-max_total_time=60)
chosen=()
while [ $# -gt 0 ]; do
  case $1 in
    --quick) quick=true ;;
    --list) list=true ;;
    --seconds | --executions)
      case ${2:-} in '' | *[!0-9]*) die "$1 needs a number" ;; esac
      if [ "$1" = --seconds ]; then limit=("-max_total_time=$2"); else limit=("-runs=$2"); fi
      shift ;;
    -h | --help) sed -n '2,20s/^# \{0,1\}//p' "$0"; exit 0 ;;
    -*) die "unknown option '$1'; see --help" ;;
    *) chosen+=("$1") ;;
  esac
  shift
done

folder=build-fuzz
options=(-timeout=30 -rss_limit_mb=3000 -print_final_stats=1)
cmake=(-DPALPATE_FUZZ=ON -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=)
programs=(palpate_fuzz palpate_fuzz_bag)
if $quick; then
  folder=build-fuzz-quick
  core=$(find "$PWD/build" -name 'libpalpate_core.so' -o -name 'libpalpate_core.a' | head -n 1)
  [ -n "$core" ] || die "--quick needs build/; run scripts/build.sh"
  cmake+=("-DPALPATE_FUZZ_CORE=$core")
  programs=(palpate_fuzz)
  options+=(-seed=1)
elif [ ! -d /usr/share/catkin ]; then
  programs=(palpate_fuzz)
fi

if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build test dev; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then
  BUILD_DIR=$folder BUILD_TYPE=RelWithDebInfo CMAKE_ARGS="${cmake[*]}" \
    scripts/build.sh "${programs[@]}"
fi

# Temporary files in memory, where there is such a file system.
TMPDIR=$(mktemp -d -p "$(if [ -w /dev/shm ]; then echo /dev/shm; else echo /tmp; fi)" palpate_fuzz_XXXXXX)
trap 'rm -rf "$TMPDIR"' EXIT
export TMPDIR OMP_THREAD_LIMIT=1 OPENBLAS_NUM_THREADS=1 UBSAN_OPTIONS=print_stacktrace=1
# Parts of a quick build do not tell the sanitizer how full their containers are.
export ASAN_OPTIONS=detect_container_overflow=0 PALPATE_FUZZ_TARGET

declare -A program_of
targets=()
for program in "${programs[@]}"; do
  binary=$(find "$folder" -name "$program" -type f -perm -u+x | head -n 1)
  [ -n "$binary" ] || die "$program is not built"
  while read -r target; do
    program_of[$target]=$binary
    targets+=("$target")
  done < <(PALPATE_FUZZ_TARGET=list "$binary" 2>/dev/null)
done
if $list; then
  printf '%s\n' "${targets[@]}"
  exit 0
fi
for target in "${chosen[@]}"; do
  [ -n "${program_of[$target]:-}" ] || die "no target '$target'; there are ${targets[*]}"
done
if [ ${#chosen[@]} -gt 0 ]; then targets=("${chosen[@]}"); fi

# Files of YAML share their words.
dictionary_of() {
  case $1 in scene | case | tissue) echo yaml ;; *) echo "$1" ;; esac
}

# run TARGET PROGRAM: leaves what libFuzzer says in logs/TARGET.
run() {
  local target=$1 program=$2 status=0 extra=()
  local corpus=$folder/corpus/$target crashes=$folder/crashes/$target
  mkdir -p "$corpus" "$crashes" "$folder/seeds/$target" "$folder/logs"
  PALPATE_FUZZ_TARGET=$target PALPATE_FUZZ_SEEDS=$folder/seeds/$target "$program" >/dev/null 2>&1
  local dictionary
  dictionary=test/fuzz/dictionaries/$(dictionary_of "$target").dict
  if [ -f "$dictionary" ]; then extra+=("-dict=$dictionary"); fi
  extra+=("$corpus" "$folder/seeds/$target")
  local kept
  for kept in "test/fuzz/seeds/$target" "test/fuzz/regressions/$target"; do
    if [ -d "$kept" ]; then extra+=("$kept"); fi
  done
  PALPATE_FUZZ_TARGET=$target "$program" "${options[@]}" "${limit[@]}" \
    -artifact_prefix="$crashes/" "${extra[@]}" >"$folder/logs/$target" 2>&1 || status=$?
  echo "status: $status" >>"$folder/logs/$target"
}

# number TARGET NAME: what libFuzzer says of itself at the end.
number() { sed -n "s/^stat::$2: *//p" "$folder/logs/$1" | tail -n 1; }

jobs=${JOBS:-$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)}
if $quick; then rm -rf "${folder:?}/corpus"; fi # the same files each time
commit=$(git rev-parse --short HEAD 2>/dev/null || echo unknown)
running=0
for target in "${targets[@]}"; do
  if [ "$running" -ge "$jobs" ]; then
    wait -n || true
    running=$((running - 1))
  fi
  run "$target" "${program_of[$target]}" &
  running=$((running + 1))
done
wait

failed=0
replay=()
format='%-12s %12s %8s %9s %8s %8s %8s\n'
# shellcheck disable=SC2059  # one format for all rows
printf "$format" target executions 'per s' coverage new slow crashes
for target in "${targets[@]}"; do
  log=$folder/logs/$target
  executions=$(number "$target" number_of_executed_units)
  coverage=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
  # A slow file came to its end all the same: libFuzzer keeps those of more than ten seconds.
  slow=$(find "$folder/crashes/$target" -type f -name 'slow-unit-*' | wc -l)
  mapfile -t found < <(find "$folder/crashes/$target" -type f ! -name 'slow-unit-*' | sort)
  # shellcheck disable=SC2059
  printf "$format" "$target" "${executions:--}" "$(number "$target" average_exec_per_sec)" \
    "${coverage:--}" "$(number "$target" new_units_added)" "$slow" "${#found[@]}"
  printf '%s\t%s\t%s\n' "$commit" "$target" "${executions:-0}" >>"$folder/executions.tsv"
  if [ ${#found[@]} -gt 0 ]; then
    failed=1
    replay+=("PALPATE_FUZZ_TARGET=$target ${program_of[$target]} ${found[0]}")
  elif ! grep -qx 'status: 0' "$log"; then
    failed=1
    replay+=("see $log")
  fi
done
if [ "$failed" -ne 0 ]; then printf '\nTo try one again:\n'; printf '  %s\n' "${replay[@]}"; fi
exit "$failed"
