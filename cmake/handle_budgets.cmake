# handle_budgets: compiles every handle table anew with the configured compiler and flags, prints seconds of the
# processor, peak memory and read-only bytes, and fails where a table takes over 60 s or 2 GB, or all take over 512 KiB.
find_program(TOPOADAPT_SIZE NAMES ${_CMAKE_TOOLCHAIN_PREFIX}size size)
mark_as_advanced(TOPOADAPT_SIZE)
if(NOT UNIX OR NOT TOPOADAPT_SIZE)
  return()
endif()

add_executable(handle_budgets_runner EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/handle_budgets.c)

string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
separate_arguments(flags NATIVE_COMMAND "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${config}}")
set(jobs)
foreach(path IN LISTS TOPOADAPT_HANDLE_TABLES)
  get_filename_component(table ${path} NAME_WE)
  get_source_file_property(limits ${path} COMPILE_OPTIONS)
  if(NOT limits)
    set(limits)
  endif()
  set(object ${CMAKE_CURRENT_BINARY_DIR}/handle_budgets/${table}.o)
  list(APPEND jobs ${table} ${object} ${CMAKE_CXX_COMPILER} ${flags} ${CMAKE_CXX20_STANDARD_COMPILE_OPTION} -fPIC
    ${limits} -I${PROJECT_SOURCE_DIR}/include -I${PROJECT_SOURCE_DIR}/src -c ${PROJECT_SOURCE_DIR}/${path} -o ${object} --)
endforeach()

add_custom_target(handle_budgets
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/handle_budgets
  COMMAND handle_budgets_runner ${TOPOADAPT_SIZE} 60 2048 512 ${jobs}
  COMMAND_EXPAND_LISTS VERBATIM USES_TERMINAL)
