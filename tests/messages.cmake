# What the programs say to wrong input, word for word.
if(TARGET cupola)
  add_test(NAME workflow_input_messages COMMAND "${CMAKE_CURRENT_LIST_DIR}/messages/input_messages.sh" $<TARGET_FILE:cupola>
                                                "${CMAKE_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}/input_messages")
  set_tests_properties(workflow_input_messages PROPERTIES LABELS workflow TIMEOUT 300)
endif()
