// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method_description.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace lmdbench {

std::string_view to_string(Promise promise) {
  switch (promise) {
    case Promise::COMPLETE_SET:
      return "complete-set";
    case Promise::APPROXIMATION:
      return "approximation";
    case Promise::NEAREST_PAIR:
      return "nearest-pair";
    case Promise::FORCE_ONLY:
      break;
  }
  return "force-only";
}

std::vector<CounterDescription> MethodDescription::local_counters() const {
  std::vector<CounterDescription> result;
  std::copy_if(counters.begin(), counters.end(), std::back_inserter(result),
               [this](const CounterDescription& counter) {
                 return counter.counted_by != (tracks_locally ? CountedBy::SEARCH : CountedBy::TRACKING);
               });
  return result;
}

std::vector<CounterDescription> MethodDescription::global_counters() const {
  std::vector<CounterDescription> result;
  std::copy_if(counters.begin(), counters.end(), std::back_inserter(result),
               [this](const CounterDescription& counter) {
                 return tracks_locally &&
                        (trackings_after_search > 0 || counter.counted_by != CountedBy::TRACKING);
               });
  return result;
}

nlohmann::json with_defaults(nlohmann::json properties, const nlohmann::json& defaults) {
  for (const auto& [key, value] : defaults.items()) {
    if (!properties.contains(key)) throw std::logic_error("option " + key + " has no schema");
    properties[key]["default"] = value;
  }
  for (const auto& [key, property] : properties.items())
    if (!property.contains("default")) throw std::logic_error("option " + key + " has no default");
  return properties;
}

}  // namespace lmdbench
