#!/usr/bin/env bash
# Runs the tests of the core and of the command line with AddressSanitizer, UBSan and the assertions of Eigen and of
# the standard library in the core.
#
#   scripts/checks/check_addresses.sh [--quick] [REGEX]
#
#   --quick  only the rooms that test/addresses/CMakeLists.txt names, and their tests
#   REGEX    only the tests whose names match
#
# Only the core is built anew, in build-addresses/, with --quick those rooms only, in build-addresses-quick/; the
# tests of build/ run with it in place of their own. Left out are those that have a malloc of their own, and those of
# the time that something takes. Two cores compile the whole core for half an hour. Exit status 1: a test failed, or
# took more than an hour.
#
# From the environment: PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

quick=false only=
for argument in "$@"; do
  case $argument in
    --quick) quick=true ;;
    -h | --help) sed -n '2,16s/^# \{0,1\}//p' "$0"; exit 0 ;;
    -*) echo "check_addresses.sh: unknown option '$argument'; see --help" >&2; exit 2 ;;
    *) only=$argument ;;
  esac
done

if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build test; fi
built=$(find "$PWD/build" -name libpalpate_core.so | head -n 1)
[ -n "$built" ] || { echo "check_addresses.sh: needs build/, with a shared core; run scripts/build.sh" >&2; exit 2; }

folder=build-addresses target=palpate_core rooms='[a-z]+' slow=blas_speed_test
cmake=(-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-g1)
# Tests free matrices that the core allocates: Eigen must not allocate in another way because of the sanitizer.
flags="-O1 -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS -DEIGEN_MALLOC_ALREADY_ALIGNED=1"
flags+=" -fsanitize=address,undefined -fno-sanitize-recover=all"
if $quick; then
  folder=build-addresses-quick target=palpate_addresses slow+='|far_samples_test|overlap_test'
  rooms=$(sed -n 's|^set(rooms "/src/(\(.*\))/")$|\1|p' test/addresses/CMakeLists.txt)
  cmake+=("-DPALPATE_ADDRESSES_BUILD=$PWD/build")
  # Of each pointer: a third of the time to compile, for what AddressSanitizer mostly sees as well.
  flags+=" -fno-sanitize=alignment,null,object-size,pointer-overflow,vptr"
fi
BUILD_DIR=$folder BUILD_TYPE=RelWithDebInfo CMAKE_ARGS="${cmake[*]}" CXXFLAGS=$flags scripts/build.sh "$target"

# Name, program and suites of each test that ctest knows, but of those that have a malloc of their own.
mapfile -t tests < <(
  (cd build && ctest --show-only=json-v1) | /usr/bin/python3 -c '
import json, re, sys
rooms, slow, only = sys.argv[1:]
for test in json.load(sys.stdin)["tests"]:
    name, command = test["name"], test.get("command", [])
    folder = next((p["value"] for p in test["properties"] if p["name"] == "WORKING_DIRECTORY"), "")
    if (len(command) == 2 and command[1].startswith("--gtest_filter=") and not re.search("/test/ros$", folder)
            and re.search(f"/test/({rooms})$", folder) and not re.fullmatch(slow, name) and re.search(only, name)):
        print(name, *command)' "$rooms" "$slow" "$only" |
    while read -r name program filter; do
      if [ -x "$program" ] && ! grep -qF __libc_malloc "$program"; then echo "$name $program $filter"; fi
    done | sort)
[ ${#tests[@]} -gt 0 ] || { echo "check_addresses.sh: no test that is built matches '$only'" >&2; exit 2; }

cores=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)
# shellcheck disable=SC1091
. scripts/env.sh
export UBSAN_OPTIONS=print_stacktrace=1 runtime core logs=$PWD/$folder/tests
runtime=$(c++ -print-file-name=libasan.so)
core=$(find "$PWD/$folder" -name libpalpate_core.so | head -n 1)
mkdir -p "$logs"
try() {
  local name=$1 start=$SECONDS status=0
  LD_PRELOAD=$runtime LD_LIBRARY_PATH=${core%/*}:${LD_LIBRARY_PATH:-} \
    timeout 3600 "$2" "$3" --gtest_brief=1 >"$logs/$name" 2>&1 </dev/null || status=$?
  if [ "$status" -ne 0 ]; then
    grep -m 1 -A 30 -E 'ERROR: |runtime error: |: Failure$' "$logs/$name" || tail -n 30 "$logs/$name"
  fi
  echo "$name: $(grep -oE '\[  PASSED  \] [0-9]+ tests?' "$logs/$name" | grep -oE '[0-9]+' || echo no) passed" \
    "in $((SECONDS - start)) s$(if [ "$status" -ne 0 ]; then echo ", FAILED with $status"; fi)"
  return "$status"
}
export -f try
printf '%s\n' "${tests[@]}" | xargs -P "$cores" -L1 bash -c 'try "$@" || exit 1' try || exit 1
echo "${#tests[@]} tests, nothing found"
