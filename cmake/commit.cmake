# SPDX-License-Identifier: MIT
# The commit of the sources: of git where the folder is a work tree, else as `git archive` has written it.

# What git archive puts in the place of the format (.gitattributes); 12 digits of the commit.
set(commit_of_archive "$Format:%H$")

# find_commit(SOURCE COMMIT HEADS): 12 digits, with "-dirty" where files differ; empty where nothing is known. HEADS
# receives files that change with the commit.
function(find_commit source commit heads)
  set(found "")
  set(files "")
  find_program(TOPOADAPT_GIT git)
  if(EXISTS ${source}/.git AND TOPOADAPT_GIT)
    execute_process(COMMAND ${TOPOADAPT_GIT} -C ${source} describe --always --dirty --abbrev=12 --exclude=*
      OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    execute_process(COMMAND ${TOPOADAPT_GIT} -C ${source} rev-parse --path-format=absolute --git-path logs/HEAD
      OUTPUT_VARIABLE files OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT EXISTS "${files}")
      set(files "")
    endif()
  elseif(commit_of_archive MATCHES "^([0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f])")
    set(found ${CMAKE_MATCH_1})
  endif()
  set(${commit} "${found}" PARENT_SCOPE)
  set(${heads} "${files}" PARENT_SCOPE)
endfunction()
