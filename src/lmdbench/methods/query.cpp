// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/own_time.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/query.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace lmdbench {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson point_json(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

OrderedJson feature_json(const FeatureId& feature) {
  return {{"kind", std::string(to_string(feature.kind))}, {"index", feature.index}};
}

OrderedJson lmd_json(const Lmd& lmd) {
  return {{"distance", lmd.distance},
          {"point_moving", point_json(lmd.point_moving)},
          {"point_fixed", point_json(lmd.point_fixed)},
          {"feature_moving", feature_json(lmd.feature_moving)},
          {"feature_fixed", feature_json(lmd.feature_fixed)}};
}

QueryAnswer answer_of(const Method& method, double time) {
  QueryAnswer answer;
  answer.time = time;
  answer.method = method.description().name;
  return answer;
}

void add_counters(const Method& method, const WorkCounters& counters, QueryAnswer& answer) {
  for (const CounterDescription& counter : method.description().counters)
    answer.counters.emplace_back(counter.name, counters.values[counter.index]);
}

}  // namespace

QueryAnswer query(Method& method, const Pose& X_WM, double cutoff, double time) {
  QueryAnswer answer = answer_of(method, time);
  WorkCounters counters;
  seconds_of_others() = 0.0;
  const auto begin = std::chrono::steady_clock::now();
  method.search(X_WM, answer.lmds, counters);
  for (int i = 0; i < method.description().trackings_after_search; ++i)
    method.track(X_WM, answer.lmds, counters);
  answer.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() - seconds_of_others();
  answer.lmds = within_cutoff(answer.lmds, cutoff);
  std::stable_sort(answer.lmds.begin(), answer.lmds.end(), lmd_less);
  add_counters(method, counters, answer);
  return answer;
}

QueryAnswer query_critical(Method& method, const Pose& X_WM, double time) {
  QueryAnswer answer = answer_of(method, time);
  WorkCounters counters;
  const auto begin = std::chrono::steady_clock::now();
  method.find_critical(X_WM, answer.critical.emplace(), counters);
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  answer.lmds = minima_of(*answer.critical);
  add_counters(method, counters, answer);
  return answer;
}

std::string query_json(const QueryAnswer& answer) {
  OrderedJson json;
  json["time"] = answer.time;
  json["method"] = answer.method;
  json["minimum_distance"] = minimum_distance(answer.lmds);  // NaN becomes null
  json["lmds"] = OrderedJson::array();
  if (answer.critical) {
    for (const CriticalPair& critical : *answer.critical) {
      OrderedJson& entry = json["lmds"].emplace_back(lmd_json(critical.pair));
      entry["index"] = critical.has_index ? OrderedJson(critical.index) : OrderedJson();
      entry["minimum"] = critical.is_minimum;
    }
  } else {
    for (const Lmd& lmd : answer.lmds) json["lmds"].push_back(lmd_json(lmd));
  }
  json["counters"] = OrderedJson::object();
  for (const auto& [name, value] : answer.counters) json["counters"][name] = value;
  json["seconds"] = answer.seconds;
  return json.dump();
}

std::string query_text(const QueryAnswer& answer) {
  std::string text = fmt::format("time {} s, {}: {} LMDs, {:.3g} ms\n", answer.time, answer.method,
                                 answer.lmds.size(), answer.seconds * 1e3);
  const auto add = [&](const Lmd& lmd, const std::string& sign) {
    text += fmt::format(
        "  {}{:<12.6g} {:>6} {:<8} ({:.6g}, {:.6g}, {:.6g})  {:>6} {:<8} ({:.6g}, {:.6g}, {:.6g})\n", sign,
        lmd.distance, to_string(lmd.feature_moving.kind), lmd.feature_moving.index, lmd.point_moving.x(),
        lmd.point_moving.y(), lmd.point_moving.z(), to_string(lmd.feature_fixed.kind),
        lmd.feature_fixed.index, lmd.point_fixed.x(), lmd.point_fixed.y(), lmd.point_fixed.z());
  };
  if (answer.critical) {
    for (const CriticalPair& critical : *answer.critical)
      add(critical.pair, fmt::format("{:<8} {:>4} ", critical.is_minimum ? "minimum" : "saddle",
                                     critical.has_index ? fmt::format("{:+d}", critical.index) : "none"));
  } else {
    for (const Lmd& lmd : answer.lmds) add(lmd, "");
  }
  return text;
}

}  // namespace lmdbench
