// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace lmdbench::testing {

/// Calls inside servo ticks, in all threads, since the last `reset`.
struct CountedCalls {
  std::int64_t allocations = 0;  ///< operator new
  std::int64_t locks = 0;        ///< pthread_mutex_lock; 0 under the thread sanitizer
};
CountedCalls counted_calls();
void reset_counted_calls();

}  // namespace lmdbench::testing
