#!/usr/bin/env bash
# Writes the shipped organ surfaces, config/organs/*.obj, with palpate's own generator.
#
#   scripts/make_organs.sh [EDGE_LENGTH]     [m], for all; default: what is shipped
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh palpate
# shellcheck disable=SC1091
. scripts/env.sh

declare -A edge=([liver]=0.006 [kidney]=0.004 [gallbladder]=0.003 [gallbladder_hollow]=0.003 [slab]=0.005)  # [m]
for palpate in build/devel/lib/palpate/palpate build/src/cli/palpate; do  # with and without catkin
  if [ -x "$palpate" ]; then break; fi
done
mkdir -p config/organs
for organ in liver kidney gallbladder gallbladder_hollow slab; do
  "$palpate" organ "$organ" --edge-length "${1:-${edge[$organ]}}" \
    --out "config/organs/$organ.obj"
done
