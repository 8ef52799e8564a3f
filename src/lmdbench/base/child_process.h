// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/file_descriptor.h>

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace lmdbench {

/// What a child process may use.
struct ChildLimits {
  std::int64_t processor_seconds = 0;
  std::int64_t memory_bytes = 0;  ///< Beyond what this process has when the child starts.
};

/// Work in a forked copy of this process, for code that may loop, crash or eat memory on hostile
/// input: the harm stays in the copy. It has one thread, no standard output or error, and ends with
/// its parent. It may allocate memory, but use nothing else that was perhaps locked at the fork.
class ChildProcess {
 public:
  /// Sends bytes to the parent; ends the child when nobody reads any more.
  using Send = std::function<void(std::span<const std::byte>)>;

  /// @throws EnvironmentError when the system allows no further process
  ChildProcess(const std::function<void(const Send&)>& work, const ChildLimits& limits);
  ~ChildProcess();  ///< Ends the child where it still runs.
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Fills the span with what the child sends next. False when the child ended before, or when it
  /// needs far longer than its processor time explains (it waits for something).
  bool receive(std::span<std::byte> bytes);

  /// Why a child that sent too little ended: "crashed (signal 11)", "used up its 60 s of processor
  /// time". Waits for its end.
  std::string end_in_words();

 private:
  ChildLimits limits_;
  pid_t child_ = -1;
  FileDescriptor pipe_;
  bool timed_out_ = false;
};

}  // namespace lmdbench
