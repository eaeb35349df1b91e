# SPDX-License-Identifier: MIT
# Each run of the solver fails by itself where radius, topology, volume or surfactant are not as expected. Included by
# program.cmake.
if(NOT configured MATCHES "Eigen 3: found")
  message("SKIPPED: all, since there is no Eigen 3")
  return()
endif()
foreach(scene sphere dumbbell droplet)
  run(printed ${FOLDER}/build/solver ${scene})
  message(STATUS "${scene}\n${printed}")
endforeach()
