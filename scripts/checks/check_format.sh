#!/usr/bin/env bash
# Fails if clang-format 14 would change a source file. `scripts/checks/check_format.sh --fix` changes them.
set -euo pipefail
cd "$(dirname "$0")/../.."

format=$(command -v clang-format-14 || command -v clang-format) || {
  echo "check_format.sh: no clang-format; run scripts/install_dependencies.sh dev" >&2
  exit 1
}
"$format" --version | grep -q 'version 14\.' ||
  { echo "check_format.sh: $("$format" --version) found; version 14 decides" >&2; exit 1; }

mode=(--dry-run -Werror)
if [ "${1:-}" = --fix ]; then mode=(-i); fi
mapfile -d '' files < <(find include src test benchmarks \( -name '*.h' -o -name '*.cpp' \) -print0 2>/dev/null)
if [ ${#files[@]} -eq 0 ]; then
  echo "check_format.sh: no source files found" >&2
  exit 1
fi
"$format" "${mode[@]}" "${files[@]}"
echo "${#files[@]} files are formatted."
