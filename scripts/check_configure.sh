#!/usr/bin/env bash
# Fails if the programs cannot be configured without what only tests and benchmarks need, which a fresh
# machine does not have that runs scripts/demo.sh, or if tests are then built in silence.
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
without=()
for package in GTest benchmark Bullet; do without+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
if ! cmake -S . -B "$folder" "${without[@]}" >"$folder/log" 2>&1; then
  tail -n 20 "$folder/log" >&2
  exit 1
fi
if cmake --build "$folder" --target tests >"$folder/log" 2>&1; then
  echo "without gtest the target tests does not fail" >&2
  exit 1
fi
if ! grep -q "scripts/install_dependencies.sh test" "$folder/log"; then
  tail -n 20 "$folder/log" >&2
  exit 1
fi
echo "The programs are configured without gtest, google-benchmark and Bullet."
