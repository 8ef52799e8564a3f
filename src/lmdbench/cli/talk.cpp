// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/talk.h>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <memory>

namespace lmdbench {

void set_up_talk(int verbosity) {
  const char* no_color = std::getenv("NO_COLOR");
  const bool plain = no_color != nullptr && *no_color != '\0';
  const auto logger = std::make_shared<spdlog::logger>(
      "lmdbench", std::make_shared<spdlog::sinks::stderr_color_sink_mt>(
                      plain ? spdlog::color_mode::never : spdlog::color_mode::automatic));
  logger->set_pattern("lmdbench: %^%l%$: %v");
  logger->set_level(verbosity < 0    ? spdlog::level::err
                    : verbosity == 0 ? spdlog::level::info
                                     : spdlog::level::debug);
  spdlog::set_default_logger(logger);
}

bool progress_welcome() {
  return spdlog::should_log(spdlog::level::info);
}

}  // namespace lmdbench
