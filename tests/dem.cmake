# The DEM stage: its engine and its parts on one and on two ranks, the program on a tiny slot.
foreach(part engine parts)
  add_executable(test_dem_${part} unit/dem/test_${part}.cpp unit/dem/box_scene.cpp unit/dem/mpi_main.cpp)
  cupola_own_code(test_dem_${part})
  target_link_libraries(test_dem_${part} PRIVATE cupola_dem GTest::gtest GTest::gmock)
  foreach(ranks 1 2)
    cupola_mpi_test(dem_${part}_${ranks} LABEL verification RANKS ${ranks} PROGRAM test_dem_${part})
  endforeach()
endforeach()
target_link_libraries(test_dem_parts PRIVATE cupola_box_mesh)

cupola_test(dem_program LABEL workflow SOURCES workflow/dem_program_test.cpp LIBRARIES cupola_schemas)
add_dependencies(dem_program cupola-dem)
target_compile_definitions(dem_program PRIVATE CUPOLA_DEM="$<TARGET_FILE:cupola-dem>" CUPOLA_MPIEXEC="${MPIEXEC_EXECUTABLE}"
                                               CUPOLA_TINY="${CMAKE_SOURCE_DIR}/cases/tiny/campaign.yaml")
