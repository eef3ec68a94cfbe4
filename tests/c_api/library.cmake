# Fails unless the shared library exports exactly what the header declares and needs nothing but the C
# library: not even libm. Usage: cmake -DLIBRARY=.. -DHEADER=.. -DNM=nm -DREADELF=readelf -P library.cmake
function(run output)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

run(symbols ${NM} -D --defined-only ${LIBRARY})
string(REGEX MATCHALL " [A-Za-z] [^\n]+" exported "${symbols}")
list(TRANSFORM exported REPLACE "^ . " "")
list(SORT exported)
file(READ ${HEADER} header)
string(REGEX MATCHALL "HC_API [a-z_ *]+[ *]hc_[a-z_]+\\(" declared "${header}")
list(TRANSFORM declared REPLACE "^.*[ *](hc_[a-z_]+)\\($" "\\1")
list(SORT declared)
list(LENGTH declared count)
if(count LESS 20 OR NOT "${exported}" STREQUAL "${declared}")
  message(FATAL_ERROR "declared: ${declared}\nexported: ${exported}")
endif()

run(dynamic ${READELF} -d ${LIBRARY})
string(REPLACE "[" "<" dynamic "${dynamic}") # a list with an open bracket is one element
string(REGEX MATCHALL "NEEDED[^\n]*<[^]]+" needed "${dynamic}")
list(TRANSFORM needed REPLACE "^.*<" "")
foreach(library IN LISTS needed)
  if(NOT library MATCHES "^(libc\\.so|ld-linux)") # the loader is the C library's: thread-local storage
    message(FATAL_ERROR "${LIBRARY} needs ${library}")
  endif()
endforeach()
message("${count} functions; needs ${needed}")
