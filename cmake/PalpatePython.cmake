# catkin, ament (through pluginlib) and their scripts need the distribution's Python, which has
# catkin_pkg and ament_package; another python3 that stands first in PATH (pyenv, conda) has not.
if(EXISTS /usr/bin/python3)
  foreach(variable PYTHON_EXECUTABLE Python3_EXECUTABLE)
    if(NOT DEFINED ${variable})
      set(${variable} /usr/bin/python3 CACHE FILEPATH "Python for catkin and ament")
    endif()
  endforeach()
endif()
