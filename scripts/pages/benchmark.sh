#!/usr/bin/env bash
# Measures palpate's methods on fixed scenes, time beside error, and writes docs/results/benchmarks.md,
# docs/results/benchmarks.csv and docs/results/images/benchmarks/. Wants a machine on which nothing else runs.
#
#   scripts/page.sh benchmark [--quick] [--resume] [--list] [SUITE ...]
#
# --quick runs small versions of the quick suites; with it, or with names of suites, the page goes
# to build/benchmark/ instead. --resume keeps what the same program measured before. --list prints
# the names. References are kept in build/benchmark/ while the program is the same. From the environment:
# PALPATE_NO_BUILD=1 takes the programs that are built, PALPATE_NO_INSTALL=1 installs nothing.
set -euo pipefail
cd "$(dirname "$0")/../.."
# shellcheck disable=SC1091
. scripts/env.sh

# One thread is one thread: OpenBLAS would take every core for CHOLMOD's factors, and wait for them
# spinning where another program has one.
export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

if [[ " $* " == *" --list "* ]]; then PALPATE_NO_BUILD=1 PALPATE_NO_INSTALL=1; fi
if [ -z "${PALPATE_NO_INSTALL:-}" ]; then scripts/install_dependencies.sh build benchmark; fi
if [ -z "${PALPATE_NO_BUILD:-}" ]; then
  scripts/build.sh palpate
  # What needs google-benchmark and Bullet is left out where these are not installed.
  for target in palpate_micro palpate_bullet; do
    if [[ " $* " != *" --quick "* ]]; then scripts/build.sh "$target" || echo "page.sh benchmark: no $target"; fi
  done
fi
PYTHONPATH=benchmarks exec /usr/bin/python3 -B -m work_precision "$@"
