# Tests of physics/equations, physics/projection and physics/gas.
cupola_library(cupola_box_mesh support/box_mesh.cpp support/structured_mesh.cpp)
target_link_libraries(cupola_box_mesh PUBLIC cupola_bed_mesh)

cupola_test(cell_sums_test LABEL unit
  SOURCES unit/gas/bed_state_test.cpp unit/gas/cell_spreading_test.cpp unit/gas/cell_sums_test.cpp
  LIBRARIES cupola_cell_sums cupola_box_mesh)

foreach(subject darcy_forchheimer gas_energy gas_properties navier_stokes openings)
  cupola_test(${subject}_test LABEL verification
    SOURCES verification/gas/${subject}_test.cpp
    LIBRARIES cupola_gas cupola_foam_environment)
endforeach()
cupola_test(clean_field_test LABEL verification
  SOURCES verification/gas/clean_field_test.cpp
  LIBRARIES cupola_projection cupola_foam_environment)

# The same arrays on one and on two ranks.
add_executable(gas_ranks_test verification/gas/ranks_test.cpp)
cupola_own_code(gas_ranks_test)
target_link_libraries(gas_ranks_test PRIVATE cupola_gas cupola_projection cupola_foam_environment fmt::fmt MPI::MPI_CXX)
set(ranks_folder "${CMAKE_CURRENT_BINARY_DIR}/gas_ranks")
add_test(NAME gas_ranks_test.one COMMAND gas_ranks_test one "${ranks_folder}")
add_test(NAME gas_ranks_test.two_equal_one
  COMMAND mpirun --allow-run-as-root --oversubscribe --bind-to none -n 2 $<TARGET_FILE:gas_ranks_test> two "${ranks_folder}")
set_tests_properties(gas_ranks_test.one PROPERTIES FIXTURES_SETUP gas_ranks)
set_tests_properties(gas_ranks_test.two_equal_one PROPERTIES FIXTURES_REQUIRED gas_ranks PROCESSORS 2)
set_tests_properties(gas_ranks_test.one gas_ranks_test.two_equal_one PROPERTIES LABELS verification TIMEOUT 300)
