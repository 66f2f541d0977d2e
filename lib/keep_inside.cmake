# Hides in a static library all functions but its own that are no templates and not inline. Of those the linker keeps one for a
# whole program, Eigen's among them; and what they do depends on the -m options of the file that they come from.
# cmake -DLIBRARY=<.a> -DLD= -DNM= -DOBJCOPY= -DAR= -P keep_inside.cmake
execute_process(COMMAND ${NM} ${LIBRARY} OUTPUT_VARIABLE symbols ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " T [^\n]+" symbols "${symbols}")
list(TRANSFORM symbols REPLACE " T " "--keep-global-symbol=")
set(object ${LIBRARY}.o)
execute_process(COMMAND ${LD} -r --force-group-allocation --whole-archive ${LIBRARY} -o ${object} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${OBJCOPY} ${symbols} ${object} COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE ${LIBRARY})
execute_process(COMMAND ${AR} rcs ${LIBRARY} ${object} COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE ${object})
