# A real Slurm of one node, started on loopback by the test itself; skipped, with the reason, where it cannot be started.
if(TARGET cupola AND TARGET cupola-dem AND TARGET cupola-tracer)
  add_test(NAME slurm_campaign COMMAND "${CMAKE_CURRENT_LIST_DIR}/slurm/campaign_test.sh" $<TARGET_FILE:cupola>
                                       "${CMAKE_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}/slurm")
  set_tests_properties(slurm_campaign PROPERTIES LABELS slurm TIMEOUT 900 SKIP_RETURN_CODE 77 PROCESSORS 2)
endif()
