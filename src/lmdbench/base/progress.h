// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace lmdbench {

/// Gets how much is done and how much there is to do; returns false to stop the work.
using Progress = std::function<bool(std::int64_t done, std::int64_t total)>;

/// Thrown when `Progress` asked to stop.
class Interrupted {};

/// Reports how far a loop is, where anybody asks.
/// @throws Interrupted when `progress` asked to stop
inline void tell_progress(const Progress& progress, std::size_t done, std::size_t total) {
  if (progress && !progress(static_cast<std::int64_t>(done), static_cast<std::int64_t>(total)))
    throw Interrupted();
}

}  // namespace lmdbench
