// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/result/sized_datasets.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lmdbench {
namespace {

template <typename T>
std::vector<T> of_size(std::vector<T> values, const ResultReader& result, const std::string& dataset,
                       std::size_t size) {
  if (values.size() != size)
    throw InputError(result.file().string(), dataset,
                     fmt::format("holds {} values where other datasets ask for {}", values.size(), size),
                     "run the experiment again");
  return values;
}

}  // namespace

std::vector<double> reals_of_size(const ResultReader& result, const std::string& dataset, std::size_t size) {
  return of_size(result.reals(dataset), result, dataset, size);
}

std::vector<double> finite_reals_of_size(const ResultReader& result, const std::string& dataset,
                                         std::size_t size) {
  std::vector<double> values = reals_of_size(result, dataset, size);
  const auto bad = std::ranges::find_if_not(values, [](double value) { return std::isfinite(value); });
  if (bad != values.end())
    throw InputError(result.file().string(), dataset,
                     fmt::format("value {} is {}, which no figure can show", bad - values.begin(), *bad),
                     "run the experiment again");
  return values;
}

std::vector<std::int64_t> integers_of_size(const ResultReader& result, const std::string& dataset,
                                           std::size_t size) {
  return of_size(result.integers(dataset), result, dataset, size);
}

std::vector<std::string> texts_of_size(const ResultReader& result, const std::string& dataset,
                                       std::size_t size) {
  return of_size(result.texts(dataset), result, dataset, size);
}

std::vector<std::size_t> list_offsets(const ResultReader& result, const std::string& dataset,
                                      std::size_t lists) {
  const std::vector<std::int64_t> offsets = integers_of_size(result, dataset, lists + 1);
  if (offsets.front() != 0 || !std::ranges::is_sorted(offsets))
    throw InputError(result.file().string(), dataset, "is no ascending row of begins from 0",
                     "run the experiment again");
  return {offsets.begin(), offsets.end()};
}

}  // namespace lmdbench
