# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Component Runtime beside the program and its manual: what an experiment, a figure and a report are made with, in the tree's
# own arrangement, since experiments name meshes and paths by relative names.
include(GNUInstallDirs)
set(data "${CMAKE_INSTALL_DATADIR}/lmdbench")
install(DIRECTORY experiments DESTINATION "${data}" COMPONENT Runtime
        FILES_MATCHING PATTERN "*.json" PATTERN "*.tum" PATTERN "*.off" PATTERN "*.xyz" PATTERN "README.md"
        PATTERN benchmarks EXCLUDE PATTERN judge EXCLUDE PATTERN study EXCLUDE PATTERN support EXCLUDE)
install(DIRECTORY meshes paths DESTINATION "${data}" COMPONENT Runtime # without meshes that are built
        FILES_MATCHING PATTERN "*.json" PATTERN "*.tum" PATTERN "README.md" PATTERN sources EXCLUDE)
install(DIRECTORY scripts/figures scripts/report DESTINATION "${data}/scripts" COMPONENT Runtime
        PATTERN tests EXCLUDE PATTERN __pycache__ EXCLUDE)
install(FILES results/README.md RENAME result-format.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT Runtime)
install(FILES README.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT Runtime)
if(LMDBENCH_WITH_PYTHON)
  install(FILES src/lmdbench/python/examples.py DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/python3-lmdbench/examples"
          COMPONENT Python)
endif()

include(scripts/packaging/debian.cmake)
