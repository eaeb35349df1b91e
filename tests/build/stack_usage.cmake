# SPDX-License-Identifier: MIT
# cmake -D PROGRAM=... -D OBJDUMP=... -D OBJECTS=a.o,b.o... -D LIMIT=... -D FOLDER=... -P stack_usage.cmake
# The deepest stack of every function of the interface, from GCC's call graphs beside the objects (stack_usage.cpp).
string(REPLACE "," ";" objects "${OBJECTS}")
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${OBJDUMP} -r ${objects} OUTPUT_FILE ${FOLDER}/relocations.txt COMMAND_ERROR_IS_FATAL ANY)
list(TRANSFORM objects REPLACE "\\.o(bj)?$" ".ci" OUTPUT_VARIABLE graphs)
execute_process(COMMAND ${PROGRAM} ${LIMIT} ${FOLDER}/relocations.txt ${graphs} COMMAND_ERROR_IS_FATAL ANY)
