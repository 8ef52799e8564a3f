// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmarks/global_search/implementation.h>

#include <vector>

namespace lmdbench::experiments {

/// global_search/<implementation>/<cutoff>: two bunnies at unrelated poses 0.2 % of the diagonal
/// apart. Implementations are first checked against the truth, and skipped if they break a promise.
void add_search_benchmarks(const std::vector<SearchImplementation>& implementations);

}  // namespace lmdbench::experiments
