# Rules of the house that a build can check.
if(NOT TARGET cupola OR NOT TARGET cupola-dem OR NOT TARGET cupola-tracer)
  return()
endif()
add_test(NAME house.orchestrator_links_no_solver
         COMMAND "${CMAKE_SOURCE_DIR}/tests/house/links_no_solver.sh" $<TARGET_FILE:cupola>)
foreach(program cupola-dem cupola-tracer)
  add_test(NAME house.${program}_links_what_it_uses COMMAND "${CMAKE_SOURCE_DIR}/tests/house/links_what_it_uses.sh" $<TARGET_FILE:${program}>)
  set_tests_properties(house.${program}_links_what_it_uses PROPERTIES LABELS unit)
endforeach()
foreach(program cupola cupola-dem cupola-tracer)
  add_test(NAME house.${program}_version COMMAND ${program} --version)
  set_tests_properties(house.${program}_version PROPERTIES PASS_REGULAR_EXPRESSION "${PROJECT_VERSION}")
endforeach()
add_test(NAME house.no_private_words COMMAND "${CMAKE_SOURCE_DIR}/tests/house/no_private_words.sh" "${CMAKE_SOURCE_DIR}")
add_test(NAME house.install_packages COMMAND "${CMAKE_SOURCE_DIR}/tests/house/install_packages_test.sh" "${CMAKE_SOURCE_DIR}")
set_tests_properties(house.install_packages PROPERTIES LABELS unit)
set_tests_properties(house.orchestrator_links_no_solver house.no_private_words house.cupola_version house.cupola-dem_version
                     house.cupola-tracer_version PROPERTIES LABELS unit)
