#!/usr/bin/env bash
# A recorded master arm palpates the shipped liver: installs what is missing, builds, runs the ROS
# graph until the bag has ended, prints a table.
#
#   scripts/demo.sh [--device sim] [--rviz] [--screenshot FILE] [--rate R]
#   scripts/demo.sh --scene NAME
#
#   --scene NAME       instead of all that: a scene of config/scenes on its shipped trajectory, without
#                      ROS; leaves demo/NAME.csv, demo/NAME.png and a picture of the largest force
#   --device sim       a simulated hand on a simulated device, which feels the force, instead of the bag
#   --rviz             opens rviz on it
#   --screenshot FILE  renders rviz without a screen and saves a picture at the largest force
#   --rate R           speed of playing the bag (1; 0.4 with --screenshot, because drawing without a
#                      graphics card takes the processor from the simulation)
#
# Leaves demo/force.csv, demo/force.png, demo/output.bag and demo/roslaunch.log. From the
# environment: PALPATE_NO_INSTALL=1 leaves the system's packages alone.
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

die() {
  echo "demo.sh: $*" >&2
  exit 1
}

device=bag
rviz=false
screenshot=
rate=
scene=
while [ $# -gt 0 ]; do
  case $1 in
    --device)
      [[ ${2:-} =~ ^(bag|sim)$ ]] || die "--device needs bag or sim"
      device=$2
      shift ;;
    --scene)
      scene=${2:-}
      [ -f "config/scenes/$scene.yaml" ] ||
        die "--scene needs one of: $(cd config/scenes && echo *.yaml | sed 's/\.yaml//g')"
      shift ;;
    --rviz) rviz=true ;;
    --screenshot)
      [ $# -ge 2 ] || die "--screenshot needs a file"
      screenshot=$(realpath -m "$2")
      rviz=true
      shift ;;
    --rate)
      [[ ${2:-} =~ ^[0-9]*\.?[0-9]+$ && ! $2 =~ ^[0.]+$ ]] || die "--rate needs a number > 0"
      rate=$2
      shift ;;
    -h | --help) sed -n '2,18s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) die "unknown option '$1'; see --help" ;;
  esac
  shift
done
if [ -z "$rate" ]; then
  rate=1
  if [ -n "$screenshot" ]; then rate=0.4; fi
fi
if [ -n "$scene" ]; then
  if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build scene; fi
  scripts/build.sh palpate
  exec scripts/demo_scene.py "$scene"
fi
if $rviz && [ -z "$screenshot" ] && [ -z "${DISPLAY:-}" ]; then
  die "--rviz needs a screen (DISPLAY is not set); --screenshot FILE does without"
fi

sets=(build demo)
if $rviz; then sets+=(rviz); fi
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh "${sets[@]}"; fi
scripts/build.sh palpate_node palpate_device palpate_when_ready palpate_rviz # scripts/build.sh alone builds all programs
unset ROS_MASTER_URI # a graph of our own
# shellcheck disable=SC1091
. scripts/env.sh

mkdir -p demo
log=demo/roslaunch.log
rm -f "$log" demo/output.bag demo/output.bag.active demo/force.csv demo/force.png

# Whatever happens, nothing of ours stays behind: roslaunch stops its nodes when interrupted.
pids=()
launch=
cleanup() {
  trap - EXIT INT TERM
  if [ -n "$launch" ] && kill -0 "$launch" 2>/dev/null; then
    kill -INT "$launch" 2>/dev/null || true
    for _ in $(seq 150); do
      kill -0 "$launch" 2>/dev/null || break
      sleep 0.1
    done
    kill -KILL "$launch" 2>/dev/null || true
  fi
  for pid in "${pids[@]}"; do kill -TERM "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
}
trap cleanup EXIT
trap 'echo "demo.sh: interrupted" >&2; exit 130' INT
trap 'exit 143' TERM

if [ -n "$screenshot" ]; then
  mkdir -p "$(dirname "$screenshot")"
  rm -f "$screenshot" demo/display
  Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>demo/display 2>/dev/null &
  pids+=($!)
  for _ in $(seq 100); do
    if [ -s demo/display ]; then break; fi
    sleep 0.1
  done
  [ -s demo/display ] || die "Xvfb did not start"
  DISPLAY=:$(<demo/display)
  export DISPLAY LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1
  unset XAUTHORITY WAYLAND_DISPLAY
  rm -f demo/display
  scripts/screenshot.py "$screenshot" &
  pids+=($!)
fi

# The highest memory of the node so far, in MB, while it lives.
node_memory() {
  awk -v parent="$launch" '
    FNR == 1 { ours = 0; name = $2 }
    /^PPid:/ { ours = name ~ /^palpate_node/ && $2 == parent }
    ours && /^VmHWM:/ { printf "%.0f", $2 / 1024 }' /proc/[0-9]*/status 2>/dev/null || true
}

master_port=${ROS_MASTER_URI##*:}
echo "+ roslaunch palpate demo.launch device:=$device rate:=$rate rviz:=$rviz   (log: $log)"
set -m # a process group of its own, so that Ctrl-C reaches this script first
roslaunch -p "${master_port%/}" palpate demo.launch \
  bag_out:="$PWD/demo/output.bag" device:="$device" rate:="$rate" rviz:="$rviz" \
  ${screenshot:+rviz_args:=--fullscreen} </dev/null >"$log" 2>&1 &
launch=$!
set +m

memory=
last=
while kill -0 "$launch" 2>/dev/null; do
  now=$(node_memory)
  memory=${now:-$memory}
  # Meshing takes a while the first time: show what the node is doing.
  progress=$(grep -aoE '(loading: .*|playing .*)' "$log" | tail -n 1 | tr -d '\033' | sed 's/\[0m//' || true)
  if [ -n "$progress" ] && [ "$progress" != "$last" ]; then echo "  $progress"; fi
  last=$progress
  sleep 0.5
done
wait "$launch" && status=0 || status=$?
launch=

# The player ends first, cleanly; then roslaunch stops the others. Anything else is a failure.
first=$(grep -aoE 'REQUIRED process \[[a-z_]+' "$log" | head -n 1 | sed 's/.*\[//' || true)
if [ "$first" != player ] || grep -aqE 'process has died \[pid' "$log"; then
  echo "demo.sh: ${first:-roslaunch} ended before the hand had (roslaunch: $status)." >&2
  echo "The last lines of $log:" >&2
  tail -n 25 "$log" >&2
  exit 1
fi
[ -f demo/output.bag ] || die "nothing was recorded; see $log"

if [ -n "$screenshot" ]; then
  [ -s "$screenshot" ] || die "no picture was taken: no force was seen; see $log"
  echo "picture: $screenshot"
fi
echo
scripts/analyse_bag.py demo/output.bag --csv demo/force.csv --plot demo/force.png
if [ -n "$memory" ]; then echo "  memory of the node              $memory MB"; fi
echo
echo "demo/force.csv  demo/force.png  demo/output.bag"
