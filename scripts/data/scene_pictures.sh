#!/usr/bin/env bash
# Plays shipped scenes into the running node and saves what rviz shows at the largest force, without a screen.
#
#   scripts/data/scene_pictures.sh [--out FOLDER] [--rate R] [SCENE ...]
#
#   --out FOLDER  for NAME.png, NAME.log and sheet.png, all pictures on one (build/scene_pictures)
#   --rate R      speed of playing (0.15): drawing without a graphics card takes the processor from the simulation
#   SCENE         names from config/scenes; all of them where none is given
#
# Exit status 1 if a scene gave no picture. From the environment: PALPATE_NO_INSTALL=1 installs nothing,
# PALPATE_NO_BUILD=1 takes the programs that are built.
set -euo pipefail
cd "$(dirname "$0")/../.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

out=build/scene_pictures
rate=0.15
scenes=()
while [ $# -gt 0 ]; do
  case $1 in
    --out | --rate) [ $# -ge 2 ] || { echo "scene_pictures.sh: $1 needs a value" >&2; exit 2; } ;;&
    --out) out=$2; shift ;;
    --rate) rate=$2; shift ;;
    -h | --help) sed -n '2,11s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *)
      [ -f "config/scenes/$1.yaml" ] || { echo "scene_pictures.sh: '$1' is no scene of config/scenes" >&2; exit 2; }
      scenes+=("$1") ;;
  esac
  shift
done
if [ ${#scenes[@]} -eq 0 ]; then
  for file in config/scenes/*.yaml; do scenes+=("$(basename "$file" .yaml)"); done
fi
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build demo rviz; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then scripts/build.sh palpate_node palpate_rviz palpate_play; fi
unset ROS_MASTER_URI # a graph of our own
# shellcheck disable=SC1091
. scripts/env.sh
mkdir -p "$out"
out=$(cd "$out" && pwd)

pids=()
end() {
  for pid in "${pids[@]}"; do kill -INT "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
}
trap end EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>"$out/display" 2>/dev/null &
pids+=($!)
for _ in $(seq 100); do
  if [ -s "$out/display" ]; then break; fi
  sleep 0.1
done
DISPLAY=:$(<"$out/display")
rm -f "$out/display"
export DISPLAY LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1
unset XAUTHORITY WAYLAND_DISPLAY

master_port=${ROS_MASTER_URI##*:}
failed=()
for scene in "${scenes[@]}"; do
  rm -f "$out/$scene.png" "$out/$scene.log"
  roslaunch -p "${master_port%/}" palpate play.launch scene:="$scene" rate:="$rate" rviz:=true \
    rviz_args:=--fullscreen </dev/null >>"$out/$scene.log" 2>&1 &
  launch=$!
  scripts/screenshot.py "$out/$scene.png" </dev/null >>"$out/$scene.log" 2>&1 &
  photographer=$!
  pids+=("$launch" "$photographer")
  wait "$launch" || true
  kill "$photographer" 2>/dev/null || true
  wait "$photographer" 2>/dev/null || true
  pids=("${pids[0]}")
  if [ -s "$out/$scene.png" ]; then
    echo "$(sed -n 's/^screenshot.py: //p' "$out/$scene.log" | tail -n 1)"
  else
    failed+=("$scene")
    echo "scene_pictures.sh: $scene: no picture; see $out/$scene.log" >&2
  fi
done

pictures=()
for scene in "${scenes[@]}"; do
  if [ -s "$out/$scene.png" ]; then pictures+=(-label "$scene" "$out/$scene.png"); fi
done
if [ ${#pictures[@]} -gt 0 ]; then
  # ImageMagick's own font need not be there.
  montage -font "$(fc-match --format '%{file}' sans)" -background '#20242c' -fill white -pointsize 20 "${pictures[@]}" -geometry 360x225+4+4 -tile 4x \
    -colors 128 "PNG8:$out/sheet.png"
  echo "$out/sheet.png"
fi
[ ${#failed[@]} -eq 0 ]
