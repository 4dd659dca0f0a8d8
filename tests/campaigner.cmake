cupola_test(
  unit_orchestrator
  LABEL unit
  SOURCES unit/orchestrator/convergence_test.cpp unit/orchestrator/journal_test.cpp unit/orchestrator/process_test.cpp
          unit/orchestrator/progress_test.cpp unit/orchestrator/run_folder_test.cpp unit/orchestrator/stage_state_test.cpp
          unit/orchestrator/result_check_test.cpp
  LIBRARIES cupola_orchestrator)
target_compile_definitions(unit_orchestrator PRIVATE CUPOLA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")

# Exit statuses and messages of the program itself.
if(TARGET cupola)
  add_test(NAME unit_command_line COMMAND "${CMAKE_CURRENT_LIST_DIR}/unit/orchestrator/command_line_test.sh"
                                          $<TARGET_FILE:cupola> "${CMAKE_SOURCE_DIR}")
  set_tests_properties(unit_command_line PROPERTIES LABELS unit TIMEOUT 120)
endif()
