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

# A file that was clean stays clean while it, every header and the settings are the same.
passed_dir=$build_dir/tidy
mkdir -p "$passed_dir"
shared=$(find include src -name '*.h' -print0 | sort -z | xargs -0 cat .clang-tidy "$0" | sha1sum)
export passed_dir shared tidy build_dir
tidy_one() {
  local key
  key=$(echo "$shared $1" | cat - "$1" | sha1sum | cut -d' ' -f1)
  if [ -e "$passed_dir/$key" ]; then return 0; fi
  # --quiet still counts what it suppressed, on stderr; findings are on stdout.
  "$tidy" -p "$build_dir" --quiet --extra-arg=-Wno-unknown-warning-option \
    --extra-arg=-Wno-ignored-optimization-argument --extra-arg=-Wno-unused-command-line-argument \
    "$1" 2>"$passed_dir/$key.err" || { grep -vE '^[0-9]+ warnings? ' "$passed_dir/$key.err" >&2; return 1; }
  mv "$passed_dir/$key.err" "$passed_dir/$key"
}
export -f tidy_one
status=0
printf '%s\0' "${chosen[@]}" | xargs -0 -n 1 -P "$(nproc)" bash -c 'tidy_one "$1"' tidy || status=1
if [ $status -eq 0 ]; then echo "clang-tidy finds nothing in ${#chosen[@]} files."; fi
exit $status
