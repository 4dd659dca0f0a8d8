cupola_test(
  unit_motion
  LABEL unit
  SOURCES unit/motion/path_test.cpp support/structured_mesh.cpp
  LIBRARIES cupola_motion)
