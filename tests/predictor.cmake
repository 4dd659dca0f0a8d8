# The steady solution on streamlines.
cupola_test(
  unit_predictor
  LABEL unit
  SOURCES unit/predictor/stay_test.cpp unit/predictor/counter_flow_matrix_test.cpp
  LIBRARIES cupola_tracer cupola_box_mesh cupola_foam_environment)

cupola_test(
  verification_predictor
  LABEL verification
  SOURCES verification/predictor/predictor_test.cpp
  LIBRARIES cupola_settled_bed cupola_tracer_parts cupola_bed_mesh cupola_plan cupola_closures cupola_schemas)
target_compile_definitions(verification_predictor PRIVATE CUPOLA_TRACER="$<TARGET_FILE:cupola-tracer>")
add_dependencies(verification_predictor cupola-tracer)
