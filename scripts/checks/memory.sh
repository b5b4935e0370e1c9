#!/usr/bin/env bash
# Runs a replay, and a node from start to stop, under valgrind, and says whether memory is read, written or
# left behind as it must not be. Takes some minutes.
#
#   scripts/checks/memory.sh [--scene S] [--seconds T]
#
#   --scene S     the name of a shipped scene that has a trajectory of its own (slab_probe)
#   --seconds T   how long the node runs between start and stop (20)
#
# Any error makes the exit status 1, in libraries as well. Valgrind knows no AVX-512: the kernels run that this
# processor has besides. From the environment: PALPATE_NO_BUILD=1 takes the programs that are built,
# PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
scene=slab_probe seconds=20
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --scene | --seconds) [ $# -gt 1 ] || { echo "memory.sh: $1 needs a value" >&2; exit 2; } ;;&
    --scene) scene=$2; shift 2 ;;
    --seconds) seconds=$2; shift 2 ;;
    *) echo "memory.sh: unknown option '$1'; see --help" >&2; exit 2 ;;
  esac
done
if [ ! -f "config/scenes/$scene.yaml" ] || [ ! -f "config/trajectories/$scene.csv" ]; then
  echo "memory.sh: --scene $scene: must have config/scenes/$scene.yaml and config/trajectories/$scene.csv" >&2
  exit 2
fi
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build memory; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then scripts/build.sh palpate palpate_node; fi
unset ROS_MASTER_URI # a graph of our own
# shellcheck disable=SC1091
. scripts/env.sh
programs=${BUILD_DIR:-build}/devel/lib/palpate
unset OPENBLAS_CORETYPE # it would ask for AVX-512

out=build/memory
mkdir -p "$out"
check=(valgrind --error-exitcode=9 --leak-check=full --show-leak-kinds=definite
  --errors-for-leak-kinds=definite --num-callers=30)
failed=0

# say NAME STATUS: of the program whose log is NAME.log.
say() {
  grep -h 'ERROR SUMMARY' "$out/$1.log" | sed "s/^==[0-9]*==/$1:/" || true
  if [ "$2" -ne 0 ]; then
    echo "memory.sh: $1 ended with status $2; see $out/$1.log" >&2
    failed=1
  fi
}

trajectory=$out/short.csv
head -n 150 config/trajectories/"$scene".csv >"$trajectory"
status=0
"${check[@]}" "$programs/palpate" replay config/scenes/"$scene".yaml \
  --trajectory "$trajectory" --out "$out/replay.csv" >"$out/replay.log" 2>&1 || status=$?
say replay "$status"

roscore -p "${ROS_MASTER_URI##*:}" >"$out/roscore.log" 2>&1 &
master=$!
trap 'kill "$master" 2>/dev/null || true; wait' EXIT
"${check[@]}" "$programs/palpate_node" __name:=palpate _scene:="$scene" _save_state_at_end:=false \
  >"$out/node.log" 2>&1 &
node=$!
for ((k = 0; k < 180; ++k)); do
  if rosservice list 2>/dev/null | grep -q '^/palpate/reset$'; then break; fi
  if ! kill -0 "$node" 2>/dev/null || ! kill -0 "$master" 2>/dev/null; then break; fi
  sleep 1
done
sleep "$seconds"
kill -INT "$node" 2>/dev/null || true
status=0
wait "$node" || status=$?
say node "$status"
exit "$failed"
