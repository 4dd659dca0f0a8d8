include(GoogleTest)

# The flags of our own code.
function(cupola_own_code target)
  target_include_directories(${target} PUBLIC "${CMAKE_SOURCE_DIR}")
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)  # false alarms on std::string (GCC bug 105651)
  endif()
  if(CUPOLA_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(CUPOLA_SANITIZE)
    # OpenFOAM itself trips over the vptr and null checks; the last three double the time to compile.
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize=vptr,null,alignment,object-size,pointer-overflow -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(CUPOLA_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link -fno-sanitize-recover=undefined)
  endif()
endfunction()

# cupola_library(NAME sources...): a static library of ours.
function(cupola_library target)
  add_library(${target} STATIC ${ARGN})
  cupola_own_code(${target})
endfunction()

# What the sanitizers are run on: programs, and tests of the labels `unit` and `workflow`.
add_custom_target(sanitized)

# cupola_test(NAME LABEL label SOURCES ... LIBRARIES ...): a GoogleTest program on one process, its tests found by ctest.
function(cupola_test name)
  cmake_parse_arguments(TEST "" "LABEL" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  cupola_own_code(${name})
  target_link_libraries(${name} PRIVATE ${TEST_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  if(TEST_LABEL MATCHES "unit|workflow")
    add_dependencies(sanitized ${name})
  endif()
  gtest_discover_tests(${name} TEST_PREFIX "${name}." PROPERTIES LABELS "${TEST_LABEL}" TIMEOUT 600 DISCOVERY_TIMEOUT 60)
endfunction()

# cupola_mpi_test(NAME LABEL label RANKS n PROGRAM target ARGUMENTS ...): a program of ours under mpirun.
function(cupola_mpi_test name)
  cmake_parse_arguments(TEST "" "LABEL;RANKS;PROGRAM" "ARGUMENTS" ${ARGN})
  add_test(NAME ${name} COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe --bind-to none -n ${TEST_RANKS}
                                $<TARGET_FILE:${TEST_PROGRAM}> ${TEST_ARGUMENTS})
  set_tests_properties(${name} PROPERTIES LABELS "${TEST_LABEL}" TIMEOUT 600 PROCESSORS ${TEST_RANKS}
                       ENVIRONMENT "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1")
endfunction()
