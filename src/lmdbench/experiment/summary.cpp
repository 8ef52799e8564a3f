// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/experiment/summary.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lmdbench {
namespace {

constexpr double P99 = 0.99;

/// All measured samples of one kind of time in the columns (frames or searches) that `counts` names: every
/// repetition but the warm-up, which counts only if it is alone.
std::vector<double> measured(const MethodRecord& record, std::vector<double> RepetitionTimes::*times,
                             const std::vector<bool>& counts) {
  std::vector<double> samples;
  const std::size_t first = record.repetitions.size() > 1 ? 1 : 0;
  for (std::size_t i = first; i < record.repetitions.size(); ++i) {
    const std::vector<double>& repetition = record.repetitions[i].*times;
    for (std::size_t column = 0; column < repetition.size(); ++column)
      if (counts[column]) samples.push_back(repetition[column]);
  }
  return samples;
}

void summarise_counts(MethodSummary& summary, const MethodRecord& record) {
  std::vector<double> counts, ratios, candidates;
  for (const FrameRecord& frame : record.frames) {
    summary.lmd_count_maximum = std::max(summary.lmd_count_maximum, frame.lmd_count);
    if (frame.lmd_count == 0) continue;
    counts.push_back(static_cast<double>(frame.lmd_count));
    ratios.push_back(frame.lmd_count_before_reduction / static_cast<double>(frame.lmd_count));
  }
  for (const SearchRecord& search : record.searches)
    if (search.candidates > 0) candidates.push_back(static_cast<double>(search.candidates));
  summary.lmd_count_median = median(counts);
  summary.candidates_median = median(candidates);
  summary.reduction_ratio_median = median(ratios);
  summary.reduction_ratio_maximum = maximum(ratios);
}

void summarise_errors(MethodSummary& summary, const MethodRecord& record, ForceLaw law,
                      const std::vector<TruthFrame>& truth, const std::vector<TruthComparison>& comparisons) {
  std::vector<double> recall, precision, recall_adjacent, precision_adjacent, distance, force, angle, jump,
      true_jump;
  const auto index = static_cast<std::size_t>(law);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const TruthComparison& row = comparisons[i];
    recall.push_back(row.same.recall());
    precision.push_back(row.same.precision());
    recall_adjacent.push_back(row.neighbours.recall());
    precision_adjacent.push_back(row.neighbours.precision());
    distance.push_back(std::abs(row.minimum_distance_error));
    angle.push_back(row.force_angle_error);
    const bool pushed = !truth[i].force[index].isZero(0.0) ||
                        !record.frames[static_cast<std::size_t>(truth[i].frame)].force.isZero(0.0);
    if (!pushed) continue;
    force.push_back(row.force_error);
    jump.push_back(row.force_jump);
    true_jump.push_back(truth[i].force_jump[index]);
  }
  summary.recall_mean = mean(recall);
  summary.precision_mean = mean(precision);
  summary.recall_adjacent_mean = mean(recall_adjacent);
  summary.precision_adjacent_mean = mean(precision_adjacent);
  summary.minimum_distance_error_maximum_m = maximum(distance);
  summary.force_error_median_n = median(force);
  summary.force_error_p99_n = quantile(force, P99);
  summary.force_angle_error_median_rad = median(angle);
  summary.force_jump_p99_n = quantile(jump, P99);
  summary.true_force_jump_p99_n = quantile(true_jump, P99);
}

void summarise_times(MethodSummary& summary, const MethodRecord& record) {
  std::vector<bool> contact, found;
  for (const FrameRecord& frame : record.frames) contact.push_back(frame.lmd_count > 0);
  for (const SearchRecord& search : record.searches) found.push_back(search.candidates > 0);
  const std::vector<double> local = measured(record, &RepetitionTimes::local_update, contact);
  summary.local_update_median_s = median(local);
  summary.local_update_p99_s = quantile(local, P99);
  summary.global_search_median_s = median(measured(record, &RepetitionTimes::global_search, found));
  summary.first_reduction_median_s = median(measured(record, &RepetitionTimes::first_reduction, found));
  summary.second_tracking_median_s = median(measured(record, &RepetitionTimes::second_tracking, found));
}

