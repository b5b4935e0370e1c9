# palpate_kernels(ROOM [LIBRARY LIBRARY] SOURCE ...): adds kernels to a library, by default palpate_core, each source compiled once for each set
# of vector instructions. A source puts all it defines into the namespace PALPATE_ISA and includes no
# header with inline functions: the linker keeps one copy of such a function, perhaps one that an
# older processor cannot run.
function(palpate_kernels room)
  cmake_parse_arguments(arg "" "LIBRARY" "" ${ARGN})
  if(NOT arg_LIBRARY)
    set(arg_LIBRARY palpate_core)
  endif()
  set(isas baseline)
  set(flags_baseline "")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND isas avx2 avx512)
    set(flags_avx2 -mavx2 -mfma)
    set(flags_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma -mprefer-vector-width=512)
    target_compile_definitions(palpate_core_flags INTERFACE PALPATE_X86_KERNELS)
  endif()
  foreach(isa IN LISTS isas)
    set(target palpate_${room}_kernels_${isa})
    add_library(${target} OBJECT ${arg_UNPARSED_ARGUMENTS})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/include)
    target_compile_definitions(${target} PRIVATE PALPATE_ISA=${isa})
    # No contraction to fused multiply-adds: all builds of a kernel give the same bits.
    target_compile_options(${target} PRIVATE -O3 -ffp-contract=off -fno-math-errno
      -fno-trapping-math ${flags_${isa}})
    palpate_core_warnings(${target})
    # GCC 12 warns of its own headers' deliberately undefined registers, and
    # of registers passed between functions, which are all inlined.
    target_compile_options(${target} PRIVATE -Wno-uninitialized -Wno-maybe-uninitialized -Wno-psabi)
    target_sources(${arg_LIBRARY} PRIVATE $<TARGET_OBJECTS:${target}>)
  endforeach()
endfunction()
