# Studies: their parts alone, then a real one from its file to its page in a browser.
if(NOT TARGET cupola_study)
  return()
endif()
cupola_test(
  unit_study
  LABEL unit
  SOURCES unit/study/study_test.cpp
  LIBRARIES cupola_study)
target_compile_definitions(unit_study PRIVATE CUPOLA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
target_compile_options(unit_study PRIVATE -O1)
if(NOT TARGET browser_tests)
  return()
endif()
set(study_folder "${CMAKE_CURRENT_BINARY_DIR}/study")
add_test(NAME study.run COMMAND "${CMAKE_CURRENT_LIST_DIR}/study/study_test.sh" $<TARGET_FILE:cupola> "${CMAKE_SOURCE_DIR}" "${study_folder}")
set_tests_properties(study.run PROPERTIES LABELS workflow TIMEOUT 900 PROCESSORS 2 FIXTURES_SETUP study_run)
add_test(NAME study.browser COMMAND "${NODE_PROGRAM}" study.mjs "${study_folder}/study" "${browser_build}/pictures"
         WORKING_DIRECTORY "${browser_build}")
set_tests_properties(study.browser PROPERTIES LABELS workflow TIMEOUT 300 FIXTURES_REQUIRED study_run)
# Each committed study at its reduced size: are its figures stale?
file(GLOB committed_studies CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/cases/studies/*.yaml")
foreach(file ${committed_studies})
  get_filename_component(name "${file}" NAME_WE)
  add_test(NAME study.figures.${name} COMMAND "${CMAKE_CURRENT_LIST_DIR}/study/reduced_study.sh" $<TARGET_FILE:cupola> "${file}" "${study_folder}/reduced/${name}")
  set_tests_properties(study.figures.${name} PROPERTIES LABELS workflow TIMEOUT 600)
endforeach()
add_test(NAME study.committed COMMAND "${CMAKE_CURRENT_LIST_DIR}/study/committed_studies.sh" $<TARGET_FILE:cupola> "${CMAKE_SOURCE_DIR}")
set_tests_properties(study.committed PROPERTIES LABELS workflow TIMEOUT 120)
