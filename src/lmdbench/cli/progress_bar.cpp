// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/progress_bar.h>

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>

namespace lmdbench {
namespace {

/// Work goes on where standard error is closed, a full disk or a terminal that is gone: fmt::print
/// would throw.
void tell(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

std::string progress_line(const std::string& phase, std::int64_t done, std::int64_t total, double elapsed) {
  constexpr int WIDTH = 30;
  if (total < 0) return phase;
  done = std::clamp(done, std::int64_t{0}, total);
  const double share = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
  const int filled = static_cast<int>(share * WIDTH);
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(WIDTH - filled), '-');
  if (!(elapsed > 0.0) || done == 0) return fmt::format("{:<5} [{}] {:3.0f} %", phase, bar, 100.0 * share);
  const double rate = static_cast<double>(done) / elapsed;
  const auto left = static_cast<std::int64_t>(std::ceil(static_cast<double>(total - done) / rate));
  return fmt::format("{:<5} [{}] {:3.0f} % {:.3g}/s ETA {}:{:02}", phase, bar, 100.0 * share, rate, left / 60,
                     left % 60);
}

std::string progress_note(const std::string& phase, std::int64_t done, std::int64_t total, double elapsed) {
  if (total <= 0) return phase;
  done = std::clamp(done, std::int64_t{0}, total);
  std::string text =
      fmt::format("{}: {:.0f} %", phase, 100.0 * static_cast<double>(done) / static_cast<double>(total));
  if (elapsed > 0.0 && done > 0)
    text += fmt::format(", {:.0f} s left",
                        std::ceil(elapsed * static_cast<double>(total - done) / static_cast<double>(done)));
  return text;
}

ProgressBar::ProgressBar(bool enabled, std::chrono::milliseconds silence)
    : enabled_(enabled), on_terminal_(isatty(STDERR_FILENO) == 1), silence_(silence) {
  // Nor does the end of who reads the log end long work.
  std::signal(SIGPIPE, SIG_IGN);
}

ProgressBar::~ProgressBar() {
  wipe();
}

void ProgressBar::update(const std::string& phase, std::int64_t done, std::int64_t total) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (phase != phase_) {
    phase_ = phase;
    phase_begin_ = now;
    last_draw_ = {};
  }
  const double elapsed = std::chrono::duration<double>(now - phase_begin_).count();
  if (!on_terminal_) {
    if (now - last_line_ < silence_) return;
    last_line_ = now;
    tell(fmt::format("lmdbench: info: {} ({:.0f} s so far)\n", progress_note(phase, done, total, elapsed),
                     std::chrono::duration<double>(now - begin_).count()));
    return;
  }
  if (now - last_draw_ < std::chrono::milliseconds(100) && (done < total || total < 0)) return;
  last_draw_ = now;
  tell(fmt::format("\r{}\x1b[K", progress_line(phase, done, total, elapsed)));
  drawn_ = true;
}

bool ProgressBar::operator()(const std::string& phase, std::int64_t done, std::int64_t total) {
  update(phase, done, total);
  return !stop_requested();
}

void ProgressBar::wipe() {
  if (!drawn_) return;
  tell("\r\x1b[K");
  drawn_ = false;
}

}  // namespace lmdbench
