// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <micro/hierarchy_build/implementation.h>

#include <vector>

namespace lmdbench::micro {

/// The main function of a program that times builds: names are hierarchy_build/<implementation>/<mesh>, items
/// are triangles. Wall time is what counts, because some builders use all cores; processor time of all
/// threads stands beside it. Each is asked some distances first. Meshes that are not there are left out.
int run_build_benchmarks(int argc, char** argv, const std::vector<BuildImplementation>& implementations);

}  // namespace lmdbench::micro
