cupola_test(
  unit_orchestrator
  LABEL unit
  SOURCES unit/orchestrator/convergence_test.cpp unit/orchestrator/journal_test.cpp unit/orchestrator/process_test.cpp
          unit/orchestrator/progress_test.cpp unit/orchestrator/run_folder_test.cpp unit/orchestrator/stage_orders_test.cpp unit/orchestrator/stage_state_test.cpp
          unit/orchestrator/remaining_time_test.cpp unit/orchestrator/result_check_test.cpp
          unit/orchestrator/slurm_test.cpp unit/orchestrator/measured_rates_test.cpp
  LIBRARIES cupola_orchestrator)
target_compile_definitions(unit_orchestrator PRIVATE CUPOLA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")

# Exit statuses and messages of the program itself.
if(TARGET cupola)
  add_test(NAME unit_command_line COMMAND "${CMAKE_CURRENT_LIST_DIR}/unit/orchestrator/command_line_test.sh"
                                          $<TARGET_FILE:cupola> "${CMAKE_SOURCE_DIR}")
  set_tests_properties(unit_command_line PROPERTIES LABELS unit TIMEOUT 120)
endif()

# The tiny campaign through the real stages, left alone and disturbed.
if(TARGET cupola AND TARGET cupola-dem AND TARGET cupola-tracer)
  foreach(ranks 1 2)
    add_test(NAME workflow_campaign_${ranks} COMMAND "${CMAKE_CURRENT_LIST_DIR}/workflow/campaign_test.sh" $<TARGET_FILE:cupola>
                                                     "${CMAKE_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}/campaign_${ranks}" ${ranks})
    set_tests_properties(workflow_campaign_${ranks} PROPERTIES LABELS workflow TIMEOUT 900 PROCESSORS ${ranks})
  endforeach()
  add_test(NAME workflow_predict_and_verify
           COMMAND "${CMAKE_CURRENT_LIST_DIR}/workflow/predict_and_verify_test.sh" $<TARGET_FILE:cupola> "${CMAKE_SOURCE_DIR}"
                   "${CMAKE_CURRENT_BINARY_DIR}/predict_and_verify")
  set_tests_properties(workflow_predict_and_verify PROPERTIES LABELS workflow TIMEOUT 900 PROCESSORS 2)
  add_test(NAME workflow_retry COMMAND "${CMAKE_CURRENT_LIST_DIR}/workflow/retry_test.sh" $<TARGET_FILE:cupola>
                                       "${CMAKE_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}/retry")
  set_tests_properties(workflow_retry PROPERTIES LABELS workflow TIMEOUT 300)
endif()
