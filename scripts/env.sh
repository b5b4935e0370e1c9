# Source this, do not run it: the environment in which palpate's programs run.
#
#   . scripts/env.sh
#
# A ROS_MASTER_URI that is already set is kept, so that several terminals can share a master.
# Otherwise a free port is taken, so that nothing here disturbs a ROS graph that already runs.

_palpate_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Debian's ROS needs the distribution's python3, not one from pyenv, conda or a venv.
case $PATH in
  /usr/bin:*) ;;
  *) PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH ;;
esac
export PATH

export ROS_HOSTNAME=${ROS_HOSTNAME:-localhost}
export ROS_HOME=${ROS_HOME:-$_palpate_root/build/ros}
export ROS_LOG_DIR=${ROS_LOG_DIR:-$ROS_HOME/log}
mkdir -p "$ROS_LOG_DIR"
if [ -z "${ROS_MASTER_URI:-}" ]; then
  ROS_MASTER_URI=http://localhost:$(/usr/bin/python3 -c \
    'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI
fi

# CHOLMOD's OpenMP team does not know of our threads and would crowd the cores. This variable caps
# it; OMP_NUM_THREADS does not, because CHOLMOD asks for a number of threads itself.
export OMP_THREAD_LIMIT=${OMP_THREAD_LIMIT:-1}
# OpenBLAS's own threads spin while they wait.
export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}
# OpenBLAS 0.3.21 takes recent Intel processors for a Prescott and leaves AVX-512 unused.
if [ -z "${OPENBLAS_CORETYPE:-}" ] && grep -q GenuineIntel /proc/cpuinfo 2>/dev/null &&
  grep -qw avx512f /proc/cpuinfo; then
  export OPENBLAS_CORETYPE=SKYLAKEX
fi

# rosrun skips what lies in a folder of the package called build: by the devel space's other name it
# finds the programs.
_palpate_devel=$_palpate_root/build/devel
if [ "$_palpate_root/devel" -ef "$_palpate_devel" ]; then _palpate_devel=$_palpate_root/devel; fi
# catkin's setup scripts read variables that need not exist.
if [ -f "$_palpate_devel/setup.bash" ]; then
  case $- in *u*) _palpate_nounset=true ;; *) _palpate_nounset=false ;; esac
  set +u
  # shellcheck disable=SC1091
  . "$_palpate_devel/setup.bash"
  if $_palpate_nounset; then set -u; fi
  unset _palpate_nounset
fi
if [ -d "$_palpate_devel/lib/palpate" ]; then
  case :$PATH: in
    *:"$_palpate_devel/lib/palpate":*) ;;
    *) PATH=$PATH:$_palpate_devel/lib/palpate ;;
  esac
fi
unset _palpate_root _palpate_devel
