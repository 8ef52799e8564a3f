// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What a thread asks of the system so that it wakes in time. Asked for, granted or refused with the reason; a refusal is a fact of
/// the run, not its end.
namespace lmdbench {

/// A thread's wishes.
struct ThreadPolicy {
  std::optional<int> core;  ///< The only one that it may run on; unset: any.
  int priority = 0;         ///< Of SCHED_FIFO, 1 to 99; 0: the normal policy.
};

/// One wish and what became of it.
struct Grant {
  std::string thread;  ///< Role of the thread, or "process".
  std::string asked;   ///< "core 1", "SCHED_FIFO 80", "locked memory"
  bool granted = false;
  std::string reason;  ///< Why it was refused; empty where granted.
};

/// Applies the policy to the calling thread.
std::vector<Grant> apply(const ThreadPolicy& policy, const std::string& thread);

/// Cores that the calling thread may use, ascending; at least one.
std::vector<int> usable_cores();

/// Memory of the process that cannot be paged out, and pages that are there when they are asked for, for as long as it lives.
class LockedMemory {
 public:
  /// @param asked  whether to ask at all
  explicit LockedMemory(bool asked);
  ~LockedMemory();
  LockedMemory(const LockedMemory&) = delete;
  LockedMemory& operator=(const LockedMemory&) = delete;

  const std::vector<Grant>& grants() const { return grants_; }

 private:
  bool locked_ = false;
  std::vector<Grant> grants_;
};

/// Touches so much of the calling thread's stack that no tick is the first to.
void touch_stack();

}  // namespace lmdbench
