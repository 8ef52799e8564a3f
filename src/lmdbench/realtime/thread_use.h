// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

/// A thread's use of the machine.
namespace lmdbench {

/// Counts of the calling thread since it began.
struct ThreadUse {
  std::int64_t processor_ns = 0;          ///< CLOCK_THREAD_CPUTIME_ID
  std::int64_t minor_faults = 0;          ///< Pages that were mapped without a read from disk.
  std::int64_t major_faults = 0;          ///< Pages that were read from disk.
  std::int64_t involuntary_switches = 0;  ///< Times that it lost the processor.

  static ThreadUse now();
  ThreadUse operator-(const ThreadUse& earlier) const;
};

/// Time that the hypervisor gave to others while these cores had work, since boot [s]; NaN if
/// unknown. Its resolution is the system's tick, 10 ms.
double stolen_seconds(const std::vector<int>& cores);

}  // namespace lmdbench
