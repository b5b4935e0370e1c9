#!/usr/bin/env bash
# Makes a page of docs/results/ anew: measures or computes its figures, and writes it.
#
#   scripts/page.sh NAME [OPTION ...]
#
#   accuracy    forces and shapes against closed forms and other programs; fails where an error is above its bound
#   benchmark   every method's time beside its error (45 minutes)
#   hands       the loop through simulated hands (20 minutes)
#   reproduce   tables and curves of the literature, model by model
#   torture     random scenes, and in which of them something blows up
#
# Options are those in the first lines of scripts/pages/NAME.sh. Of all but torture --quick runs small versions into
# build/, and --list prints the names of the parts, which can be given to make these alone.
set -euo pipefail
pages=$(cd "$(dirname "$0")/pages" && pwd)
case ${1:-} in
  -h | --help) sed -n '2,14s/^# \{0,1\}//p' "$0"; exit 0 ;;
  '' | *[!a-z]*) ;;
  *) if [ -f "$pages/$1.sh" ]; then exec "$pages/$1.sh" "${@:2}"; fi ;;
esac
echo "page.sh: needs one of: $(cd "$pages" && echo *.sh | sed 's/\.sh//g'); see --help" >&2
exit 2
