// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/worker_team.h>

namespace lmdbench {

WorkerTeam::WorkerTeam(std::size_t members) {
  for (std::size_t member = 1; member < members; ++member)
    threads_.emplace_back([this, member] { work(member); });
}

WorkerTeam::~WorkerTeam() {
  over_ = true;
  ++begun_;
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerTeam::run(const std::function<void(std::size_t)>& job) {
  job_ = &job;
  busy_ = threads_.size();
  ++begun_;
  begun_.notify_all();
  job(0);
  for (std::size_t busy = busy_; busy > 0; busy = busy_) busy_.wait(busy);
}

void WorkerTeam::work(std::size_t member) {
  for (std::uint64_t seen = 0;;) {
    begun_.wait(seen);
    ++seen;
    if (over_) return;
    (*job_)(member);
    if (--busy_ == 0) busy_.notify_one();
  }
}

}  // namespace lmdbench
