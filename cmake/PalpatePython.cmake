# catkin, ament (through pluginlib) and their scripts need the distribution's Python, which has
# catkin_pkg and ament_package; another python3 that stands first in PATH (pyenv, conda) has not.
if(EXISTS /usr/bin/python3)
  foreach(variable PYTHON_EXECUTABLE Python3_EXECUTABLE)
    if(NOT DEFINED ${variable})
      set(${variable} /usr/bin/python3 CACHE FILEPATH "Python for catkin and ament")
    endif()
  endforeach()
endif()

# catkin runs tests in an environment that it takes down while configuring, with only those folders
# in PYTHONPATH that are there by then. The messages' Python comes later, so its folder is made now;
# without it the first build's rostests do not find palpate.msg.
if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages)
endif()
