#!/usr/bin/env bash
# Installs the Debian packages that palpate needs. Nothing happens where they are all there.
#
#   scripts/install_dependencies.sh [--list] [SET ...]      SET: build test demo scene rviz dev accuracy
#                                                     benchmark memory coverage
#
# Without a set: build, test and demo. --list prints the packages and installs nothing.
# This file is the one place where packages are listed.
set -euo pipefail

# Compiler, ROS headers and .msg files (lib*-msgs-dev has headers only), numerical libraries.
build=(
  build-essential cmake ninja-build catkin
  libroscpp-dev libroslib-dev librosbag-dev
  libtf2-ros-dev libtf2-eigen-dev libtf2-geometry-msgs-dev libdiagnostic-updater-dev
  ros-message-generation ros-message-runtime
  libstd-msgs-dev ros-std-msgs libgeometry-msgs-dev ros-geometry-msgs
  libsensor-msgs-dev ros-sensor-msgs libvisualization-msgs-dev ros-visualization-msgs
  libdiagnostic-msgs-dev ros-diagnostic-msgs libstd-srvs-dev ros-std-srvs
  libeigen3-dev libcgal-dev libsuitesparse-dev libopenblas-dev
  liburdf-dev liburdfdom-dev liborocos-kdl-dev libkdl-parser-dev
  libyaml-cpp-dev libtinyxml2-dev zlib1g-dev libssl-dev libcli11-dev)

# What the tests need besides: gtest, rostest, the nodes that the launch files start, and rviz with what
# draws it, whose displays a test asks (the last line, 80 MB of packages).
test=(
  libgtest-dev libbenchmark-dev librostest-dev python3-rostest python3-roslaunch rosout
  python3-rosbag python3-rostopic python3-rosservice python3-rosnode rosbash
  python3-std-msgs python3-std-srvs python3-geometry-msgs python3-sensor-msgs
  python3-visualization-msgs python3-diagnostic-msgs python3-tf2-msgs python3-numpy
  calculix-ccx python3-scipy python3-meshio python3-matplotlib python3-yaml
  rviz python3-rviz python3-pyqt5 xvfb libgl1-mesa-dri)

# A running graph without a screen, the recorded bag and its analysis.
demo=(
  python3-roslaunch rosout python3-rosbag python3-rostopic
  python3-rosnode python3-rosservice python3-rosparam python3-rosmsg rosbash rospack-tools
  python3-std-msgs python3-std-srvs python3-geometry-msgs python3-sensor-msgs
  python3-visualization-msgs python3-diagnostic-msgs python3-tf2-msgs
  python3-numpy python3-matplotlib)

# scripts/demo.sh --scene, scripts/render_replay.py: plots and pictures of a replay, without ROS.
scene=(python3-numpy python3-matplotlib python3-meshio python3-yaml)

# The picture: rviz, and what draws it where there is no screen.
rviz=(rviz xvfb xauth libgl1-mesa-dri imagemagick)

# The checks of scripts/test.sh.
dev=(clang-format-14 clang-tidy-14 catkin-lint clang-14 libclang-rt-14-dev)

# scripts/checks/memory.sh.
memory=(valgrind python3-roslaunch python3-rosservice rosout)

# scripts/checks/coverage.sh.
coverage=(gcovr)

# scripts/page.sh accuracy: two other finite-element programs (dolfinx compiles its forms), plots, meshes.
accuracy=(
  calculix-ccx python3-dolfinx-real build-essential
  python3-numpy python3-scipy python3-meshio python3-matplotlib)

# scripts/page.sh benchmark: single kernels, other programs on the same meshes, plots.
benchmark=(
  libbenchmark-dev libbullet-dev calculix-ccx
  python3-numpy python3-scipy python3-meshio python3-matplotlib python3-yaml)

page=docs/install.md

die() {
  echo "install_dependencies.sh: $*" >&2
  exit 1
}

list_only=false
sets=()
for argument in "$@"; do
  case $argument in
    --list) list_only=true ;;
    build | test | demo | scene | rviz | dev | memory | coverage | accuracy | benchmark) sets+=("$argument") ;;
    -h | --help) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) die "unknown set '$argument'; known: build test demo scene rviz dev memory coverage accuracy benchmark" ;;
  esac
done
[ ${#sets[@]} -gt 0 ] || sets=(build test demo)

packages=()
for set in "${sets[@]}"; do
  declare -n members=$set
  packages+=("${members[@]}")
done
mapfile -t packages < <(printf '%s\n' "${packages[@]}" | sort -u)
if $list_only; then
  printf '%s\n' "${packages[@]}"
  exit 0
fi

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  die "this system has no apt. Install by hand what package.xml names; see $page."
fi

as_root=()
# need_root WHAT: from here on as_root does something, or there is nobody to do it.
need_root() {
  if [ "$(id -u)" -eq 0 ]; then return 0; fi
  command -v sudo >/dev/null || die "this is neither root nor is there sudo. As root, run:
  $*"
  as_root=(sudo)
}

# A bare chroot may have no /etc/hosts; ROS then finds no master.
if [[ " ${sets[*]} " =~ \ (test|demo)\  ]] && ! getent hosts localhost >/dev/null; then
  line="127.0.0.1 localhost"
  need_root "echo '$line' >>/etc/hosts"
  echo "install_dependencies.sh: the name localhost is unknown here; adding '$line' to /etc/hosts"
  echo "$line" | "${as_root[@]}" tee -a /etc/hosts >/dev/null
fi

installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' 2>/dev/null | sed -n 's/^installed //p')
mapfile -t missing < <(comm -23 <(printf '%s\n' "${packages[@]}") <(sort -u <<<"$installed"))
if [ ${#missing[@]} -eq 0 ]; then
  echo "install_dependencies.sh: all packages of '${sets[*]}' are there."
  exit 0
fi

# shellcheck disable=SC1091
system=$(. /etc/os-release 2>/dev/null && echo "${ID:-unknown} ${VERSION_ID:-}") || system="unknown"
case $system in
  "debian 12") ;;
  ubuntu*) die "this is $system. ROS 1 for Ubuntu is Noetic on 20.04, from packages.ros.org, and its
packages have other names: use rosdep, see $page. Then run the script that you wanted with
PALPATE_NO_INSTALL=1." ;;
  *) die "this is '$system'; the list here is for Debian 12 (bookworm). See $page. With the packages
installed in your own way, run the script that you wanted with PALPATE_NO_INSTALL=1." ;;
esac

need_root "apt-get install --no-install-recommends ${missing[*]}"
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get \
    -q -y -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@"
}

echo "install_dependencies.sh: installing ${#missing[@]} packages: ${missing[*]}"
apt update
apt install --no-install-recommends "${missing[@]}"
