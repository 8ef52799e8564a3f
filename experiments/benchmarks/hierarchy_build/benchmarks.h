// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmarks/hierarchy_build/implementation.h>

#include <vector>

namespace lmdbench::experiments {

/// The benchmarks of `add_hierarchy_builds` (tasks.h) for these implementations.
void add_build_benchmarks(const std::vector<BuildImplementation>& implementations);

}  // namespace lmdbench::experiments
