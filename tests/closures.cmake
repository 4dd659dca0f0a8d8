cupola_test(test_closures LABEL unit
  SOURCES unit/closures/drag_test.cpp unit/closures/drag_laws_test.cpp unit/closures/heat_test.cpp unit/closures/heat_laws_test.cpp unit/closures/solids_test.cpp unit/closures/inlet_test.cpp
          "${CMAKE_SOURCE_DIR}/schemas/gas_presets.cpp"  # all that the tests need of the schemas
  LIBRARIES cupola_closures)
