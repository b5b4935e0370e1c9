#!/bin/sh
# Runs the compiler, by ccache where that is installed: scripts/build.sh makes it the launcher, so
# that installing ccache later changes no command and builds nothing anew. ccache needs to be told
# that precompiled headers are welcome, and which part of a path is the clone's own.
if command -v ccache >/dev/null 2>&1; then
  : "${CCACHE_SLOPPINESS:=pch_defines,time_macros}"
  : "${CCACHE_BASEDIR:=$(dirname "$(dirname "$0")")}"
  export CCACHE_SLOPPINESS CCACHE_BASEDIR
  exec ccache "$@"
fi
exec "$@"
