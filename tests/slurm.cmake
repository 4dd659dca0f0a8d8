# A real Slurm of one node, started on loopback by the test itself; skipped, with the reason, where it cannot be started.
if(TARGET cupola AND TARGET cupola-dem AND TARGET cupola-tracer)
  foreach(name campaign study time_limit)
    add_test(NAME slurm_${name} COMMAND "${CMAKE_CURRENT_LIST_DIR}/slurm/${name}_test.sh" $<TARGET_FILE:cupola>
                                        "${CMAKE_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}/slurm_${name}")
    set_tests_properties(slurm_${name} PROPERTIES LABELS slurm TIMEOUT 1800 SKIP_RETURN_CODE 77 PROCESSORS 2
                         RUN_SERIAL ON)
  endforeach()
  # Slurm knows time limits of whole minutes only.
  set_tests_properties(slurm_time_limit PROPERTIES LABELS "slurm;long")
endif()
