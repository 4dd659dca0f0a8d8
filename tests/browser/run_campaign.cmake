# Runs a campaign afresh: cmake -DCUPOLA=... -DCAMPAIGN=... -DRUN=... -P run_campaign.cmake
# Its lasting species gets another name than the usual one, so that the report shows whether it takes names from the campaign.
file(REMOVE_RECURSE "${RUN}")
file(READ "${CAMPAIGN}" text)
string(REPLACE "coke" "anthracite" text "${text}")
file(WRITE "${RUN}.yaml" "${text}")
execute_process(COMMAND "${CUPOLA}" run "${RUN}.yaml" --run-dir "${RUN}" RESULT_VARIABLE status)
# 75: ended at its limit of episodes, which is an end that a report must show as well.
if(NOT status EQUAL 0 AND NOT status EQUAL 75)
  message(FATAL_ERROR "cupola run ended with ${status}")
endif()
if(NOT EXISTS "${RUN}/report/index.html" OR NOT EXISTS "${RUN}/report/report.json")
  message(FATAL_ERROR "cupola run left no report in ${RUN}/report")
endif()
