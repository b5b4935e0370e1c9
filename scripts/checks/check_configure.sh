#!/usr/bin/env bash
# Fails if the programs cannot be configured without what only tests and benchmarks need, which a fresh
# machine does not have that runs scripts/demo.sh, or if tests are then built in silence; or if, with catkin or
# without, something that users need is not installed.
set -euo pipefail
cd "$(dirname "$0")/../.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# configure FOLDER OPTION ...
configure() {
  mkdir -p "$1"
  if ! cmake -S . -B "$1" "${@:2}" >"$1/log" 2>&1; then
    tail -n 20 "$1/log" >&2
    exit 1
  fi
}
# check_installed BUILD_FOLDER [MORE]: what lies in share/palpate is all that was meant to, and links in it hold.
check_installed() {
  DESTDIR="$1/root" cmake --install "$1" --component share >"$1/log"
  scripts/checks/check_installed.py "$1/root" "${@:2}"
}

without=()
for package in GTest benchmark Bullet; do without+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
configure "$folder/catkin" "${without[@]}"
if cmake --build "$folder/catkin" --target tests >"$folder/log" 2>&1; then
  echo "without gtest the target tests does not fail" >&2
  exit 1
fi
if ! grep -q "scripts/install_dependencies.sh test" "$folder/log"; then
  tail -n 20 "$folder/log" >&2
  exit 1
fi
check_installed "$folder/catkin" launch
configure "$folder/plain" "${without[@]}" -DCMAKE_DISABLE_FIND_PACKAGE_catkin=ON
check_installed "$folder/plain"
echo "The programs are configured without gtest, google-benchmark and Bullet; data, pages and scripts are installed."
