# The DEM stage: its engine and its parts on one and on two ranks.
set(two_ranks mpirun --allow-run-as-root --oversubscribe --bind-to none -n 2)

# cupola_mpi_test(NAME LABEL label SOURCES ... LIBRARIES ...): one program, run whole on one and on two ranks.
function(cupola_mpi_test name)
  cmake_parse_arguments(TEST "" "LABEL" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${TEST_SOURCES} unit/dem/mpi_main.cpp)
  cupola_own_code(${name})
  target_link_libraries(${name} PRIVATE ${TEST_LIBRARIES} MPI::MPI_CXX GTest::gtest GTest::gmock)
  add_test(NAME ${name}.1rank COMMAND ${name})
  add_test(NAME ${name}.2ranks COMMAND ${two_ranks} $<TARGET_FILE:${name}>)
  set_tests_properties(${name}.1rank ${name}.2ranks PROPERTIES LABELS "${TEST_LABEL}" TIMEOUT 300)
endfunction()

cupola_mpi_test(test_dem_engine LABEL verification SOURCES unit/dem/test_engine.cpp unit/dem/box_scene.cpp LIBRARIES cupola_dem)
