#!/usr/bin/env bash
# Runs the node at full rate for long, with its guard, pressed by one simulated hand after the other, and says
# whether memory stays flat: a table, build/soak/figures.json and build/soak/samples.csv.
#
#   scripts/checks/soak.sh [--minutes M] [--scene S] [--start=Q,...] [--way W] [--bound B] [--out FOLDER]
#
#   --minutes M     60
#   --scene S       a scene file or the name of a shipped one, whose instrument is called probe (liver_palpation)
#   --start=Q,...   joint positions where hands begin [m], [rad]; --way W: how far they go down [m]
#   --bound B       exit status 1 where memory grows faster over the last three quarters [MB/min] (1): one
#                   smallest block of memory, of 32 bytes, that each wrench leaves behind makes 1.9
#
# From the environment: PALPATE_NO_BUILD=1 takes the programs that are built, PALPATE_NO_INSTALL=1 installs
# nothing. Wants a machine on which nothing else runs, for the wrench's period; memory does not care.
set -euo pipefail
cd "$(dirname "$0")/../.."
if [ "${1:-}" = -h ] || [ "${1:-}" = --help ]; then sed -n '2,15s/^# \{0,1\}//p' "$0"; exit 0; fi
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build demo; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then scripts/build.sh palpate_node palpate_guard palpate_device palpate_wire; fi
unset ROS_MASTER_URI # a graph of our own
# shellcheck disable=SC1091
. scripts/env.sh
exec /usr/bin/python3 -B scripts/checks/soak.py "$@"
