# Adds the core's sources to a program as the embedding page says, links it statically, and fails if it
# does not light a room or is not below 1 MB. Usage: cmake -DSOURCE=.. -DWORK=.. -DCC=cc -DCXX=c++ -P
set(most_bytes 1000000)
file(MAKE_DIRECTORY ${WORK})
execute_process(COMMAND make -s core-sources WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE sources
  COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \n]+" sources "${sources}")
execute_process(COMMAND ${CC} -std=c99 -Os -I radiosity/c_api -c radiosity/c_api/examples/room.c
  -o ${WORK}/room.o WORKING_DIRECTORY ${SOURCE} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CXX} -std=c++20 -ffp-contract=off -I. -DHC_NO_THREADS
  -Os -fno-exceptions -fno-rtti -fno-math-errno -fno-trapping-math -fno-asynchronous-unwind-tables
  -ffunction-sections -fdata-sections -Wl,--gc-sections -Wl,-z,noseparate-code
  ${sources} ${WORK}/room.o -static -s -o ${WORK}/room
  WORKING_DIRECTORY ${SOURCE} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/room COMMAND_ERROR_IS_FATAL ANY)
file(SIZE ${WORK}/room bytes)
message("a static program of ${bytes} bytes")
if(bytes GREATER_EQUAL most_bytes)
  message(FATAL_ERROR "it must stay below ${most_bytes}")
endif()
