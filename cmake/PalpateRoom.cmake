# Rooms of the core are compiled in batches of sources, since most of a source's compile time is its headers'.
# PALPATE_UNITY_BUILD=OFF compiles each source alone: then each must include what it uses.
option(PALPATE_UNITY_BUILD "Compile several sources of a room at once" ON)

# palpate_room(NAME [BATCH N] [APART SOURCE ...] SOURCE ...): adds sources to palpate_core. Sources of APART are
# compiled alone. Sources of one batch share their anonymous namespaces, so their names must differ.
function(palpate_room name)
  cmake_parse_arguments(arg "" "BATCH" "APART" ${ARGN})
  # APART takes all that follows it, so the rest of the sources stand before it.
  set(target palpate_${name})
  add_library(${target} OBJECT ${arg_UNPARSED_ARGUMENTS} ${arg_APART})
  if(NOT arg_BATCH)
    set(arg_BATCH 12)
  endif()
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON
    UNITY_BUILD ${PALPATE_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE ${arg_BATCH})
  if(arg_APART)
    set_source_files_properties(${arg_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  target_link_libraries(${target} PRIVATE palpate_core_flags)
  palpate_core_warnings(${target})
  target_sources(palpate_core PRIVATE $<TARGET_OBJECTS:${target}>)
  foreach(source ${arg_UNPARSED_ARGUMENTS} ${arg_APART})
    set_property(GLOBAL APPEND PROPERTY PALPATE_CORE_SOURCES ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  endforeach()
endfunction()