/// A number with a unit, or "-" where it was not measured.
std::string shown(double value, double scale, const char* unit, const char* format = "{:.3g}{}") {
  return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value * scale, unit);
}

std::string method_text(const MethodSummary& m, bool probed) {
  constexpr double DEGREES = 180.0 / std::numbers::pi;
  std::string text = fmt::format("{} (hash {})\n", m.label, m.result_hash);
  text += fmt::format("  LMDs   {} in the median contact frame, {} at most", shown(m.lmd_count_median, 1, ""),
                      m.lmd_count_maximum);
  if (!std::isnan(m.candidates_median))
    text += fmt::format("; {} candidates a search, {} to 1 in the median, {} at most",
                        shown(m.candidates_median, 1, ""), shown(m.reduction_ratio_median, 1, ""),
                        shown(m.reduction_ratio_maximum, 1, ""));
  text += "\n";
  if (probed) {
    text += fmt::format(
        "  error  recall {} precision {} (adjacent features: {} and {}), minimum distance {} at most\n",
        shown(m.recall_mean, 1, ""), shown(m.precision_mean, 1, ""), shown(m.recall_adjacent_mean, 1, ""),
        shown(m.precision_adjacent_mean, 1, ""), shown(m.minimum_distance_error_maximum_m, 1e6, " um"));
    text += fmt::format("         force {} median, {} 99 %, {} median angle; jump {} 99 % (truth {})\n",
                        shown(m.force_error_median_n, 1, " N"), shown(m.force_error_p99_n, 1, " N"),
                        shown(m.force_angle_error_median_rad, DEGREES, " deg"),
                        shown(m.force_jump_p99_n, 1, " N"), shown(m.true_force_jump_p99_n, 1, " N"));
  } else {
    text +=
        "  error  not measured: the truth probe is off, so the times below stand without what they bought\n";
  }
  text += fmt::format("  time   local update {} median, {} 99 % of contact frames",
                      shown(m.local_update_median_s, 1e6, " us"), shown(m.local_update_p99_s, 1e6, " us"));
  if (!std::isnan(m.global_search_median_s))
    text += fmt::format("; global search {}, first reduction {}, second tracking {} (medians near contact)",
                        shown(m.global_search_median_s, 1e6, " us"),
                        shown(m.first_reduction_median_s, 1e6, " us"),
                        shown(m.second_tracking_median_s, 1e6, " us"));
  return text + "\n";
}

nlohmann::ordered_json method_json(const MethodSummary& m) {
  return {{"label", m.label},
          {"result_hash", m.result_hash},
          {"lmd_count_median", m.lmd_count_median},
          {"lmd_count_maximum", m.lmd_count_maximum},
          {"candidates_median", m.candidates_median},
          {"reduction_ratio_median", m.reduction_ratio_median},
          {"reduction_ratio_maximum", m.reduction_ratio_maximum},
          {"error",
           {{"recall_mean", m.recall_mean},
            {"precision_mean", m.precision_mean},
            {"recall_adjacent_mean", m.recall_adjacent_mean},
            {"precision_adjacent_mean", m.precision_adjacent_mean},
            {"minimum_distance_error_maximum_m", m.minimum_distance_error_maximum_m},
            {"force_error_median_n", m.force_error_median_n},
            {"force_error_p99_n", m.force_error_p99_n},
            {"force_angle_error_median_rad", m.force_angle_error_median_rad},
            {"force_jump_p99_n", m.force_jump_p99_n},
            {"true_force_jump_p99_n", m.true_force_jump_p99_n}}},
          {"time",
           {{"local_update_median_s", m.local_update_median_s},
            {"local_update_p99_s", m.local_update_p99_s},
            {"global_search_median_s", m.global_search_median_s},
            {"first_reduction_median_s", m.first_reduction_median_s},
            {"second_tracking_median_s", m.second_tracking_median_s}}}};
}

}  // namespace

