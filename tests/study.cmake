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
add_test(NAME study.figures COMMAND "${NODE_PROGRAM}" "${CMAKE_CURRENT_LIST_DIR}/study/compare_figures.mjs" "${study_folder}/study/study.json"
                                    "${CMAKE_CURRENT_LIST_DIR}/study/figures.json")
set_tests_properties(study.figures PROPERTIES LABELS workflow TIMEOUT 60 FIXTURES_REQUIRED study_run)
add_test(NAME study.committed COMMAND "${CMAKE_CURRENT_LIST_DIR}/study/committed_studies.sh" $<TARGET_FILE:cupola> "${CMAKE_SOURCE_DIR}")
set_tests_properties(study.committed PROPERTIES LABELS workflow TIMEOUT 120)
