// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace lmdbench {

/// A bar with rate and estimated time left, on standard error; silent when that is no terminal.
class ProgressBar {
 public:
  /// @param enabled false switches the bar off whatever standard error is
  explicit ProgressBar(bool enabled);
  ~ProgressBar();  ///< Wipes the bar.
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws at most ten times a second. A new phase starts a new clock.
  void update(const std::string& phase, std::int64_t done, std::int64_t total);
  void wipe();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool drawn_ = false;
  std::string phase_;
  Clock::time_point phase_begin_;
  Clock::time_point last_draw_;
};

/// "run [#####-----]  50 % 1200/s ETA 0:42": the bar's text, for `elapsed` seconds in this phase.
std::string progress_line(const std::string& phase, std::int64_t done, std::int64_t total, double elapsed);

}  // namespace lmdbench
