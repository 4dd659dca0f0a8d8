# The tracer stage at full size (bench/tracer.cpp).
add_executable(bench_tracer tracer.cpp tracer_task.cpp reduced_field.cpp)
cupola_own_code(bench_tracer)
target_compile_definitions(bench_tracer PRIVATE CUPOLA_SOURCE_DIR="${CMAKE_SOURCE_DIR}" CUPOLA_TRACER="$<TARGET_FILE:cupola-tracer>"
                                                CUPOLA_MPIEXEC="${MPIEXEC_EXECUTABLE}")
target_link_libraries(bench_tracer PRIVATE cupola_settled_bed cupola_closures cupola_schemas CLI11::CLI11 fmt::fmt nlohmann_json::nlohmann_json)
add_dependencies(bench_tracer cupola-tracer)
