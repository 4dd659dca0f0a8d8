# Only what the scene needs: counted by callgrind.
if(NOT TARGET cupola_tracer_program)
  return()
endif()
find_program(VALGRIND_PROGRAM valgrind REQUIRED)
add_executable(lean_scene lean/lean_scene_test.cpp)
cupola_own_code(lean_scene)
target_link_libraries(lean_scene PRIVATE cupola_tracer_program GTest::gtest GTest::gtest_main)
gtest_discover_tests(lean_scene TEST_PREFIX "lean_scene." DISCOVERY_TIMEOUT 60 PROPERTIES LABELS verification TIMEOUT 1200)
