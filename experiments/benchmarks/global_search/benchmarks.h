// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmarks/global_search/implementation.h>

#include <vector>

namespace lmdbench::experiments {

/// The benchmarks of `add_global_searches` (tasks.h) for these implementations.
void add_search_benchmarks(const std::vector<SearchImplementation>& implementations);

}  // namespace lmdbench::experiments
