cupola_test(test_counter_current_bed LABEL verification
  SOURCES verification/counter_current_bed_test.cpp
  LIBRARIES cupola_plan)
cupola_test(test_plan LABEL unit
  SOURCES unit/plan/plan_test.cpp
  LIBRARIES cupola_plan)
