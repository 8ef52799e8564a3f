// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/json_text.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/metrics/number_text.h>
#include <lmdbench/sweep/write_sweep.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

namespace lmdbench {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::string_view ERROR = "force_error_rms_n";
constexpr std::string_view COST = "processor_share";

void write_samples(ResultWriter& writer, const std::string& group, const PointResult& point) {
  if (!point.failure.empty()) return;
  const auto times = [&](const std::string& name, const std::string& long_name,
                         std::vector<double> RepetitionTimes::*column) {
    std::vector<double> values;
    for (const RepetitionTimes& repetition : point.repetitions)
      values.insert(values.end(), (repetition.*column).begin(), (repetition.*column).end());
    writer.write({group + "/" + name, "s", long_name}, std::span<const double>(values),
                 {point.repetitions.size(), values.size() / point.repetitions.size()});
  };
  times("local_update_time", "local update of a frame, by repetition", &RepetitionTimes::local_update);
  if (!point.errors.search_frames.empty()) {
    times("global_search_time", "global search, by repetition", &RepetitionTimes::global_search);
    times("first_reduction_time", "first reduction, by repetition", &RepetitionTimes::first_reduction);
    times("second_tracking_time", "second tracking, by repetition", &RepetitionTimes::second_tracking);
    writer.write({group + "/global_frame", "1", "frame that the global search started in"},
                 std::span<const std::int64_t>(point.errors.search_frames),
                 {point.errors.search_frames.size()});
  }
  writer.write({group + "/force_magnitude", "N", "length of the rendered force"},
               std::span<const double>(point.errors.force), {point.errors.force.size()});
  writer.write({group + "/tracked_count", "1", "LMDs carried"},
               std::span<const std::int64_t>(point.errors.tracked), {point.errors.tracked.size()});
  const std::vector<std::uint8_t> counts(point.errors.counts.begin(), point.errors.counts.end());
  writer.write({group + "/counts", "1", "1 for a frame in contact that counts"},
               std::span<const std::uint8_t>(counts), {counts.size()});
}

void write_texts(ResultWriter& writer, const std::string& name, const std::string& long_name,
                 const Sweep& sweep, const std::function<std::string(const SweepPoint&)>& text) {
  std::vector<std::string> values;
  for (const SweepPoint& point : sweep.points) values.push_back(text(point));
  writer.write({"/points/" + name, "1", long_name}, values);
}

}  // namespace

nlohmann::ordered_json axes_json(const SweepPoint& point) {
  OrderedJson axes = OrderedJson::object();
  for (const auto& [place, value] : point.axes) axes[place] = OrderedJson::parse(value);
  return axes;
}

bool on_front(const Sweep& sweep, const SweepResult& result, std::size_t point) {
  const double error = result.points[point].number(ERROR), cost = result.points[point].number(COST);
  if (std::isnan(error) || std::isnan(cost)) return false;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    if (sweep.points[i].problem != sweep.points[point].problem) continue;
    const double other_error = result.points[i].number(ERROR), other_cost = result.points[i].number(COST);
    if (other_error <= error && other_cost <= cost && (other_error < error || other_cost < cost))
      return false;
  }
  return true;
}

void write_sweep(ResultWriter& writer, const Sweep& sweep, const SweepResult& result) {
  writer.attribute("/sweep", "name", sweep.name);
  writer.attribute("/sweep", "title", sweep.title);
  writer.attribute("/sweep", "repetitions", sweep.repetitions);
  writer.attribute("/sweep", "from_frame", sweep.from_frame);
  writer.attribute("/sweep", "clock_overhead_s", result.clock_overhead_s);
  using Point = const SweepPoint&;
  write_texts(writer, "scene", "name of the experiment", sweep, [](Point p) { return p.scene; });
  write_texts(writer, "problem",
              "scene and what of its truth the sweep varies: points of one can be compared", sweep,
              [](Point p) { return p.problem; });
  write_texts(writer, "series", "label of the series", sweep, [](Point p) { return p.series; });
  write_texts(writer, "method", "method", sweep, [](Point p) { return p.experiment.methods.front().name; });
  write_texts(writer, "force_law", "force law", sweep,
              [](Point p) { return std::string(to_string(p.experiment.methods.front().force_law)); });
  write_texts(writer, "axes", "values of the axes: JSON object {place in the experiment: value}", sweep,
              [](Point p) { return axes_json(p).dump(); });
  write_texts(writer, "experiment", "the point's experiment, resolved: JSON", sweep,
              [](Point p) { return p.experiment.resolved_json; });
  std::vector<std::string> failures, hashes, places;
  for (const PointResult& point : result.points) {
    failures.push_back(point.failure);
    hashes.push_back(point.result_hash);
    places.push_back(point.where_json);
  }
  writer.write({"/points/failure", "1", "why the point has no numbers; empty where it has"}, failures);
  writer.write({"/points/result_hash", "1", "hash of forces and LMDs"}, hashes);
  writer.write({"/points/where", "1", "where and beside what each repetition was timed: JSON array"}, places);
  const auto column = [&](const std::string& path, std::string_view units, std::string_view long_name,
                          const std::function<double(const PointResult&)>& value) {
    std::vector<double> values;
    for (const PointResult& point : result.points) values.push_back(value(point));
    writer.write({path, std::string(units), std::string(long_name)}, std::span<const double>(values),
                 {values.size()});
  };
  for (const PointNumber& number : point_numbers()) {
    const std::string path = "/points/" + std::string(number.name);
    column(path, number.units, number.long_name,
           [&](const PointResult& point) { return point.number(number.name); });
    if (number.made_of_times) writer.attribute(path, "made_of_times", std::int64_t{1});
  }
  std::vector<double> fronts;
  for (std::size_t i = 0; i < result.points.size(); ++i)
    fronts.push_back(on_front(sweep, result, i) ? 1.0 : 0.0);
  writer.write({"/points/on_front", "1",
                "1 where no point of the problem is no worse in force error and run time and better in one"},
               std::span<const double>(fronts), {fronts.size()});
  writer.attribute("/points/on_front", "made_of_times", std::int64_t{1});
  column("/points/maximum_force_n", "N", "F_max of one LMD, the scale of force errors",
         [&](const PointResult& point) {
           return sweep.points[static_cast<std::size_t>(&point - result.points.data())]
               .experiment.profiles.front()
               .maximum_force_n;
         });
  column("/points/method_order", "1", "place of the method in reports", [&](const PointResult& point) {
    const SweepPoint& of = sweep.points[static_cast<std::size_t>(&point - result.points.data())];
    return static_cast<double>(method_order(of.experiment.methods.front().name));
  });
  column("/points/truth_checked_frames", "1", "frames whose truth was compared with the exhaustive set",
         [](const PointResult& point) { return static_cast<double>(point.errors.truth_checked_frames); });
  column("/points/truth_wrong_frames", "1", "frames whose truth is not the exhaustive set",
         [](const PointResult& point) { return static_cast<double>(point.errors.truth_wrong_frames); });
  column("/points/begun", "1", "traversals that began: more than the repetitions where some were done again",
         [](const PointResult& point) { return static_cast<double>(point.begun); });
  std::set<std::string> counters;
  for (const PointResult& point : result.points)
    for (const auto& [name, value] : point.errors.counters) counters.insert(name);
  for (const std::string& name : counters)
    column("/counters/" + name, "1", "sum over the path, local and global part",
           [&](const PointResult& point) {
             const auto found = point.errors.counters.find(name);
             return found == point.errors.counters.end() ? UNSET : static_cast<double>(found->second);
           });
  if (!sweep.keep_samples) return;
  for (std::size_t i = 0; i < result.points.size(); ++i)
    write_samples(writer, fmt::format("/samples/{}", i), result.points[i]);
}

