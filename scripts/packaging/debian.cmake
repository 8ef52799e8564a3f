# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Debian packages by CPack: lmdbench, liblmdbench-dev and, where it is built, python3-lmdbench. scripts/package.sh makes and
# checks them.
set(LMDBENCH_PACKAGE_RELEASE 1 CACHE STRING "Revision of the Debian packages")
find_program(GZIP_PROGRAM gzip REQUIRED)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lmdbench)
set(CPACK_PACKAGE_CONTACT "The lmdbench authors <lmdbench@users.noreply.github.com>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL Runtime Development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${LMDBENCH_PACKAGE_RELEASE})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "local minimum distance pairs of two triangle meshes")
set(about "Finds every place where two triangle meshes come nearest to each other (local
minimum distance pairs, LMDs), for multi-contact haptic rendering, virtual
assembly and robotics.
")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME lmdbench)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS
    "libjs-dygraphs, libjs-three, python3, python3-h5py, python3-jinja2, python3-markdown, python3-matplotlib, python3-numpy, python3-pil")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "${about}
This package holds the program lmdbench: it runs experiments with several
algorithms side by side and reports the error beside the run time.")

# Static: what its objects call is searched for by its users (src/lmdbench/library/lmdbenchConfig.cmake.in).
set(needed libeigen3-dev libfmt-dev libhwy-dev libmeshoptimizer-dev libssl-dev)
# libassimp-dev's files for CMake name zlib1g-dev, the package does not.
foreach(part "ASSIMP libassimp-dev zlib1g-dev" "FCL libfcl-dev" "TBB libtbb-dev")
  separate_arguments(part)
  list(POP_FRONT part option)
  if(LMDBENCH_WITH_${option})
    list(APPEND needed ${part})
  endif()
endforeach()
list(JOIN needed ", " needed)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblmdbench-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${needed}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${about}
This package holds the C++20 library with its headers, for CMake and
pkg-config.")

if(LMDBENCH_WITH_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL Python)
  set(Python_EXECUTABLE "${LMDBENCH_PYTHON}")
  find_package(Python REQUIRED COMPONENTS Interpreter)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-lmdbench)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-h5py, python3-pandas")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS lmdbench)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/prerm")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${about}
This package holds the Python module: meshes and poses as numpy arrays, LMD
sets as structured arrays, results of lmdbench as pandas frames.")
endif()

# What Debian wants in every package; gzip without name and time, so that the same sources give the same bits.
set(folder "${PROJECT_BINARY_DIR}/debian")
file(MAKE_DIRECTORY "${folder}")
configure_file("${CMAKE_CURRENT_LIST_DIR}/changelog.Debian.in" "${folder}/changelog.Debian" @ONLY)
configure_file("${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${folder}/changelog" COPYONLY)
foreach(file changelog.Debian changelog)
  execute_process(COMMAND "${GZIP_PROGRAM}" -9nf "${folder}/${file}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(package "${CPACK_DEBIAN_${upper}_PACKAGE_NAME}")
  install(FILES "${CMAKE_CURRENT_LIST_DIR}/copyright" "${folder}/changelog.Debian.gz" "${folder}/changelog.gz"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" COMPONENT ${component})
  configure_file("${CMAKE_CURRENT_LIST_DIR}/lintian-overrides.in" "${folder}/overrides/${package}" @ONLY)
  install(FILES "${folder}/overrides/${package}" DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides" COMPONENT ${component})
endforeach()
include(CPack)
