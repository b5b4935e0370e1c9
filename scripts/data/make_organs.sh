#!/usr/bin/env bash
# Writes the shipped organs: surfaces, config/organs/*.obj, and the block of skin, with palpate's own generators.
#
#   scripts/data/make_organs.sh [EDGE_LENGTH]     [m], for all; default: what is shipped
set -euo pipefail
cd "$(dirname "$0")/../.."
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
skin=$(mktemp -d)
"$palpate" skin --mesh 12x6 --block 12 --ratios none --out "$skin"
mv "$skin/block.vtu" config/organs/skin_block.vtu
rm -r "$skin"
