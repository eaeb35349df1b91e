# SPDX-License-Identifier: MIT
# cmake -D SOURCE=... -D LIBRARY=... -D PYTHON=... -D BLENDER=... -D XVFB=... -D FOLDER=... -P blender.cmake
# The add-on of examples/blender, from its archive, in a Blender without settings of a user: operators and pictures; and in a
# window, where there is xvfb-run.
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE status OUTPUT_VARIABLE text
    ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${text}${errors}")
  endif()
  set(text "${text}${errors}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/pictures)
unset(ENV{PYTHONPATH})
unset(ENV{TOPOADAPT_LIBRARY})
foreach(kind CONFIG SCRIPTS DATAFILES)
  set(ENV{BLENDER_USER_${kind}} ${FOLDER}/user)
endforeach()
run(${PYTHON} -B ${SOURCE}/examples/python/wheel.py ${FOLDER} ${LIBRARY})
file(GLOB wheel ${FOLDER}/*.whl)
run(${PYTHON} -B ${SOURCE}/examples/blender/package.py ${FOLDER}/addon.zip ${wheel})
run(${BLENDER} -b --factory-startup --python-exit-code 1 --python ${SOURCE}/examples/blender/tests/in_blender.py
  -- ${FOLDER}/addon.zip ${FOLDER}/pictures)
if(NOT text MATCHES "\nRan [1-9][0-9]* tests" OR NOT text MATCHES "\nOK")
  message(FATAL_ERROR "no test was run\n${text}")
endif()
foreach(name resolve inflate)
  foreach(kind before after)
    file(SIZE ${FOLDER}/pictures/${name}-${kind}.png bytes)
    if(bytes LESS 20000)  # an empty picture has some thousand
      message(FATAL_ERROR "${name}-${kind}.png shows nothing")
    endif()
  endforeach()
endforeach()

if(XVFB)
  set(ENV{LIBGL_ALWAYS_SOFTWARE} 1)
  run(${XVFB} -a -s "-screen 0 1280x800x24" ${BLENDER} --factory-startup --window-geometry 0 0 1280 800
    --python ${SOURCE}/examples/blender/tests/in_window.py -- ${FOLDER}/addon.zip)
endif()
