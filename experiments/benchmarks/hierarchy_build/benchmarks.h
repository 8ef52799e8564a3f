// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmarks/hierarchy_build/implementation.h>

#include <vector>

namespace lmdbench::experiments {

/// hierarchy_build/<implementation>/<mesh>: items are triangles. Wall clock counts, because some
/// builders use all cores; processor time of all threads stands beside it. Each build first answers
/// some distances. Missing meshes are left out.
void add_build_benchmarks(const std::vector<BuildImplementation>& implementations);

}  // namespace lmdbench::experiments
