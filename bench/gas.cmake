# Seconds by part of gas, projection and cleaning (bench/gas.cpp).
add_executable(bench_gas gas.cpp)
cupola_own_code(bench_gas)
target_link_libraries(bench_gas PRIVATE cupola_gas cupola_projection cupola_foam_environment fmt::fmt)
