# Runs PROGRAM with 0, 1 and 2 raster threads: its output, a picture's hash, must not change.
cmake_minimum_required(VERSION 3.25)
foreach(threads 0 1 2)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LP_NUM_THREADS=${threads} ${PROGRAM}
    OUTPUT_VARIABLE hash COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND hashes "${hash}")
endforeach()
list(REMOVE_DUPLICATES hashes)
list(LENGTH hashes count)
if(NOT count EQUAL 1 OR NOT hashes MATCHES "^[0-9a-f]+\n$")
  message(FATAL_ERROR "expected one hash with 0, 1 and 2 threads, got ${hashes}")
endif()
