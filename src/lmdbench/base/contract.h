// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Contracts between a function and its callers, written where they are relied on. A broken one is
/// a bug of ours, whatever the input: the program prints condition, place and likely cause, and
/// aborts. A mistake in a user's file or command breaks no contract; it throws (error.h).
///
/// LMDBENCH_EXPECTS (before) and LMDBENCH_ENSURES (after): evaluated with option LMDBENCH_CONTRACTS
/// (presets develop, debug, asan-ubsan, tsan, fuzz, coverage), elsewhere only compiled. May cost as
/// much as the function itself.
/// LMDBENCH_ALWAYS: in every build, against writes outside memory and wrong numbers; almost free.
namespace lmdbench {

/// Prints "contract broken: CONDITION (FILE:LINE): CAUSE" and aborts. FILE has no folder: an
/// installed library names no folder of the machine that built it.
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
