# Passes when the compiler refuses SOURCE with the sentence of its first line, `// error: sentence`.
# cmake -DCOMPILER=<c++> -DSOURCE=<file> "-DINCLUDES=<folder>;<folder>" -DFIRST=<file> -P refused.cmake
# FIRST is a header that brings the whole library before it, FIRST.gch the same compiled; the same call without SOURCE makes both.
set(folders)
foreach(folder IN LISTS INCLUDES)
  list(APPEND folders -isystem ${folder})
endforeach()
set(compile ${COMPILER} -std=c++20 ${folders})
if(NOT SOURCE)
  file(WRITE ${FIRST} "#include <avi/avi.hpp>\n")
  execute_process(COMMAND ${compile} -x c++-header ${FIRST} -o ${FIRST}.gch COMMAND_ERROR_IS_FATAL ANY)
  return()
endif()
file(STRINGS ${SOURCE} first LIMIT_COUNT 1)
string(REGEX REPLACE "^// error: " "" sentence "${first}")
string(REPLACE "\\;" ";" sentence "${sentence}")  # file(STRINGS) escapes them
file(STRINGS ${SOURCE} flags REGEX "^#define __")  # what headers look at must be so from the beginning
if(NOT flags)
  list(APPEND compile -include ${FIRST})
endif()
execute_process(COMMAND ${compile} -fsyntax-only ${SOURCE} ERROR_VARIABLE said RESULT_VARIABLE status)
string(FIND "${said}" "${sentence}" found)
if(status EQUAL 0 OR found EQUAL -1)
  message(FATAL_ERROR "Expected the compiler to refuse ${SOURCE} with \"${sentence}\"; status ${status}, it said:\n${said}")
endif()
