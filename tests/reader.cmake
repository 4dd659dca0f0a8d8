cupola_test(reader LABEL unit
  SOURCES unit/reader/error_messages_test.cpp unit/reader/units_test.cpp unit/reader/resolved_test.cpp unit/reader/task_test.cpp
          unit/reader/launch_test.cpp unit/reader/robustness_test.cpp
  LIBRARIES cupola_schemas)
target_compile_definitions(reader PRIVATE CUPOLA_SOURCE="${CMAKE_SOURCE_DIR}")
