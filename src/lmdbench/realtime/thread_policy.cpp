// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/thread_policy.h>

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>

namespace lmdbench {
namespace {

std::string error_text(int error) {
  return std::generic_category().message(error);
}

std::string limit_text(int resource) {
  rlimit limit{};
  if (::getrlimit(static_cast<decltype(RLIMIT_RTPRIO)>(resource), &limit) != 0) return "unknown";
  return limit.rlim_cur == RLIM_INFINITY ? "unlimited" : std::to_string(limit.rlim_cur);
}

Grant grant(const std::string& thread, std::string asked, int error, const std::string& remedy) {
  return {thread, std::move(asked), error == 0, error == 0 ? "" : error_text(error) + " (" + remedy + ")"};
}

cpu_set_t set_of(const std::vector<int>& cores) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int core : cores) CPU_SET(static_cast<std::size_t>(core), &set);
  return set;
}

}  // namespace

std::vector<Grant> apply(const ThreadPolicy& policy, const std::string& thread) {
  std::vector<Grant> grants;
  if (policy.core) {
    const cpu_set_t set = set_of({*policy.core});
    grants.push_back(grant(thread, fmt::format("core {}", *policy.core),
                           ::pthread_setaffinity_np(::pthread_self(), sizeof(set), &set),
                           "taskset or the control group keeps the process off that core"));
  }
  if (policy.priority > 0) {
    sched_param parameters{};
    parameters.sched_priority = policy.priority;
    const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters);
    grants.push_back(
        grant(thread, fmt::format("SCHED_FIFO {}", policy.priority), error,
              fmt::format(
                  "it takes root, CAP_SYS_NICE or ulimit -r of at least {}, which is {}; in a container also "
                  "--cap-add=SYS_NICE or --ulimit rtprio",
                  policy.priority, limit_text(RLIMIT_RTPRIO))));
  }
  return grants;
}

std::vector<int> usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (::sched_getaffinity(0, sizeof(set), &set) == 0)
    for (int core = 0; core < CPU_SETSIZE; ++core)
      if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  if (cores.empty()) cores.push_back(0);
  return cores;
}

LockedMemory::LockedMemory(bool asked) {
  if (!asked) return;
  const int error = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? 0 : errno;
  locked_ = error == 0;
  grants_.push_back(
      grant("process", "locked memory", error,
            fmt::format(
                "it takes root, CAP_IPC_LOCK or ulimit -l unlimited, which is {} bytes; in a container also "
                "--ulimit memlock=-1",
                limit_text(RLIMIT_MEMLOCK))));
}

LockedMemory::~LockedMemory() {
  if (locked_) ::munlockall();
}

void touch_stack() {
  constexpr std::size_t BYTES = std::size_t{256} << 10U;
  constexpr std::size_t PAGE = 4096;
  std::array<char, BYTES> stack;
  volatile char* const bytes = stack.data();
  for (std::size_t i = 0; i < BYTES; i += PAGE) bytes[i] = 0;
}

}  // namespace lmdbench
