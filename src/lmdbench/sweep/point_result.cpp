// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/method_summary.h>
#include <lmdbench/metrics/step_numbers.h>
#include <lmdbench/metrics/times.h>
#include <lmdbench/sweep/point_result.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

constexpr double NANOSECOND = 1e-9;

/// Seconds as whole nanoseconds; null for NaN.
Json in_nanoseconds(const std::vector<double>& values) {
  Json result = Json::array();
  for (const double value : values) {
    if (std::isnan(value))
      result.push_back(nullptr);
    else
      result.push_back(static_cast<std::int64_t>(std::llround(value / NANOSECOND)));
  }
  return result;
}

std::vector<double> from_nanoseconds(const Json& values) {
  std::vector<double> result;
  result.reserve(values.size());
  for (const Json& value : values)
    result.push_back(value.is_null() ? UNSET : static_cast<double>(value.get<std::int64_t>()) * NANOSECOND);
  return result;
}

}  // namespace

const std::vector<PointNumber>& point_numbers() {
  static const std::vector<PointNumber> all = [] {
    std::vector<PointNumber> infos;
    const auto add = [&](const auto& numbers, auto made_of_times) {
      for (const auto& number : numbers)
        infos.push_back({number.name, number.units, number.long_name, made_of_times(number)});
    };
    add(summary_numbers(), [](const auto& number) { return number.made_of_times(); });
    add(step_numbers(), [](const auto&) { return false; });  // with seconds of the path
    add(time_numbers(), [](const auto&) { return true; });
    return infos;
  }();
  return all;
}

Json PointRun::to_json() const {
  return {{"result_hash", result_hash},
          {"work_hash", work_hash},
          {"local_update_ns", in_nanoseconds(times.local_update)},
          {"global_search_ns", in_nanoseconds(times.global_search)},
          {"first_reduction_ns", in_nanoseconds(times.first_reduction)},
          {"second_tracking_ns", in_nanoseconds(times.second_tracking)}};
}

PointRun PointRun::from_json(const Json& json) {
  PointRun run;
  run.result_hash = json.at("result_hash").get<std::string>();
  run.work_hash = json.at("work_hash").get<std::string>();
  run.times.local_update = from_nanoseconds(json.at("local_update_ns"));
  run.times.global_search = from_nanoseconds(json.at("global_search_ns"));
  run.times.first_reduction = from_nanoseconds(json.at("first_reduction_ns"));
  run.times.second_tracking = from_nanoseconds(json.at("second_tracking_ns"));
  return run;
}

Json PointErrors::to_json() const {
  std::string contact;
  for (const bool frame : counts) contact.push_back(frame ? '1' : '0');
  return {{"numbers", numbers},
          {"counters", counters},
          {"counts", contact},
          {"tracked", tracked},
          {"search_frames", search_frames},
          {"force_n", force},
          {"truth_checked_frames", truth_checked_frames},
          {"truth_wrong_frames", truth_wrong_frames}};
}

PointErrors PointErrors::from_json(const Json& json) {
  PointErrors errors;
  errors.numbers = json.at("numbers").get<std::map<std::string, double>>();
  errors.counters = json.at("counters").get<std::map<std::string, std::int64_t>>();
  for (const char frame : json.at("counts").get<std::string>()) errors.counts.push_back(frame == '1');
  errors.tracked = json.at("tracked").get<std::vector<std::int64_t>>();
  errors.search_frames = json.at("search_frames").get<std::vector<std::int64_t>>();
  for (const Json& newtons : json.at("force_n"))
    errors.force.push_back(newtons.is_null() ? UNSET : newtons.get<double>());
  errors.truth_checked_frames = json.at("truth_checked_frames").get<std::int64_t>();
  errors.truth_wrong_frames = json.at("truth_wrong_frames").get<std::int64_t>();
  return errors;
}

bool PointErrors::fits(const PointRun& run) const {
  const std::size_t frames = counts.size(), searches = search_frames.size();
  const RepetitionTimes& times = run.times;
  return tracked.size() == frames && force.size() == frames && times.local_update.size() == frames &&
         times.global_search.size() == searches && times.first_reduction.size() == searches &&
         times.second_tracking.size() == searches &&
         std::all_of(search_frames.begin(), search_frames.end(), [&](std::int64_t frame) {
           return frame >= 0 && frame < static_cast<std::int64_t>(frames);
         });
}

double PointResult::number(std::string_view name) const {
  const auto found = numbers.find(std::string(name));
  return found == numbers.end() ? UNSET : found->second;
}

PointResult finish_point(PointErrors errors, const std::vector<PointRun>& runs, double frame_rate_hz) {
  MethodRecord record;
  for (const std::int64_t frame : errors.search_frames) record.searches.emplace_back().frame = frame;
  for (const std::int64_t tracked : errors.tracked) record.frames.emplace_back().tracked_count = tracked;
  for (const PointRun& run : runs) record.repetitions.push_back(run.times);
  PointResult result;
  result.result_hash = runs.front().result_hash;
  result.numbers = errors.numbers;
  MethodSummary summary;
  summarise_times(summary, record, errors.counts);
  add_known(result.numbers, summary, summary_numbers());
  add_known(result.numbers, measure_times(record, errors.counts, frame_rate_hz), time_numbers());
  result.errors = std::move(errors);
  result.repetitions = std::move(record.repetitions);
  return result;
}

}  // namespace lmdbench
