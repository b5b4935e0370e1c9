# rosrun skips what lies in a folder `build` of a package. The devel space of build/ is therefore also
# called devel, as in a catkin workspace, and setup.bash is to be sourced by that name.
set(palpate_devel_link)
if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR AND CMAKE_BINARY_DIR STREQUAL "${PROJECT_SOURCE_DIR}/build")
  set(palpate_devel_link ${PROJECT_SOURCE_DIR}/devel)
endif()

# Who has sourced it and configures again names its own devel space twice; catkin would take the second
# name for another workspace below this one.
if(palpate_devel_link AND NOT "$ENV{CMAKE_PREFIX_PATH}" STREQUAL "")
  string(REPLACE ":" ";" prefixes "$ENV{CMAKE_PREFIX_PATH}")
  list(REMOVE_ITEM prefixes ${palpate_devel_link})
  string(REPLACE ";" ":" prefixes "${prefixes}")
  set(ENV{CMAKE_PREFIX_PATH} "${prefixes}")
endif()

# Leaves a devel space alone that catkin_make or catkin build has put there.
function(palpate_link_devel)
  if(NOT palpate_devel_link)
    return()
  endif()
  if(IS_SYMLINK ${palpate_devel_link} OR NOT EXISTS ${palpate_devel_link})
    file(CREATE_LINK build/devel ${palpate_devel_link} RESULT result SYMBOLIC)
    if(NOT result EQUAL 0)
      message(STATUS "palpate: no link ${palpate_devel_link}, without which rosrun finds no program: ${result}")
    endif()
  endif()
endfunction()
