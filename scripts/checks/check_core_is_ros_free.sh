#!/usr/bin/env bash
# Fails if the core (everything but src/ros) or the command line knows ROS, or if the core reads a
# clock, draws random numbers or prints. With a build in build/ it also looks at what is linked.
set -euo pipefail
cd "$(dirname "$0")/../.."
build_dir=${BUILD_DIR:-build}
failed=0

# complain MESSAGE LINES: reports LINES, if there are any.
complain() {
  [ -n "$2" ] || return 0
  printf '%s:\n%s\n' "$1" "$2" >&2
  failed=1
}

# search PATTERN FOLDER ...: sources outside src/ros, without lines that are comments only.
search() {
  local pattern=$1
  shift
  grep -rnE --include='*.h' --include='*.cpp' "$pattern" "$@" | grep -v '^src/ros/' |
    grep -vE '^[^:]+:[0-9]+: *(//|\*)' || true
}

ros_headers='ros|roscpp|rosbag|roslib|tf2?|tf2_[a-z]+|message_filters|diagnostic_updater|[a-z0-9]+_msgs|std_srvs|palpate/StepReport\.h'
complain 'ROS header in the core or the command line' \
  "$(search "#include *[<\"]($ros_headers)(/|\"|>)" include src)"
complain 'name of a ROS namespace in the core or the command line' \
  "$(search '\b(ros|tf2|rosbag|roscpp)::|\bROS_(INFO|WARN|ERROR|DEBUG|FATAL)' include src)"
complain 'catkin variable in the core' \
  "$(grep -rnE 'catkin_(INCLUDE_DIRS|LIBRARIES|EXPORTED)' --include=CMakeLists.txt src | grep -v '^src/ros/' || true)"
complain 'clock, random numbers or printing in the core' \
  "$(search '\bstd::(chrono|random_device|time|clock|cout|cerr|clog)\b|\b(s?rand|clock_gettime|gettimeofday|f?printf|puts) *\(' \
    include src | grep -v -e '^src/cli/' -e '^src/start/' -e '^src/base/phase_times.cpp' || true)"

for binary in "$build_dir"/devel/lib/libpalpate_core.so "$build_dir"/devel/lib/palpate/palpate; do
  [ -f "$binary" ] || continue
  # kdl_parser and urdf read URDF; they are linked although they come from ROS, and hold no graph.
  complain "$binary links ROS" "$(readelf -d "$binary" |
    grep -E 'NEEDED.*lib(roscpp|rosbag|roslib|tf2|tf2_ros|diagnostic|xmlrpcpp)' || true)"
done

if [ $failed -eq 0 ]; then echo "The core is free of ROS, clocks, random numbers and printing."; fi
exit $failed