RunSummary summarise(const Experiment& experiment, const RunResult& result) {
  RunSummary summary;
  summary.name = experiment.name;
  summary.frames = static_cast<std::int64_t>(result.prepared.times.size());
  summary.probed_frames = static_cast<std::int64_t>(result.truth.size());
  summary.measured_repetitions = std::max<std::int64_t>(experiment.driver.repetitions - 1, 1);
  summary.cutoff_m = result.prepared.scene.cutoff;
  summary.warnings = result.warnings;
  for (std::size_t i = 0; i < result.records.size(); ++i) {
    const MethodRecord& record = result.records[i];
    MethodSummary method;
    method.label = record.label;
    method.result_hash = fmt::format("{:016x}", record.result_hash);
    summarise_counts(method, record);
    if (!result.truth.empty())
      summarise_errors(method, record, experiment.methods[i].force_law, result.truth, result.comparisons[i]);
    summarise_times(method, record);
    summary.methods.push_back(std::move(method));
  }
  if (result.fcl) {
    summary.fcl_tolerance_relative = experiment.fcl_tolerance_relative;
    summary.fcl_frames = static_cast<std::int64_t>(result.fcl->frames.size());
    for (const FclException& exception : result.fcl->exceptions) ++summary.fcl_exceptions[exception.who];
    for (const FclFrame& frame : result.fcl->frames) {
      summary.fcl_separated += frame.separated ? 1 : 0;
      summary.fcl_agreeing += frame.agrees ? 1 : 0;
    }
  }
  return summary;
}

std::string summary_text(const RunSummary& summary) {
  std::string text = fmt::format("{}: {} frames, cutoff {:.4g} mm, {} of the frames against truth, {}\n",
                                 summary.name, summary.frames, summary.cutoff_m * 1e3, summary.probed_frames,
                                 summary.measured_repetitions == 1
                                     ? std::string("1 measured repetition")
                                     : fmt::format("{} measured repetitions", summary.measured_repetitions));
  for (const MethodSummary& method : summary.methods) text += method_text(method, summary.probed_frames > 0);
  if (summary.fcl_frames > 0) {
    text += fmt::format("FCL: {} frames, {} separated; exact minimum distance agrees within {:g} in {}\n",
                        summary.fcl_frames, summary.fcl_separated, summary.fcl_tolerance_relative,
                        summary.fcl_agreeing);
    for (const auto& [who, count] : summary.fcl_exceptions)
      text += fmt::format("     {}: {} out of tolerance\n", who, count);
  }
  for (const std::string& warning : summary.warnings) text += "note: " + warning + "\n";
  return text;
}

std::string summary_json(const RunSummary& summary) {
  nlohmann::ordered_json json{{"name", summary.name},
                              {"frames", summary.frames},
                              {"probed_frames", summary.probed_frames},
                              {"measured_repetitions", summary.measured_repetitions},
                              {"cutoff_m", summary.cutoff_m}};
  json["methods"] = nlohmann::ordered_json::array();
  for (const MethodSummary& method : summary.methods) json["methods"].push_back(method_json(method));
  json["fcl"] = nullptr;
  if (summary.fcl_frames > 0)
    json["fcl"] = {{"frames", summary.fcl_frames},
                   {"separated", summary.fcl_separated},
                   {"agreeing", summary.fcl_agreeing},
                   {"exceptions", summary.fcl_exceptions},
                   {"tolerance_relative", summary.fcl_tolerance_relative}};
  json["warnings"] = summary.warnings;
  return json.dump(2);  // NaN and infinity become null
}

}  // namespace lmdbench
