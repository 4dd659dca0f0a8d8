cupola_test(
  unit_tracer
  LABEL unit
  SOURCES unit/tracer/charge_test.cpp unit/tracer/granular_field_test.cpp unit/tracer/heat_test.cpp unit/tracer/march_control_test.cpp unit/tracer/melting_zone_test.cpp unit/tracer/tracers_test.cpp
  LIBRARIES cupola_tracer_parts cupola_box_mesh)

cupola_library(cupola_settled_bed support/settled_bed.cpp support/stated_bed.cpp)
target_link_libraries(cupola_settled_bed PUBLIC cupola_bed_mesh cupola_plan cupola_closures cupola_schemas)

# The stage as a program.
cupola_library(cupola_tracer_program support/tracer_program.cpp)
target_link_libraries(cupola_tracer_program PUBLIC cupola_settled_bed)
target_compile_definitions(cupola_tracer_program PRIVATE CUPOLA_TRACER="$<TARGET_FILE:cupola-tracer>"
                                                         CUPOLA_MPIEXEC="${MPIEXEC_EXECUTABLE}")
add_dependencies(cupola_tracer_program cupola-tracer)

cupola_test(
  workflow_tracer
  LABEL workflow
  SOURCES workflow/tracer/march_test.cpp workflow/tracer/march_control_test.cpp
  LIBRARIES cupola_tracer_program)
target_compile_definitions(workflow_tracer PRIVATE CUPOLA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")

# The numbered proofs of docs/verification_tracer.md; tests named Long… run in `make test-long` alone.
function(cupola_tracer_verification name)
  set(target tracer_${name})
  add_executable(${target} verification/tracer/${name}_test.cpp)
  cupola_own_code(${target})
  target_link_libraries(${target} PRIVATE cupola_tracer_program ${ARGN} GTest::gtest GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE CUPOLA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  gtest_discover_tests(${target} TEST_PREFIX "${target}." TEST_FILTER "-Long*" DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS verification TIMEOUT 600)
  gtest_discover_tests(${target} TEST_PREFIX "${target}." TEST_FILTER "Long*" DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS long TIMEOUT 7200)
endfunction()

foreach(proof 01_single_grain 02_schumann 03_counter_current 04_conduction 05_ergun 06_displacement 08_coarse_graining
              09_ranks 10_time_order 11_gas_models 12_ledger)
  cupola_tracer_verification(proof_${proof})
endforeach()
cupola_tracer_verification(proof_07_motion cupola_tracer_parts cupola_box_mesh)
cupola_tracer_verification(bad_input)
cupola_tracer_verification(materials)
