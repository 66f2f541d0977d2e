# Installs the package into a scratch prefix, then configures, compiles and runs the consumer against it.
# cmake -DBUILD=<build folder> -DCOMPILER=<c++> -P run.cmake
set(scratch ${BUILD}/check/consumer)
file(REMOVE_RECURSE ${scratch})
foreach(command
    "${CMAKE_COMMAND};--install;${BUILD};--prefix;${scratch}/prefix"
    "${CMAKE_COMMAND};-S;${CMAKE_CURRENT_LIST_DIR};-B;${scratch}/build;-DCMAKE_PREFIX_PATH=${scratch}/prefix;-DCMAKE_CXX_COMPILER=${COMPILER}"
    "${CMAKE_COMMAND};--build;${scratch}/build"
    "${scratch}/build/pendulum")
  execute_process(COMMAND ${command} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
