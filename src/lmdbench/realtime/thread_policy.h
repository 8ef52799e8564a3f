// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

/// A thread's requests to the system, so that it wakes in time. Each is granted, or refused with a
/// reason; a refusal is noted and does not end the run.
namespace lmdbench {

/// A thread's requests.
struct ThreadPolicy {
  std::optional<int> core;  ///< The only one to run on; unset: any.
  int priority = 0;         ///< Of SCHED_FIFO, 1 to 99; 0: the normal policy.
};

/// A request and its result.
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

/// Keeps the process's memory from being paged out, with pages present at once, while it lives.
class LockedMemory {
 public:
  /// @param asked whether to ask the system
  explicit LockedMemory(bool asked);
  ~LockedMemory();
  LockedMemory(const LockedMemory&) = delete;
  LockedMemory& operator=(const LockedMemory&) = delete;

  const std::vector<Grant>& grants() const { return grants_; }

 private:
  bool locked_ = false;
  std::vector<Grant> grants_;
};

/// Touches enough of the calling thread's stack that no tick faults it in.
void touch_stack();

}  // namespace lmdbench
