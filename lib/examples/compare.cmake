# Runs an example and compares what it prints with a file: cmake -DPROGRAM=... -DNAME=... -DEXPECTED=... -P compare.cmake
execute_process(COMMAND ${PROGRAM} ${NAME} OUTPUT_VARIABLE printed RESULT_VARIABLE status)
file(READ ${EXPECTED} expected)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${NAME} ended with status ${status} and printed:\n${printed}")
endif()
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "${NAME} printed\n${printed}\nwhere ${EXPECTED} has\n${expected}")
endif()
