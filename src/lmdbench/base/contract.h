// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Contracts: what a function and its callers owe each other, said where it is relied on. A contract that does not hold is a bug of
/// ours, whatever the input was: the program prints the condition, its place and the likely cause, and aborts. What a user's file or
/// command may get wrong is no contract; it throws (error.h).
///
/// LMDBENCH_EXPECTS  before, LMDBENCH_ENSURES after: in builds that look for defects (option LMDBENCH_CONTRACTS: presets develop,
///                   debug, asan-ubsan, tsan, fuzz, coverage). Elsewhere the condition is compiled and never evaluated. May cost what
///                   the function itself costs.
/// LMDBENCH_ALWAYS   in every build, where going on would write outside memory or report a wrong number. Must cost next to nothing.
namespace lmdbench {

/// Prints "contract broken: CONDITION (FILE:LINE): CAUSE" and aborts. The file without its folder: an installed library names no folder of
/// the machine that built it.
[[noreturn]] void contract_broken(const char* condition, const char* file, int line,
                                  const char* likely_cause) noexcept;

}  // namespace lmdbench

#define LMDBENCH_ALWAYS(condition, likely_cause) \
  ((condition) ? static_cast<void>(0)            \
               : ::lmdbench::contract_broken(#condition, __FILE_NAME__, __LINE__, likely_cause))

#ifdef LMDBENCH_CONTRACTS
#define LMDBENCH_EXPECTS(condition, likely_cause) LMDBENCH_ALWAYS(condition, likely_cause)
#else
#define LMDBENCH_EXPECTS(condition, likely_cause) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif
#define LMDBENCH_ENSURES(condition, likely_cause) LMDBENCH_EXPECTS(condition, likely_cause)
