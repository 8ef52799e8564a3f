// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/method_summary.h>

#include <array>

namespace lmdbench {
namespace {

constexpr std::array NUMBERS = {
#define NUMBER(name, units, ...) SummaryNumber{#name, units, &MethodSummary::name, __VA_ARGS__},
#include <lmdbench/metrics/method_summary.def>
#undef NUMBER
};

}  // namespace

std::span<const SummaryNumber> summary_numbers() {
  return NUMBERS;
}

}  // namespace lmdbench
