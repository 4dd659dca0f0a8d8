add_executable(bench_motion bench_motion.cpp "${CMAKE_SOURCE_DIR}/tests/support/structured_mesh.cpp")
cupola_own_code(bench_motion)
target_link_libraries(bench_motion PRIVATE cupola_motion fmt::fmt nlohmann_json::nlohmann_json)
