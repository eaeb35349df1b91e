# SPDX-License-Identifier: MIT
# The game fails by itself where it spends more than the budget, where the copied buffers are not the mesh, and where the
# mesh meets itself. Included by program.cmake.
set(game ${FOLDER}/build/game)
run(plenty ${game} --frames 600)
expect("${plenty}" " [1-9][0-9]* merges, [1-9][0-9]* splits")
expect("${plenty}" "short of   0 frames held vertices back, 0 in a row at most")
message(STATUS "${plenty}")
# Frames that have to make do with fewer vertices; about frame 970 a sweep does not even hold the check of its work.
run(short ${game} --frames 1000 --budget 100000)
expect("${short}" "short of   [1-9][0-9]* frames held vertices back, [0-9]+ in a row at most; [1-9][0-9]* remeshings went on")
message(STATUS "${short}")
# A frame dearer than the budget, and the shape that it has without a bound. The game fails where both are apart for more
# than a second.
run(twin ${game} --frames 1200 --blobs 3 --edge 0.08 --budget 150000 --twin)
expect("${twin}" "unbounded  dearest frame ([2-9]|1[5-9])[0-9][0-9][0-9][0-9][0-9]+ units")
expect("${twin}" "apart      [1-9][0-9]* frames")
message(STATUS "${twin}")
if(NOT configured MATCHES "SDL 2: found")
  message("SKIPPED: pictures, since there is no SDL 2")
  return()
endif()
# The same game in a window, without a screen.
set(ENV{SDL_VIDEODRIVER} dummy)
run(headless ${game} --frames 120)
run(window ${game} --frames 120 --window --picture ${FOLDER}/picture.bmp)
line_of("${headless}" mesh mesh)
line_of("${window}" mesh mesh_in_window)
if(NOT mesh STREQUAL mesh_in_window)
  message(FATAL_ERROR "${mesh}\nin a window\n${mesh_in_window}")
endif()
# The picture has background, and other things.
file(SIZE ${FOLDER}/picture.bmp size)
file(READ ${FOLDER}/picture.bmp points OFFSET 54 HEX)
string(REPLACE "f0f5f5" "" others "${points}")
string(LENGTH "${points}" all)
string(LENGTH "${others}" rest)
math(EXPR percent "100 * ${rest} / ${all}")
if(size LESS 1000000 OR percent LESS 30 OR percent GREATER 90)
  message(FATAL_ERROR "a picture of ${size} bytes, ${percent} % of it drawn")
endif()
