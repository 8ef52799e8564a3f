# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs at every build: writes the commit and whether the sources differ from it into a header, which
# it touches only on a change, to recompile nothing in vain. Outside a working copy: "unknown".
# Arguments: -D SOURCE_DIR=... -D OUTPUT=... -P git_state.cmake
cmake_minimum_required(VERSION 3.25)
set(commit "unknown")
set(dirty "unknown")
find_program(GIT_PROGRAM git)
if(GIT_PROGRAM)
  # No optional locks: a build must not get in the way of git commands that run at the same time.
  set(git "${GIT_PROGRAM}" --no-optional-locks -C "${SOURCE_DIR}")
  execute_process(COMMAND ${git} rev-parse --show-prefix HEAD
                  RESULT_VARIABLE failed OUTPUT_VARIABLE answer ERROR_QUIET)
  # An exported copy inside another repository has a prefix: that repository's commit is not ours.
  if(NOT failed AND answer MATCHES "^\n([0-9a-f]+)\n$")
    set(commit "${CMAKE_MATCH_1}")
    execute_process(COMMAND ${git} status --porcelain --untracked-files=no -- . ":!results"
                    RESULT_VARIABLE tracked_failed OUTPUT_VARIABLE tracked ERROR_QUIET)
    execute_process(COMMAND ${git} status --porcelain --untracked-files=normal -- src
                    RESULT_VARIABLE untracked_failed OUTPUT_VARIABLE untracked ERROR_QUIET)
    if(NOT tracked_failed AND NOT untracked_failed)
      if("${tracked}${untracked}" STREQUAL "")
        set(dirty "no")
      else()
        set(dirty "yes")
      endif()
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT
"// Made by git_state.cmake at build time; do not edit.
#pragma once

#define LMDBENCH_GIT_COMMIT \"@commit@\"
#define LMDBENCH_GIT_DIRTY \"@dirty@\"
")
