// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/experiment/errors.h>
#include <lmdbench/experiment/summary.h>
#include <lmdbench/experiment/times.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lmdbench {
namespace {

/// A number with a unit, or "-" where it was not measured.
std::string shown(double value, double scale, const char* unit, const char* format = "{:.3g}{}") {
  return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value * scale, unit);
}

/// "0.885 (0.913)": same features, and neighbouring features counting.
std::string both(double same, double neighbours) {
  return fmt::format("{} ({})", shown(same, 1, ""), shown(neighbours, 1, ""));
}

std::string error_text(const MethodSummary& m) {
  constexpr double DEGREES = 180.0 / std::numbers::pi;
  return fmt::format(
             "  error  recall {}, precision {} (neighbouring features counting), minimum distance off by {} "
             "at "
             "most\n",
             both(m.recall, m.recall_adjacent), both(m.precision, m.precision_adjacent),
             shown(m.minimum_distance_error_maximum_m, 1e6, " um")) +
         fmt::format(
             "         force error {} RMS, {} median, {} 99 %, {} at most; direction off by {} in the "
             "median\n",
             shown(m.force_error_rms_n, 1, " N"), shown(m.force_error_median_n, 1, " N"),
             shown(m.force_error_p99_n, 1, " N"), shown(m.force_error_maximum_n, 1, " N"),
             shown(m.force_angle_error_median_rad, DEGREES, " deg")) +
         fmt::format(
             "         jumps above {:g} % of F_max: {} in contact (truth {}); change of force in a frame {} "
             "99 % "
             "(truth {})\n",
             100.0 * JUMP_SHARE, shown(m.jumps_per_second, 1, " a second"),
             shown(m.true_jumps_per_second, 1, ""), shown(m.force_jump_p99_n, 1, " N"),
             shown(m.true_force_jump_p99_n, 1, " N"));
}

std::string method_text(const MethodSummary& m, bool probed) {
  std::string text = fmt::format("{} (hash {})\n", m.label, m.result_hash);
  text += fmt::format("  LMDs   {} in the median frame in contact, {} at most",
                      shown(m.lmd_count_median, 1, ""), shown(m.lmd_count_maximum, 1, ""));
  if (!std::isnan(m.candidates_median))
    text += fmt::format("; {} candidates a search in the median", shown(m.candidates_median, 1, ""));
  if (!std::isnan(m.reduction_ratio))
    text += fmt::format("; reduced {} to 1 (all candidates / all kept), {} to 1 at most",
                        shown(m.reduction_ratio, 1, ""), shown(m.reduction_ratio_maximum, 1, ""));
  text += "\n";
  text += probed
              ? error_text(m)
              : "  error  not measured: the truth probe is off, so the times below stand without what they "
                "bought\n";
  text += fmt::format("  time   local update {} median, {} 99 % of the frames in contact",
                      shown(m.local_update_median_s, 1e6, " us"), shown(m.local_update_p99_s, 1e6, " us"));
  if (!std::isnan(m.global_search_median_s))
    text += fmt::format("; global search {}, first reduction {}, second tracking {} (medians in contact)",
                        shown(m.global_search_median_s, 1e6, " us"),
                        shown(m.first_reduction_median_s, 1e6, " us"),
                        shown(m.second_tracking_median_s, 1e6, " us"));
  return text + "\n";
}

nlohmann::ordered_json method_json(const MethodSummary& m) {
  nlohmann::ordered_json json{{"label", m.label}, {"result_hash", m.result_hash}};
  for (const SummaryNumber& number : summary_numbers()) json[std::string(number.name)] = m.*number.value;
  return json;
}

void summarise_truth(RunSummary& summary, const RunResult& result) {
  std::vector<double> counts, in_contact;
  for (const TruthFrame& frame : result.truth_of(0)) {
    counts.push_back(static_cast<double>(frame.lmds.size()));
    if (result.in_contact_of(0)[static_cast<std::size_t>(frame.frame)]) in_contact.push_back(counts.back());
  }
  summary.true_lmd_count_median = median(in_contact);
  summary.true_lmd_count_maximum = maximum(counts);
}

}  // namespace

RunSummary summarise(const Experiment& experiment, const RunResult& result) {
  RunSummary summary;
  summary.name = experiment.name;
  summary.frames = static_cast<std::int64_t>(result.prepared.times.size());
  const std::vector<bool>& in_contact = result.in_contact_of(0);
  summary.frames_in_contact = std::count(in_contact.begin(), in_contact.end(), true);
  summary.frames_probed = static_cast<std::int64_t>(result.truth_of(0).size());
  summarise_truth(summary, result);
  summary.measured_repetitions = std::max<std::int64_t>(experiment.driver.repetitions - 1, 1);
  summary.cutoff_m = result.prepared.scene.cutoff;
  summary.warnings = result.warnings;
  for (std::size_t i = 0; i < result.records.size(); ++i) {
    const MethodRecord& record = result.records[i];
    MethodSummary method;
    method.label = record.label;
    method.result_hash = fmt::format("{:016x}", record.result_hash);
    const RunFrames frames{result.in_contact_of(i), experiment.frame_rate_hz,
                           result.prepared.profile.maximum_force};
    summarise_counts(method, record, frames);
    summarise_jumps(method, record, frames);
    if (const std::vector<TruthFrame>& truth = result.truth_of(i); !truth.empty())
      summarise_errors(method, experiment.methods[i].force_law, truth, result.comparisons[i], frames);
    summarise_times(method, record, result.in_contact_of(i));
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
  std::string text = fmt::format(
      "{}: {} frames, {} in contact (within the cutoff of {:.4g} mm), {} against truth, {}\n", summary.name,
      summary.frames, summary.frames_in_contact, summary.cutoff_m * 1e3, summary.frames_probed,
      summary.measured_repetitions == 1
          ? std::string("1 measured repetition")
          : fmt::format("{} measured repetitions", summary.measured_repetitions));
  for (const MethodSummary& method : summary.methods) text += method_text(method, summary.frames_probed > 0);
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
                              {"frames_in_contact", summary.frames_in_contact},
                              {"frames_probed", summary.frames_probed},
                              {"measured_repetitions", summary.measured_repetitions},
                              {"cutoff_m", summary.cutoff_m},
                              {"true_lmd_count_median", summary.true_lmd_count_median},
                              {"true_lmd_count_maximum", summary.true_lmd_count_maximum}};
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

void write_summary(ResultWriter& writer, const RunSummary& summary) {
  const auto write = [&](const std::string& path, std::string_view units, std::string_view long_name,
                         double value) {
    writer.write({path, std::string(units), std::string(long_name)}, std::span<const double>(&value, 1), {1});
  };
  write("/summary/frames_in_contact", "1", "frames in which the meshes are within the cutoff",
        static_cast<double>(summary.frames_in_contact));
  write("/summary/frames_probed", "1", "frames compared with truth",
        static_cast<double>(summary.frames_probed));
  write("/summary/true_lmd_count_median", "1", "true LMDs in a probed frame in contact, median",
        summary.true_lmd_count_median);
  write("/summary/true_lmd_count_maximum", "1", "true LMDs in a probed frame, most",
        summary.true_lmd_count_maximum);
  for (const MethodSummary& method : summary.methods)
    for (const SummaryNumber& number : summary_numbers())
      write(fmt::format("/methods/{}/summary/{}", method.label, number.name), number.units, number.long_name,
            method.*number.value);
}

}  // namespace lmdbench
