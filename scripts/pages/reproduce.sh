#!/usr/bin/env bash
# Computes tables and curves of the literature anew, and writes docs/results/models.md and docs/results/images/models/.
#
#   scripts/page.sh reproduce [--quick] [--list] [CHAPTER ...] [PART ...]
#
# CHAPTER: makes these chapters of the page anew (tool, springs, ...), the others stay. --quick runs small versions;
# with it, or with names of parts, the page goes to build/models/ instead. --list prints the names. From the
# environment: PALPATE_NO_BUILD=1 takes the programs that are built, PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
# shellcheck disable=SC1091
. scripts/env.sh

if [[ " $* " == *" --list "* ]]; then PALPATE_NO_BUILD=1 PALPATE_NO_INSTALL=1; fi
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build accuracy; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then scripts/build.sh palpate palpate_models; fi
export PALPATE_THREADS=${PALPATE_THREADS:-1}
PYTHONPATH=benchmarks exec /usr/bin/python3 -B -m models "$@"
