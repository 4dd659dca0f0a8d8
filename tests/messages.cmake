# What the programs say to wrong input, word for word.
if(TARGET cupola)
  add_test(NAME workflow_input_messages COMMAND "${CMAKE_CURRENT_LIST_DIR}/messages/input_messages.sh" $<TARGET_FILE:cupola>
                                                "${CMAKE_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}/input_messages")
  set_tests_properties(workflow_input_messages PROPERTIES LABELS workflow TIMEOUT 300)
endif()
# What they say to damaged runs: copies of the one that the fault tests leave alone.
if(TARGET cupola AND TARGET cupola-dem AND TARGET cupola-tracer)
  add_test(NAME fault_messages COMMAND "${CMAKE_CURRENT_LIST_DIR}/messages/run_messages.sh" $<TARGET_FILE:cupola> "${CMAKE_SOURCE_DIR}"
                                       "${CMAKE_CURRENT_BINARY_DIR}/run_messages")
  set_tests_properties(fault_messages PROPERTIES LABELS fault TIMEOUT 600 FIXTURES_REQUIRED fault_alone
                                                 ENVIRONMENT "CUPOLA_FAULT_RUN=${CMAKE_CURRENT_BINARY_DIR}/fault/alone")
endif()
