cupola_test(
  unit_tracer
  LABEL unit
  SOURCES unit/tracer/charge_test.cpp unit/tracer/granular_field_test.cpp unit/tracer/heat_test.cpp unit/tracer/melting_zone_test.cpp unit/tracer/tracers_test.cpp
  LIBRARIES cupola_tracer_parts cupola_box_mesh)

cupola_library(cupola_settled_bed support/settled_bed.cpp)
target_link_libraries(cupola_settled_bed PUBLIC cupola_bed_mesh cupola_plan cupola_closures cupola_schemas)

# The stage as a program.
cupola_test(
  workflow_tracer
  LABEL workflow
  SOURCES workflow/tracer/march_test.cpp
  LIBRARIES cupola_settled_bed cupola_schemas)
target_compile_definitions(
  workflow_tracer PRIVATE CUPOLA_SOURCE_DIR="${CMAKE_SOURCE_DIR}" CUPOLA_TRACER="$<TARGET_FILE:cupola-tracer>"
                          CUPOLA_MPIEXEC="${MPIEXEC_EXECUTABLE}")
add_dependencies(workflow_tracer cupola-tracer)

cupola_test(
  verification_tracer_counter_current
  LABEL verification
  SOURCES verification/tracer_counter_current_test.cpp
  LIBRARIES cupola_settled_bed cupola_schemas)
target_compile_definitions(verification_tracer_counter_current PRIVATE CUPOLA_TRACER="$<TARGET_FILE:cupola-tracer>")
add_dependencies(verification_tracer_counter_current cupola-tracer)
