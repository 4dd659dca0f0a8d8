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