std::string sweep_text(const Sweep& sweep, const SweepResult& result) {
  std::vector<std::size_t> order(sweep.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (sweep.points[a].problem != sweep.points[b].problem)
      return sweep.points[a].problem < sweep.points[b].problem;
    const double x = result.points[a].number(COST), y = result.points[b].number(COST);
    return std::isnan(y) ? !std::isnan(x) : x < y;
  });
  std::string text, problem;
  for (const std::size_t i : order) {
    const SweepPoint& point = sweep.points[i];
    const PointResult& values = result.points[i];
    if (point.problem != problem) {
      problem = point.problem;
      text += fmt::format(
          "{}{}: * on the front of force error and run time; force error in % of F_max\n"
          "{:<2}{:>9} {:>9} {:>9} {:>5} {:>8} {:>8} {:>7} {:>7}  {}\n",
          text.empty() ? "" : "\n", problem, "", "ms/s", "med us", "99% us", ">1ms", "F rms", "F 99%",
          "recall", "precis", "point");
    }
    const std::string name =
        point.axes.empty() ? point.series : fmt::format("{} {}", point.series, point.axes_text());
    if (!values.failure.empty()) {
      text += fmt::format("failed  {}: {}\n", name, values.failure);
      continue;
    }
    const double percent_of_force = 100.0 / point.experiment.profiles.front().maximum_force_n;
    text += fmt::format(
        "{:<2}{:>9} {:>9} {:>9} {:>5} {:>8} {:>8} {:>7} {:>7}  {}\n", on_front(sweep, result, i) ? "*" : "",
        number_text(1e3 * values.number(COST)), number_text(1e6 * values.number("frame_time_median_s")),
        number_text(1e6 * values.number("frame_time_p99_s")), number_text(values.number("frames_late")),
        number_text(percent_of_force * values.number(ERROR)),
        number_text(percent_of_force * values.number("force_error_p99_n")),
        share_text(values.number("recall"), 100.0), share_text(values.number("precision"), 100.0), name);
  }
  std::int64_t wrong = 0;
  for (const PointResult& point : result.points) wrong = std::max(wrong, point.errors.truth_wrong_frames);
  if (wrong > 0)
    text += fmt::format(
        "truth itself is in doubt: up to {} checked frames of a scene differ from the exhaustive set\n",
        wrong);
  return text;
}

std::string sweep_json(const Sweep& sweep, const SweepResult& result) {
  OrderedJson rows = OrderedJson::array();
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const SweepPoint& point = sweep.points[i];
    const PointResult& values = result.points[i];
    OrderedJson row{{"scene", point.scene},
                    {"problem", point.problem},
                    {"series", point.series},
                    {"method", point.experiment.methods.front().name},
                    {"axes", axes_json(point)},
                    {"failure", values.failure.empty() ? OrderedJson() : OrderedJson(values.failure)},
                    {"on_front", on_front(sweep, result, i)},
                    {"truth_checked_frames", values.errors.truth_checked_frames},
                    {"truth_wrong_frames", values.errors.truth_wrong_frames}};
    for (const PointNumber& number : point_numbers()) {
      const double value = values.number(number.name);
      row[std::string(number.name)] = std::isfinite(value) ? OrderedJson(value) : OrderedJson();
    }
    rows.push_back(std::move(row));
  }
  return json_line(rows);
}

}  // namespace lmdbench
