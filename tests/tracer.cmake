cupola_test(
  unit_tracer
  LABEL unit
  SOURCES unit/tracer/charge_test.cpp unit/tracer/heat_test.cpp unit/tracer/melting_zone_test.cpp
  LIBRARIES cupola_tracer_parts cupola_box_mesh)
