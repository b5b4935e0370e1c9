#!/usr/bin/env bash
# Fails if clang-tidy 14 finds anything in the core or the command line. Needs a configured build.
#
#   scripts/check_tidy.sh [FILE ...]      default: all, less the ones below
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
build_dir=${BUILD_DIR:-build}

tidy=$(command -v clang-tidy-14 || command -v clang-tidy) || {
  echo "check_tidy.sh: no clang-tidy; run scripts/install_dependencies.sh dev" >&2
  exit 1
}
if [ ! -f "$build_dir/compile_commands.json" ]; then
  echo "check_tidy.sh: $build_dir/compile_commands.json is missing; run scripts/build.sh" >&2
  exit 1
fi

# Sources that see CGAL take minutes each, almost all of it in CGAL's templates: they are left to
# the compiler's warnings and to review. src/ros sees ROS's headers, which have their own manner.
if [ $# -gt 0 ]; then
  files=("$@")
else
  mapfile -t files < <(find src -name '*.cpp' ! -path 'src/ros/*' | sort)
  mapfile -t cgal < <(grep -lE '#include *[<"](CGAL/|palpate/.*cgal|(mesh/)?cgal/)' "${files[@]}" || true)
  if [ ${#cgal[@]} -gt 0 ]; then
    mapfile -t files < <(comm -23 <(printf '%s\n' "${files[@]}") <(printf '%s\n' "${cgal[@]}" | sort))
  fi
fi

# Only what the build compiles: a file outside it has no flags.
known=$(sed -nE 's/.*"file": "(.*)".*/\1/p' "$build_dir/compile_commands.json")
chosen=()
for file in "${files[@]}"; do
  if grep -qxF "$PWD/$file" <<<"$known"; then chosen+=("$file"); fi
done
if [ ${#chosen[@]} -eq 0 ]; then
  echo "check_tidy.sh: none of ${#files[@]} files is part of the build in $build_dir" >&2
  exit 1
fi

# --quiet still counts suppressed warnings on stderr; findings are on stdout.
status=0
printf '%s\0' "${chosen[@]}" | xargs -0 -n 4 -P "$(nproc)" \
  "$tidy" -p "$build_dir" --quiet --extra-arg=-Wno-unknown-warning-option \
  --extra-arg=-Wno-ignored-optimization-argument --extra-arg=-Wno-unused-command-line-argument \
  2> >(grep -vE '^[0-9]+ warnings? (and [0-9]+ errors? )?(generated|treated)|^Suppressed|^Use -header' >&2) || status=1
if [ $status -eq 0 ]; then echo "clang-tidy finds nothing in ${#chosen[@]} files."; fi
exit $status
