#!/usr/bin/env bash
# Has simulated hands hold the shipped scenes, and writes docs/results/hands.md and docs/results/images/hands/: which come to
# rest, what each part of the loop is for, the force between two solves, energy.
#
#   scripts/page.sh hands [--quick] [--list] [PART ...]
#
# --quick runs small versions; with it, or with names of parts, the page goes to build/hands/ instead. --list
# prints the names. From the environment: PALPATE_NO_BUILD=1 takes the program that is built,
# PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
# shellcheck disable=SC1091
. scripts/env.sh

if [[ " $* " == *" --list "* ]]; then PALPATE_NO_BUILD=1 PALPATE_NO_INSTALL=1; fi
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build accuracy; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then scripts/build.sh palpate; fi
PYTHONPATH=benchmarks exec /usr/bin/python3 -B -m hands "$@"
