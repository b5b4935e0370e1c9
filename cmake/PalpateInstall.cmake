# What is installed beside programs, library and headers: in share/palpate with catkin and without, in the
# folders of the repository, so that links between pages, and from scenes to organs, hold. The component
# `share` is all of it, and can be installed before anything is built.
if(catkin_FOUND)
  set(palpate_share ${CATKIN_PACKAGE_SHARE_DESTINATION})
  install(DIRECTORY launch DESTINATION ${palpate_share} COMPONENT share)
else()
  set(palpate_share ${CMAKE_INSTALL_DATADIR}/palpate)
endif()
install(DIRECTORY config docs msg DESTINATION ${palpate_share} COMPONENT share)
install(FILES README.md CHANGELOG.rst CONTRIBUTING.md LICENSE DESTINATION ${palpate_share} COMPONENT share)
# Of the scripts those that need no source tree, and what they import.
install(PROGRAMS scripts/analyse_bag.py scripts/demo_scene.py scripts/render_replay.py
  DESTINATION ${palpate_share}/scripts COMPONENT share)
install(PROGRAMS scripts/data/make_demo_bag.py DESTINATION ${palpate_share}/scripts/data COMPONENT share)
install(FILES scripts/find_palpate.py DESTINATION ${palpate_share}/scripts COMPONENT share)
