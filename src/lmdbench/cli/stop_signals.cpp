// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/commands.h>

#include <array>
#include <csignal>

namespace lmdbench {
namespace {

/// The received signal; 0 for none.
volatile std::sig_atomic_t received_signal = 0;

void remember(int signal) {
  received_signal = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void heed_stop_signals() {
  for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
    const auto before = std::signal(signal, remember);
    if (signal == SIGHUP && before == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

bool stop_requested() {
  return received_signal != 0;
}

void end_by_the_signal() {
  const int signal = received_signal;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace lmdbench
