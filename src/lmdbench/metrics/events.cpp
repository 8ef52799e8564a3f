// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/events.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include <cmath>

namespace lmdbench {
namespace {

constexpr double TAIL = 0.025;

/// The mean of a Poisson variable whose counts lie on one side of `count` with the probability TAIL, by way of chi-squared.
double limit(double degrees_of_freedom, double probability) {
  return 0.5 * boost::math::quantile(boost::math::chi_squared(degrees_of_freedom), probability);
}

}  // namespace

Events count_events(std::int64_t count, double seconds) {
  Events events;
  if (!(seconds > 0.0)) return events;
  events.count = static_cast<double>(count);
  events.low = count == 0 ? 0.0 : limit(2.0 * events.count, TAIL) / seconds;
  events.high = limit(2.0 * events.count + 2.0, 1.0 - TAIL) / seconds;
  if (count >= LEAST_EVENTS) events.per_second = events.count / seconds;
  return events;
}

std::string events_text(const Events& events, double seconds, const std::string& within) {
  if (std::isnan(events.count)) return "-";
  std::string text = fmt::format("{:.0f} in {:.3g} s{}", events.count, seconds, within);
  if (!std::isnan(events.per_second)) text += fmt::format(", {:.3g} a second", events.per_second);
  return text + fmt::format(" (95 %: {:.3g} to {:.3g} a second)", events.low, events.high);
}

}  // namespace lmdbench
