// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_reader.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Datasets whose size other ones give. A result by another writer, or one that was edited, may
/// hold more or fewer values; all functions throw InputError then, as ResultReader does.
namespace lmdbench {

/// @param size values, not rows: 3 for one point
std::vector<double> reals_of_size(const ResultReader& result, const std::string& dataset, std::size_t size);
/// None of them NaN or infinite, as a file to look at needs them.
std::vector<double> finite_reals_of_size(const ResultReader& result, const std::string& dataset,
                                         std::size_t size);
std::vector<std::int64_t> integers_of_size(const ResultReader& result, const std::string& dataset,
                                           std::size_t size);
std::vector<std::string> texts_of_size(const ResultReader& result, const std::string& dataset,
                                       std::size_t size);

/// Where each of some lists begins that lie one after another, and where the last one ends.
/// @return lists + 1 rows, the first 0, none below the one before
std::vector<std::size_t> list_offsets(const ResultReader& result, const std::string& dataset,
                                      std::size_t lists);

}  // namespace lmdbench
