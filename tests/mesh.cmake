cupola_test(
  unit_mesh
  LABEL unit
  SOURCES unit/mesh/prepare_test.cpp
  LIBRARIES cupola_mesh cupola_foam_environment)
