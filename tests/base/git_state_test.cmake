# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs git_state.cmake on small repositories. Arguments: -D SCRIPT=... -D WORK_DIR=... -P git_state_test.cmake
find_program(GIT_PROGRAM git)
if(NOT GIT_PROGRAM)
  message(STATUS "skipped: no git here")
  return()
endif()
file(REMOVE_RECURSE "${WORK_DIR}")
set(repository "${WORK_DIR}/repository")
set(header "${WORK_DIR}/state.h")

function(git)
  execute_process(COMMAND "${GIT_PROGRAM}" -c user.name=test -c user.email=test@example.org ${ARGN}
                  WORKING_DIRECTORY "${repository}" RESULT_VARIABLE failed OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(failed)
    message(FATAL_ERROR "git ${ARGN}: ${out}${err}")
  endif()
  set(git_output "${out}" PARENT_SCOPE)
endfunction()

function(expect_state source commit dirty)
  execute_process(COMMAND "${CMAKE_COMMAND}" -D "SOURCE_DIR=${source}" -D "OUTPUT=${header}" -P "${SCRIPT}"
                  RESULT_VARIABLE failed OUTPUT_VARIABLE out ERROR_VARIABLE err)
  file(READ "${header}" text)
  if(failed OR NOT text MATCHES "GIT_COMMIT \"${commit}\"" OR NOT text MATCHES "GIT_DIRTY \"${dirty}\"")
    message(FATAL_ERROR "expected commit ${commit}, dirty ${dirty} of ${source}; got ${out}${err}\n${text}")
  endif()
endfunction()

file(WRITE "${repository}/src/a.cpp" "int a;\n")
# A directory above the scratch one may be a repository: that one's commit is not the answer either.
expect_state("${repository}" unknown unknown)
git(init -q)
git(add src)
git(commit -q -m "first")
git(rev-parse HEAD)
string(STRIP "${git_output}" commit)
expect_state("${repository}" "${commit}" no)

file(TIMESTAMP "${header}" before "%Y-%m-%dT%H:%M:%S" UTC)
execute_process(COMMAND "${CMAKE_COMMAND}" -E sleep 1.1)
expect_state("${repository}" "${commit}" no)
file(TIMESTAMP "${header}" after "%Y-%m-%dT%H:%M:%S" UTC)
if(NOT before STREQUAL after)
  message(FATAL_ERROR "the header was written again although nothing changed")
endif()

file(WRITE "${repository}/results.txt" "a file beside the sources does not make them dirty\n")
expect_state("${repository}" "${commit}" no)
file(WRITE "${repository}/src/b.cpp" "int b;\n")
expect_state("${repository}" "${commit}" yes)
file(REMOVE "${repository}/src/b.cpp")
file(WRITE "${repository}/src/a.cpp" "int changed;\n")
expect_state("${repository}" "${commit}" yes)
git(commit -q -a -m "second")
git(rev-parse HEAD)
string(STRIP "${git_output}" second)
expect_state("${repository}" "${second}" no)

# An exported copy inside another repository.
file(WRITE "${repository}/exported/src/a.cpp" "int a;\n")
expect_state("${repository}/exported" unknown unknown)
file(REMOVE_RECURSE "${WORK_DIR}")
