cupola_test(
  unit_mesh
  LABEL unit
  SOURCES unit/mesh/prepare_test.cpp unit/mesh/cell_locator_test.cpp unit/mesh/wall_triangles_test.cpp
  LIBRARIES cupola_mesh cupola_foam_environment)

# FoamCase on one rank and on several; the last argument is the exit status the program is to end with.
add_executable(unit_foam_case unit/mesh/foam_case_test.cpp)
cupola_own_code(unit_foam_case)
target_link_libraries(unit_foam_case PRIVATE cupola_mesh cupola_foam_environment GTest::gtest)
cupola_mpi_test(unit_foam_case_1 LABEL unit RANKS 1 PROGRAM unit_foam_case ARGUMENTS "${CMAKE_CURRENT_BINARY_DIR}/foam_case_1")
cupola_mpi_test(unit_foam_case_2 LABEL unit RANKS 2 PROGRAM unit_foam_case ARGUMENTS "${CMAKE_CURRENT_BINARY_DIR}/foam_case_2")
cupola_mpi_test(unit_foam_case_4 LABEL unit RANKS 4 PROGRAM unit_foam_case ARGUMENTS "${CMAKE_CURRENT_BINARY_DIR}/foam_case_4")
add_test(NAME unit_foam_case_keeps_exit_status
         COMMAND sh -c "$<TARGET_FILE:unit_foam_case> ${CMAKE_CURRENT_BINARY_DIR}/foam_case_status 75; test $? -eq 75")
set_tests_properties(unit_foam_case_keeps_exit_status PROPERTIES LABELS unit)
