#!/usr/bin/env bash
# How regularly the wrench comes while a simulated hand holds the liver: with the cores free and busy,
# with real-time priority and without. Wants a machine on which nothing else runs.
#
#   scripts/checks/wire.sh [SECONDS]          20 s each
#
# From the environment: PALPATE_NO_BUILD=1 takes the programs that are built, PALPATE_NO_INSTALL=1
# installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-20}
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then scripts/build.sh; fi
# shellcheck disable=SC1091
. scripts/env.sh
programs=build/devel/lib/palpate
port=${ROS_MASTER_URI##*:}

children=()
stop() {
  for child in "${children[@]}"; do kill "$child" 2>/dev/null || true; done
  wait 2>/dev/null || true
  children=()
}
trap stop EXIT

run() {  # words for the eye, cores to keep busy, what the programs are started by
  local words=$1 busy=$2
  shift 2
  roscore -p "${port%/}" >/dev/null 2>&1 & children+=($!)
  until rosparam list >/dev/null 2>&1; do sleep 0.2; done
  rosparam set /palpate_device "{start: [-0.04, -0.025, -0.14, 0.0, 0.0, 0.0], way: 0.015, hold: 1000.0}"
  "$@" "$programs/palpate_node" __name:=palpate _scene:="$PWD/config/scenes/liver_palpation.yaml" \
    >build/wire_node.log 2>&1 & children+=($!)
  "$@" "$programs/palpate_device" >build/wire_device.log 2>&1 & children+=($!)
  until rosservice list 2>/dev/null | grep -q palpate/reset; do
    kill -0 "${children[1]}" 2>/dev/null || { echo "wire.sh: the node ended:" >&2; tail -5 build/wire_node.log >&2; exit 1; }
    sleep 0.2
  done
  sleep 4
  for ((k = 0; k < busy; ++k)); do yes >/dev/null & children+=($!); done
  printf '%-40s' "$words"
  "$programs/palpate_wire" _seconds:="$seconds"
  printf '%-40s' "  a program that only ticks beside it:"
  "$programs/palpate_wire" _seconds:="$seconds" _wrench:=""
  stop
}

cores=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)  # which heeds them
ordinary=(setpriv --bounding-set=-sys_nice --inh-caps=-sys_nice prlimit --rtprio=0)
run "real-time, cores free:" 0 env
run "real-time, all cores busy:" "$cores" env
run "ordinary priority, cores free:" 0 "${ordinary[@]}"
run "ordinary priority, all cores busy:" "$cores" "${ordinary[@]}"
