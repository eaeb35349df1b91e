# SPDX-License-Identifier: MIT
# The texts of web/ as constants: view_page_text.cpp in the build's folder.
set(web ${CMAKE_CURRENT_SOURCE_DIR}/view/web)
set(page_script "")
foreach(part data mesh slices chart main)
  file(READ ${web}/${part}.js text)
  string(APPEND page_script "${text}")
endforeach()
file(READ ${web}/page.css page_style)
file(READ ${web}/page.html page_text)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${web}/data.js ${web}/mesh.js ${web}/slices.js
  ${web}/chart.js ${web}/main.js ${web}/page.css ${web}/page.html)
configure_file(view/page_text.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/view_page_text.cpp @ONLY)
