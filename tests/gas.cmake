# Tests of physics/equations, physics/projection and physics/gas.
cupola_library(cupola_box_mesh support/box_mesh.cpp)
target_link_libraries(cupola_box_mesh PUBLIC cupola_bed_mesh)

cupola_test(cell_sums_test LABEL unit
  SOURCES unit/gas/bed_state_test.cpp unit/gas/cell_spreading_test.cpp unit/gas/cell_sums_test.cpp
  LIBRARIES cupola_cell_sums cupola_box_mesh)
