# Passes when the compiler refuses SOURCE with the sentence of its first line, `// error: sentence`.
# cmake -DCOMPILER=<c++> -DSOURCE=<file> "-DINCLUDES=<folder>;<folder>" -P refused.cmake
file(STRINGS ${SOURCE} first LIMIT_COUNT 1)
string(REGEX REPLACE "^// error: " "" sentence "${first}")
string(REPLACE "\\;" ";" sentence "${sentence}")  # file(STRINGS) escapes them
set(folders)
foreach(folder IN LISTS INCLUDES)
  list(APPEND folders -isystem ${folder})
endforeach()
execute_process(COMMAND ${COMPILER} -std=c++20 -fsyntax-only ${folders} ${SOURCE} ERROR_VARIABLE said RESULT_VARIABLE status)
string(FIND "${said}" "${sentence}" found)
if(status EQUAL 0 OR found EQUAL -1)
  message(FATAL_ERROR "Expected the compiler to refuse ${SOURCE} with \"${sentence}\"; status ${status}, it said:\n${said}")
endif()
