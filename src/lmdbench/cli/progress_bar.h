// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace lmdbench {

/// Progress of a long command on standard error: a bar on a terminal, else a line now and then.
class ProgressBar {
 public:
  /// From then on a write to a pipe that nobody reads fails, as to a full disk.
  /// @param enabled false switches it off in any case
  /// @param silence least time between lines without a terminal, and before the first of them
  explicit ProgressBar(bool enabled, std::chrono::milliseconds silence = std::chrono::seconds(10));
  ~ProgressBar();  ///< Wipes the bar.
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws at most ten times a second. A new phase starts a new clock, but not a new line.
  /// @param total negative if unknown: only the phase is shown
  void update(const std::string& phase, std::int64_t done, std::int64_t total);
  /// As a run's progress (`std::ref`): the same, and true unless `stop_requested`.
  bool operator()(const std::string& phase, std::int64_t done, std::int64_t total);
  void wipe();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool on_terminal_;
  std::chrono::milliseconds silence_;
  bool drawn_ = false;
  std::string phase_;
  Clock::time_point phase_begin_;
  Clock::time_point last_draw_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_line_ = begin_;
};

/// The bar for `elapsed` seconds: "run [#####-----]  50 % 1200/s ETA 0:42"; total < 0: the phase.
std::string progress_line(const std::string& phase, std::int64_t done, std::int64_t total, double elapsed);

/// "run: 50 %, 42 s left": the same for a log.
std::string progress_note(const std::string& phase, std::int64_t done, std::int64_t total, double elapsed);

}  // namespace lmdbench
