// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/child_process.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/sanitizers.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>
#include <string>
#include <system_error>
#include <utility>

namespace lmdbench {
namespace {

/// A limit would refuse what sanitizers reserve.
constexpr bool LIMITS_ADDRESS_SPACE = !IS_SANITIZED;

/// Exit statuses of the child beside 0.
constexpr int OUT_OF_MEMORY = 41;
constexpr int THREW = 42;
constexpr int NOBODY_READS = 43;

/// A child with little processor time after this multiple of its limit waits for something.
constexpr int WALL_CLOCK_FACTOR = 20;

/// Address space of this process [bytes]; 0 where the system does not tell.
rlim_t address_space() {
  std::FILE* file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return 0;
  unsigned long pages = 0;
  const bool read = std::fscanf(file, "%lu", &pages) == 1;
  std::fclose(file);
  return read ? rlim_t{pages} * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

/// Lowers a limit; never raises it above what this process has itself.
void lower_limit(__rlimit_resource resource, rlim_t value) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_max = std::min(limit.rlim_max, value);
  limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
  static_cast<void>(::setrlimit(resource, &limit));
}

void send_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::write(descriptor, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) ::_exit(NOBODY_READS);
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

/// The child's life. Ends without flushing what the parent had buffered.
[[noreturn]] void be_child(const std::function<void(const ChildProcess::Send&)>& work,
                           const ChildLimits& limits, rlim_t parent_space, int descriptor) {
  static_cast<void>(::prctl(PR_SET_PDEATHSIG, SIGKILL));
  // Ctrl-C goes to it as well: whether its work still counts, the parent says, with whom it ends.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_IGN);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (nowhere >= 0) static_cast<void>(::dup2(nowhere, standard));
  lower_limit(RLIMIT_CORE, 0);
  lower_limit(RLIMIT_CPU, static_cast<rlim_t>(limits.processor_seconds));
  if (LIMITS_ADDRESS_SPACE && parent_space > 0)
    lower_limit(RLIMIT_AS, parent_space + static_cast<rlim_t>(limits.memory_bytes));
  try {
    work([descriptor](std::span<const std::byte> bytes) { send_all(descriptor, bytes); });
  } catch (const std::bad_alloc&) {
    ::_exit(OUT_OF_MEMORY);
  } catch (...) {
    ::_exit(THREW);
  }
  ::_exit(0);
}

}  // namespace

ChildProcess::ChildProcess(const std::function<void(const Send&)>& work, const ChildLimits& limits)
    : limits_(limits) {
  const auto fail = [](int error) {
    throw EnvironmentError("", "",
                           "no helper process can be started: " + std::generic_category().message(error),
                           "check the limits on processes, files and memory (ulimit -a)");
  };
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail(errno);
  pipe_ = FileDescriptor(ends[0]);
  FileDescriptor child_end(ends[1]);
  const rlim_t parent_space = address_space();
  child_ = ::fork();
  if (child_ < 0) fail(errno);
  if (child_ == 0) be_child(work, limits_, parent_space, child_end.get());
}

ChildProcess::~ChildProcess() {
  if (child_ < 0) return;
  ::kill(child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool ChildProcess::receive(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    pollfd waiting{pipe_.get(), POLLIN, 0};
    const std::int64_t milliseconds =
        std::min<std::int64_t>(limits_.processor_seconds * 1000 * WALL_CLOCK_FACTOR, 1'000'000'000);
    const int ready = ::poll(&waiting, 1, static_cast<int>(milliseconds));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) {
      timed_out_ = ready == 0;
      return false;
    }
    const ssize_t count = ::read(pipe_.get(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

std::string ChildProcess::end_in_words() {
  if (timed_out_) return "gave no answer";  // it is still there: the destructor ends it
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  // The limit's signal may come as SIGKILL where soft and hard limit are the same second.
  const bool out_of_time =
      WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  if (out_of_time) return fmt::format("used up its {} s of processor time", limits_.processor_seconds);
  if (WIFSIGNALED(status)) return fmt::format("crashed (signal {})", WTERMSIG(status));
  if (WEXITSTATUS(status) == OUT_OF_MEMORY)
    return fmt::format("needs more than {} bytes of memory", limits_.memory_bytes);
  return fmt::format("ended with status {}", WEXITSTATUS(status));
}

}  // namespace lmdbench
