# palpate_commit(TARGET SOURCE) has SOURCE of TARGET see palpate_commit.h, which says PALPATE_COMMIT: what is
# checked out when it is built, not when it was configured. Only SOURCE is compiled anew after a commit.
function(palpate_commit target source)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/commit)
  add_custom_target(${target}_commit
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DFILE=${folder}/palpate_commit.h
      -P ${PROJECT_SOURCE_DIR}/cmake/WriteCommit.cmake
    BYPRODUCTS ${folder}/palpate_commit.h)
  add_dependencies(${target} ${target}_commit)
  target_include_directories(${target} PRIVATE ${folder})
  set_source_files_properties(${source} PROPERTIES
    COMPILE_DEFINITIONS PALPATE_VERSION="${PROJECT_VERSION}"
    SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
