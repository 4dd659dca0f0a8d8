# The report: its parts alone, then a real run's report in a browser.
if(NOT TARGET cupola_report)
  return()
endif()
cupola_test(
  unit_report
  LABEL unit
  SOURCES unit/report/test_answers.cpp unit/report/test_json_numbers.cpp unit/report/test_make_report.cpp
          unit/report/test_mid_plane.cpp
          unit/report/test_report_page.cpp unit/report/test_warnings.cpp
  LIBRARIES cupola_report)
target_compile_definitions(unit_report PRIVATE CUPOLA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")

if(NOT TARGET cupola OR NOT TARGET cupola-dem OR NOT TARGET cupola-tracer)
  return()
endif()
set(browser_build "${CMAKE_CURRENT_BINARY_DIR}/browser")
set(browser_source "${CMAKE_CURRENT_SOURCE_DIR}/browser")
add_custom_command(
  OUTPUT "${browser_build}/installed.stamp"
  COMMAND "${CMAKE_COMMAND}" -E copy "${browser_source}/package.json" "${browser_source}/package-lock.json"
          "${browser_source}/.npmrc" "${browser_source}/report.mjs" "${browser_source}/serve.mjs" "${browser_source}/study.mjs" "${browser_build}"
  COMMAND "${NPM_PROGRAM}" ci --no-audit --no-fund --loglevel=error
  COMMAND "${CMAKE_COMMAND}" -E touch "${browser_build}/installed.stamp"
  DEPENDS "${browser_source}/package.json" "${browser_source}/package-lock.json" "${browser_source}/.npmrc"
          "${browser_source}/report.mjs" "${browser_source}/serve.mjs"
  WORKING_DIRECTORY "${browser_build}"
  COMMENT "npm packages of the browser tests"
  VERBATIM)
file(MAKE_DIRECTORY "${browser_build}")
add_custom_target(browser_tests ALL DEPENDS "${browser_build}/installed.stamp")

# A run of real stages, then its report, looked at by a browser.  Screenshots stay in the build folder.
add_test(NAME report.run
         COMMAND "${CMAKE_COMMAND}" -DCUPOLA=$<TARGET_FILE:cupola> -DCAMPAIGN=${CMAKE_SOURCE_DIR}/cases/tiny/campaign.yaml
                 -DRUN=${browser_build}/run -P "${browser_source}/run_campaign.cmake")
set_tests_properties(report.run PROPERTIES LABELS workflow TIMEOUT 600 FIXTURES_SETUP report_run)
add_test(NAME report.browser COMMAND "${NODE_PROGRAM}" report.mjs "${browser_build}/run/report" "${browser_build}/pictures"
         WORKING_DIRECTORY "${browser_build}")
set_tests_properties(report.browser PROPERTIES LABELS workflow TIMEOUT 300 FIXTURES_REQUIRED report_run)
add_test(NAME report.serve COMMAND "${NODE_PROGRAM}" serve.mjs $<TARGET_FILE:cupola> "${browser_build}/run" "${browser_build}/pictures"
         WORKING_DIRECTORY "${browser_build}")
set_tests_properties(report.serve PROPERTIES LABELS workflow TIMEOUT 120 FIXTURES_REQUIRED report_run)

# ParaView is among the packages of `make test`, not of `make run`: where it is missing the test says so.
add_test(NAME report.paraview COMMAND sh -c "command -v pvpython > /dev/null || { echo 'SKIPPED: no pvpython here (Debian: python3-paraview)'; exit 77; }; exec pvpython \"$1\" \"$2\""
                                      pvpython "${CMAKE_CURRENT_LIST_DIR}/paraview/open_views.py" "${browser_build}/run")
set_tests_properties(report.paraview PROPERTIES LABELS workflow TIMEOUT 120 FIXTURES_REQUIRED report_run SKIP_RETURN_CODE 77)
