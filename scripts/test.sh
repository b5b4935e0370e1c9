#!/usr/bin/env bash
# Installs what is missing, builds, runs every check and every test, and counts.
#
#   scripts/test.sh [--no-checks] [--sanitize=thread] [CTEST_REGEX]
#
#   --no-checks         only the tests, not format, tidy and the like
#   --sanitize=thread   those tests of the core that name threads, with ThreadSanitizer, in
#                       build-sanitize-thread/; other sanitizers: scripts/checks/check_addresses.sh
#   CTEST_REGEX         only the tests whose names match; implies --no-checks
#
# From the environment: PALPATE_NO_INSTALL=1 leaves the system's packages alone, PALPATE_EXTRA_DATA
# names a folder of further meshes and instruments (default: ../shared/data where that exists).
# The last line is 'N passed, N failed', with ', N skipped' if any.
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

checks=true
threads=false
only=
for argument in "$@"; do
  case $argument in
    --no-checks) checks=false ;;
    --sanitize=thread) threads=true checks=false ;;
    -h | --help) sed -n '2,13s/^# \{0,1\}//p' "$0"; exit 0 ;;
    -*) echo "test.sh: unknown option '$argument'; see --help" >&2; exit 1 ;;
    *) only=$argument checks=false ;;
  esac
done

if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build test dev; fi
if [ -z "${PALPATE_EXTRA_DATA:-}" ] && [ -d ../shared/data ]; then
  PALPATE_EXTRA_DATA=$(cd ../shared/data && pwd)
  export PALPATE_EXTRA_DATA
fi

targets=(all tests)
if $threads; then
  # ROS's own libraries are not instrumented, so the core and the command line only.
  mapfile -t targets < <(
    grep -rlE 'ThreadPool|Background|std::(thread|async|atomic)' test --include='*_test.cpp' |
      grep -v '^test/ros/' | sed 's|.*/||; s|\.cpp$||' | sort)
  only=${only:-^($(IFS='|'; echo "${targets[*]}"))\$}
  BUILD_DIR=build-sanitize-thread
  export BUILD_TYPE=RelWithDebInfo
  export CXXFLAGS="-O1 -fno-omit-frame-pointer -fsanitize=thread -fno-sanitize-recover=all"
  export CMAKE_ARGS="-DCMAKE_DISABLE_FIND_PACKAGE_catkin=ON -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-g1"
  # libgomp and OpenBLAS are not instrumented: what their threads hand on looks like a race.
  export OMP_THREAD_LIMIT=1 OPENBLAS_NUM_THREADS=1 TSAN_OPTIONS=halt_on_error=1
fi
export BUILD_DIR=${BUILD_DIR:-build}

passed=0 failed=0 skipped=0 failures=() said=() left_out_tests=()
finish() {
  if [ ${#said[@]} -gt 0 ]; then printf '\n%s\n' "${said[@]}"; fi
  if [ ${#left_out_tests[@]} -gt 0 ]; then printf '\nSkipped:\n'; printf '  %s\n' "${left_out_tests[@]}"; fi
  if [ ${#failures[@]} -gt 0 ]; then printf '\nFailed:\n'; printf '  %s\n' "${failures[@]}"; fi
  echo
  if [ "$skipped" -gt 0 ]; then
    echo "$passed passed, $failed failed, $skipped skipped"
  else
    echo "$passed passed, $failed failed"
  fi
  [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
}

# check NAME COMMAND ...: counts as one test. What a failed one said stands at the end once more, and
# what any warns of.
check() {
  local name=$1 log
  shift
  echo "== $name"
  log=$(mktemp)
  if "$@" 2>&1 | tee "$log"; then
    passed=$((passed + 1))
    mapfile -t -O ${#said[@]} said < <(grep '^WARNING: ' "$log" || true)
  else
    failed=$((failed + 1))
    failures+=("$name")
    said+=("== $name"$'\n'"$(tail -n 40 "$log")")
  fi
  rm -f "$log"
}

# run_ctest ARGUMENT ...: counts what ctest says, by case where a test has several.
run_ctest() {
  local log status counted line p f s
  log=$(mktemp)
  status=0
  (cd "$BUILD_DIR" && ctest --output-on-failure --timeout 600 "$@" </dev/null 2>&1) |
    grep --line-buffered -vE '^ +Start +[0-9]+:' | tee "$log" || status=$?
  counted=$(/usr/bin/python3 -B scripts/count_tests.py "$log" "$BUILD_DIR/Testing/Temporary/LastTest.log")
  read -r p f s <<<"$counted"
  passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
  while read -r line; do
    case $line in
      'skipped '*) left_out_tests+=("${line#skipped }") ;;
      'failed '*) failures+=("${line#failed }") ;;
    esac
  done <<<"$counted"
  if [ "$status" -ne 0 ] && [ "$f" -eq 0 ]; then
    failed=$((failed + 1))
    failures+=("ctest $* (exit status $status)")
  fi
  rm -f "$log"
}

start=$SECONDS
if ! scripts/build.sh "${targets[@]}"; then
  failed=1 failures=(build)
  finish
  exit 1
fi
echo "built in $((SECONDS - start)) s"

if $checks; then
  check "core is free of ROS" scripts/checks/check_core_is_ros_free.sh
  check "order of the rooms" scripts/checks/check_rooms.py
  check "check of the rooms finds what is wrong" scripts/checks/check_rooms.py --self-test
  check "format" scripts/checks/check_format.sh
  check "origin of the measured pages" scripts/checks/check_pages.py
  check "changelog" scripts/checks/check_changelog.sh
  check "package" scripts/checks/check_package.sh
  check "configuring without gtest" scripts/checks/check_configure.sh
  start=$SECONDS
  check "clang-tidy" scripts/checks/check_tidy.sh
  echo "tidy took $((SECONDS - start)) s"
  start=$SECONDS
  check "files made to harm" \
    env -u CMAKE_ARGS PALPATE_NO_INSTALL=1 scripts/checks/fuzz.sh --quick --executions 2000
  echo "files made to harm took $((SECONDS - start)) s"
  start=$SECONDS
  check "races" env -u CMAKE_ARGS PALPATE_NO_INSTALL=1 scripts/checks/check_threads.sh
  echo "races took $((SECONDS - start)) s"
  start=$SECONDS
  check "addresses" env -u CMAKE_ARGS PALPATE_NO_INSTALL=1 scripts/checks/check_addresses.sh --quick
  echo "addresses took $((SECONDS - start)) s"
fi

# As many at once as there are cores, which are counted before OMP_THREAD_LIMIT is set: nproc heeds it.
cores=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)
# Tests with a ROS graph are marked RUN_SERIAL: each brings its own master, and they measure time.
unset ROS_MASTER_URI
# shellcheck disable=SC1091
. scripts/env.sh
start=$SECONDS
run_ctest -j "$cores" --no-tests=error ${only:+-R "$only"}
echo "tests took $((SECONDS - start)) s"
finish
