// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace lmdbench {

/// Threads ready for many short jobs that cost less than starting threads anew or using a pool that
/// the whole process shares.
class WorkerTeam {
 public:
  /// @param members  of the team, the calling thread included
  explicit WorkerTeam(std::size_t members);
  ~WorkerTeam();
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;

  std::size_t size() const { return threads_.size() + 1; }

  /// Calls job(member) once in each member's thread, 0 in the caller's; returns when all are done.
  /// @param job  must not throw
  void run(const std::function<void(std::size_t member)>& job);

 private:
  void work(std::size_t member);

  std::vector<std::thread> threads_;
  const std::function<void(std::size_t)>* job_ = nullptr;
  std::atomic<std::uint64_t> begun_{0};  ///< Jobs so far.
  std::atomic<std::size_t> busy_{0};
  std::atomic<bool> over_{false};
};

}  // namespace lmdbench
