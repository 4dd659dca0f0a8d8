# Stiff and extreme cases of both stages: docs/stability.md.
cupola_library(cupola_tracer_run support/tracer_run.cpp)
target_link_libraries(cupola_tracer_run PUBLIC cupola_settled_bed cupola_schemas)

cupola_test(
  stability_tracer
  LABEL stability
  SOURCES stability/tracer_extremes_test.cpp
  LIBRARIES cupola_tracer_run)
target_compile_definitions(stability_tracer PRIVATE CUPOLA_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                                                    CUPOLA_TRACER="$<TARGET_FILE:cupola-tracer>")
add_dependencies(stability_tracer cupola-tracer)

add_executable(stability_dem stability/dem_extremes_test.cpp unit/dem/box_scene.cpp unit/dem/mpi_main.cpp)
cupola_own_code(stability_dem)
target_link_libraries(stability_dem PRIVATE cupola_dem cupola_plan cupola_box_mesh GTest::gtest GTest::gmock)
cupola_mpi_test(stability_dem_collisions LABEL stability RANKS 1 PROGRAM stability_dem ARGUMENTS --gtest_filter=*Collisions*)
cupola_mpi_test(stability_dem_heaps LABEL stability RANKS 1 PROGRAM stability_dem ARGUMENTS --gtest_filter=*Heaps*)
cupola_mpi_test(stability_dem_winds LABEL stability RANKS 1 PROGRAM stability_dem ARGUMENTS --gtest_filter=*Winds*)
cupola_mpi_test(stability_dem_wide_parcels LABEL stability RANKS 1 PROGRAM stability_dem ARGUMENTS --gtest_filter=*WideParcels*)

add_executable(stability_column stability/column_extremes_test.cpp)
cupola_own_code(stability_column)
target_link_libraries(stability_column PRIVATE cupola_tracer_program GTest::gtest GTest::gtest_main)
gtest_discover_tests(stability_column TEST_PREFIX "stability_column." TEST_FILTER "-*Long*" DISCOVERY_TIMEOUT 60
                     PROPERTIES LABELS stability TIMEOUT 600)
gtest_discover_tests(stability_column TEST_PREFIX "stability_column." TEST_FILTER "*Long*" DISCOVERY_TIMEOUT 60
                     PROPERTIES LABELS long TIMEOUT 3600)
