// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <micro/global_search/implementation.h>

#include <vector>

namespace lmdbench::micro {

/// The main function of a program that times global searches: names are
/// global_search/<implementation>/<cutoff>. Two bunnies at unrelated poses 0.2 % of the diagonal apart;
/// each implementation is checked against ground truth first and skipped with the reason when it breaks
/// its promise.
int run_search_benchmarks(int argc, char** argv, const std::vector<SearchImplementation>& implementations);

}  // namespace lmdbench::micro
