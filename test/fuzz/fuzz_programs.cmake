# The programs that scripts/checks/fuzz.sh runs; see cmake/PalpateFuzz.cmake.
function(palpate_fuzz_program name)
  add_executable(${name} EXCLUDE_FROM_ALL fuzz_main.cpp ../support/source_folder.cpp ${shared} ${ARGN})
  target_compile_definitions(${name} PRIVATE PALPATE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_include_directories(${name} PRIVATE ..)
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  target_link_libraries(${name} PRIVATE palpate_private_headers ZLIB::ZLIB)
  palpate_precompile(${name})
  palpate_warnings(${name})
  if(NOT PALPATE_FUZZ_CORE)
    target_link_libraries(${name} PRIVATE palpate_studies)
    return()
  endif()
  # The sources of the core that read stand before their likes in the core that is built.
  get_property(sources GLOBAL PROPERTY PALPATE_CORE_SOURCES)
  list(FILTER sources INCLUDE REGEX "\
/base/(atomic_file|error|number|resource|text_file)[.]cpp$|\
/formats/|/keys/(range|yaml_[a-z]*)[.]cpp$|/instrument/|/[a-z_]*_fields[.]cpp$|\
/scene/(scene|tissue_file)[.]cpp$|/analysis/case[.]cpp$|/io/state_file[.]cpp$|\
/(surrogate|springs)_file[.]cpp$|/database_folder[.]cpp$")
  get_target_property(libraries palpate_core LINK_LIBRARIES)
  target_sources(${name} PRIVATE ${sources})
  palpate_built_beside(${PALPATE_FUZZ_CORE} others)
  target_link_libraries(${name} PRIVATE ${others} ${PALPATE_FUZZ_CORE} ${libraries} palpate_core_flags)
endfunction()

palpate_fuzz_program(palpate_fuzz ${core_targets})
if(catkin_FOUND AND NOT PALPATE_FUZZ_CORE)
  palpate_fuzz_program(palpate_fuzz_bag bag_targets.cpp)
  target_link_libraries(palpate_fuzz_bag PRIVATE palpate_ros)
endif()
