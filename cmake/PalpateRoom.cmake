# Rooms of the core are compiled in batches of sources, since most of a source's compile time is its headers'.
# PALPATE_UNITY_BUILD=OFF compiles each source alone: then each must include what it uses.
option(PALPATE_UNITY_BUILD "Compile several sources of a room at once" ON)

# palpate_library(NAME): what holds for a library of rooms. Its users see include/palpate.
function(palpate_library name)
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(${name} PUBLIC Eigen3::Eigen Threads::Threads)
  # No fused multiply-add chosen by the compiler: the same bits on every build of one source.
  target_compile_options(${name} PUBLIC -ffp-contract=off)
  # And on every processor: large products of Eigen are cut by its caches, if it is asked for them.
  target_compile_definitions(${name} PUBLIC EIGEN_NO_CPUID)
endfunction()

# palpate_room(NAME [LIBRARY LIBRARY] [BATCH N] SOURCE ... [APART SOURCE ...]): adds sources to a library, which is
# palpate_core where none is named. Sources of APART are compiled alone. Sources of one batch share their anonymous
# namespaces, so their names must differ.
function(palpate_room name)
  cmake_parse_arguments(arg "" "LIBRARY;BATCH" "APART" ${ARGN})
  if(NOT arg_LIBRARY)
    set(arg_LIBRARY palpate_core)
  endif()
  if(NOT arg_BATCH)
    set(arg_BATCH 12)
  endif()
  set(sources ${arg_UNPARSED_ARGUMENTS} ${arg_APART})
  set(target palpate_${name})
  add_library(${target} OBJECT ${sources})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON
    UNITY_BUILD ${PALPATE_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE ${arg_BATCH})
  if(arg_APART)
    set_source_files_properties(${arg_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  target_link_libraries(${target} PRIVATE palpate_core_flags)
  palpate_core_warnings(${target})
  target_sources(${arg_LIBRARY} PRIVATE $<TARGET_OBJECTS:${target}>)
  foreach(source IN LISTS sources)
    set_property(GLOBAL APPEND PROPERTY PALPATE_CORE_SOURCES ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  endforeach()
endfunction()

# palpate_built_beside(CORE VARIABLE): the other libraries of rooms of a build, which stand beside its core.
function(palpate_built_beside core variable)
  set(found)
  foreach(library studies learning spring_networks surface_elements)
    string(REPLACE palpate_core palpate_${library} other ${core})
    list(APPEND found ${other})
  endforeach()
  set(${variable} ${found} PARENT_SCOPE)
endfunction()
