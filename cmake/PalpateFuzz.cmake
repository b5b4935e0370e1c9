# PALPATE_FUZZ builds for fuzzing, by clang: everything with AddressSanitizer, UBSan and libFuzzer's
# counters. scripts/checks/fuzz.sh configures so, in a folder of its own; the targets are palpate_fuzz and,
# with ROS, palpate_fuzz_bag.
#
# PALPATE_FUZZ_CORE names a palpate_core library that is built already. Then only what reads files is
# compiled for fuzzing, which takes a tenth of the time, and all else is taken from there.
option(PALPATE_FUZZ "Build for fuzzing (needs clang)" OFF)
set(PALPATE_FUZZ_CORE "" CACHE FILEPATH "With PALPATE_FUZZ: a core that is built already")

if(PALPATE_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "palpate: PALPATE_FUZZ needs clang: -DCMAKE_CXX_COMPILER=clang++-14")
  endif()
  # The last option lets ccache take a precompiled header for the same whenever it was made.
  add_compile_options(-O1 -g1 -fno-omit-frame-pointer
    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
    -Xclang -fno-pch-timestamp)
  add_link_options(-fsanitize=address,undefined)
endif()
