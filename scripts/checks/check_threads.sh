#!/usr/bin/env bash
# Looks for races with ThreadSanitizer in what hands work from thread to thread: the pool and what is done beside
# its loops, matrices and meshes that are made beside cycles, loops whose parts share memory and, with ROS, live
# cycles. Only that is compiled anew, in build-threads/; the rest of the core is that of build/. The whole of it:
# scripts/test.sh --sanitize=thread.
#
#   scripts/checks/check_threads.sh
#
# From the environment: PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
case ${1:-} in
  '') ;;
  -h | --help) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 0 ;;
  *) echo "check_threads.sh: unknown option '$1'; see --help" >&2; exit 2 ;;
esac

if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build test; fi
core=$(find "$PWD/build" -name 'libpalpate_core.so' -o -name 'libpalpate_core.a' | head -n 1)
[ -n "$core" ] || { echo "check_threads.sh: needs build/; run scripts/build.sh" >&2; exit 2; }
BUILD_DIR=build-threads BUILD_TYPE=RelWithDebInfo \
  CMAKE_ARGS="-DCMAKE_CXX_FLAGS_RELWITHDEBINFO= -DPALPATE_THREADS_CORE=$core" scripts/build.sh palpate_threads

# shellcheck disable=SC1091
. scripts/env.sh
# OpenMP and OpenBLAS are not instrumented: what their threads hand on looks like a race.
export OMP_THREAD_LIMIT=1 OPENBLAS_NUM_THREADS=1 TSAN_OPTIONS=halt_on_error=1
program=$(find build-threads -name palpate_threads -type f -perm -u+x | head -n 1)
# Where addresses of memory are drawn from 32 bits GCC's ThreadSanitizer finds no place for its own.
steady=()
if setarch -R true 2>/dev/null; then steady=(setarch -R); fi
if ! said=$("${steady[@]}" "$program" --gtest_list_tests 2>&1) && grep -q 'unexpected memory mapping' <<<"$said"; then
  echo "WARNING: ThreadSanitizer finds no place for its memory here: nothing was looked at"
  exit 0
fi
"${steady[@]}" "$program" --gtest_brief=1 \
  --gtest_filter='ThreadPool.*:LatestValue.*:StalePcg.*:*Threads*:*MeshAdaptation*:LiveCycleTest.*'
