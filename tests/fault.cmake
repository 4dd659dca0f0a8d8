# Kills, errors of the file system, damage, places: all of them on one campaign that is first left alone.
if(TARGET cupola AND TARGET cupola-dem AND TARGET cupola-tracer)
  add_library(cupola_faults MODULE fault/fault_shim.c)
  target_compile_options(cupola_faults PRIVATE -std=gnu11 -Wall -Wextra)
  target_link_libraries(cupola_faults PRIVATE ${CMAKE_DL_LIBS})

  set(fault_work "${CMAKE_CURRENT_BINARY_DIR}/fault")
  find_program(NODE_PROGRAM node REQUIRED)
  # fault_test(NAME LABELS SCRIPT ARGUMENTS...)
  function(fault_test name labels script)
    add_test(NAME ${name} COMMAND ${NODE_PROGRAM} "${CMAKE_CURRENT_LIST_DIR}/fault/${script}" $<TARGET_FILE:cupola> "${CMAKE_SOURCE_DIR}"
                                  "${fault_work}" ${ARGN})
    # One after the other: they look at process ids and at wall time.
    set_tests_properties(${name} PROPERTIES LABELS "${labels}" TIMEOUT 1800 PROCESSORS 2 RESOURCE_LOCK fault_work)
  endfunction()

  fault_test(fault_alone fault alone.mjs $<TARGET_FILE:cupola_faults>)
  set_tests_properties(fault_alone PROPERTIES FIXTURES_SETUP fault_alone)
  # A fixed seed here, one of the day in the long ones.
  fault_test(fault_kills fault kills.mjs 10 1)
  fault_test(fault_io_errors fault io_errors.mjs $<TARGET_FILE:cupola_faults> 10 1)
  fault_test(fault_places fault places.mjs $<TARGET_FILE:cupola_faults>)
  fault_test(fault_kills_long "fault;long" kills.mjs 100)
  fault_test(fault_io_errors_long "fault;long" io_errors.mjs $<TARGET_FILE:cupola_faults> 100)
  set_tests_properties(fault_kills fault_io_errors fault_places fault_kills_long fault_io_errors_long PROPERTIES FIXTURES_REQUIRED fault_alone)
  set_tests_properties(fault_kills_long fault_io_errors_long PROPERTIES TIMEOUT 7200)

  foreach(part damage disk_errors)
    add_executable(fault_${part} fault/${part}_test.cpp)
    cupola_own_code(fault_${part})
    target_link_libraries(fault_${part} PRIVATE cupola_orchestrator cupola_bed_mesh GTest::gtest GTest::gmock GTest::gtest_main)
    add_test(NAME fault_${part} COMMAND fault_${part})
    set_tests_properties(fault_${part} PROPERTIES LABELS fault FIXTURES_REQUIRED fault_alone TIMEOUT 300
                                                  ENVIRONMENT "CUPOLA_FAULT_RUN=${fault_work}/alone")
  endforeach()
  target_link_libraries(fault_damage PRIVATE cupola_study)
  set_property(TEST fault_disk_errors APPEND PROPERTY ENVIRONMENT "LD_PRELOAD=$<TARGET_FILE:cupola_faults>")
endif()
