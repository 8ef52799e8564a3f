// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/run/records.h>

#include <cstdint>
#include <string>

namespace lmdbench {

/// Fewer events have no rate: the 95 % interval of ten spans 0.48 to 1.84 times their number, that of two 0.12 to 3.6.
inline constexpr std::int64_t LEAST_EVENTS = 10;

/// Rare events of a run: how many, in what time, and what that says of their rate.
struct Events {
  double count = UNSET;
  double per_second = UNSET;  ///< [1/s]; unset below LEAST_EVENTS.
  /// Limits of the rate [1/s] at 95 %, those of a Poisson count (Garwood, Biometrika 28, 1936). Events that come in bursts
  /// scatter more than that.
  double low = UNSET;
  double high = UNSET;
};

/// @param seconds in which they were looked for; all is unset where it is not above 0
Events count_events(std::int64_t count, double seconds);

/// "2 in 0.598 s (95 %: 0.405 to 12.1 a second)", and before the interval the rate where there is one; "-" for what was not
/// counted. `within` says what the time is of, such as " in contact".
std::string events_text(const Events& events, double seconds, const std::string& within);

}  // namespace lmdbench
