// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include <cmath>
#include <string>
#include <utility>

namespace lmdbench {

/// A range of real numbers: CLI11's own lets NaN pass, which is neither below nor above.
inline CLI::Validator real_range(CLI::Range range) {
  const std::string description = range.get_description();
  return {[range = std::move(range), description](std::string& text) {
            double value = 0.0;
            if (CLI::detail::lexical_cast(text, value) && std::isnan(value))
              return "Value " + text + " is no number, not " + description;
            return range(text);
          },
          description};
}

}  // namespace lmdbench
