# The DEM stage by parts (bench/dem.cpp).
add_executable(bench_dem dem.cpp dem_bed.cpp)
cupola_own_code(bench_dem)
target_compile_definitions(bench_dem PRIVATE CUPOLA_MPIEXEC="${MPIEXEC_EXECUTABLE}")
target_link_libraries(bench_dem PRIVATE cupola_dem_stage cupola_foam_environment CLI11::CLI11 fmt::fmt nlohmann_json::nlohmann_json)
