#!/usr/bin/env bash
# Computes problems whose answers are known, with palpate and with other programs, and writes
# docs/results/accuracy.md and docs/results/images/accuracy/. Fails if an error is larger than its bound.
#
#   scripts/page.sh accuracy [--quick] [--list] [CASE ...]
#
# --quick runs small versions of the quick cases; with it, or with names of cases, the page goes
# to build/accuracy/ instead. --list prints the names. From the environment: PALPATE_THREADS (1; cases run side by side),
# PALPATE_NO_BUILD=1 takes the programs that are built, PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
# shellcheck disable=SC1091
. scripts/env.sh

if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build test accuracy; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then
  mapfile -t tests < <(find test -name '*_accuracy_test.cpp' -printf '%f\n' | sed 's/\.cpp$//' | sort)
  if [[ " $* " == *" --quick "* ]]; then tests=(); fi
  scripts/build.sh palpate "${tests[@]}"
fi
export PALPATE_THREADS=${PALPATE_THREADS:-1}
PYTHONPATH=benchmarks exec /usr/bin/python3 -B -m accuracy "$@"
