// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/metrics/broken_limits.h>
#include <lmdbench/metrics/errors.h>
#include <lmdbench/metrics/summary.h>
#include <lmdbench/metrics/times.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
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

std::string error_text(const MethodSummary& m, double frame_rate_hz) {
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
             "         jumps above {:g} % of F_max: {}; of the true force {}\n"
             "         change of force in a frame {} 99 % (truth {})\n",
             100.0 * JUMP_SHARE,
             events_text({m.jumps, m.jumps_per_second, m.jumps_per_second_low, m.jumps_per_second_high},
                         m.frames_in_contact / frame_rate_hz, " in contact"),
             events_text({m.true_jumps, m.true_jumps_per_second, m.true_jumps_per_second_low,
                          m.true_jumps_per_second_high},
                         m.true_jump_frames / frame_rate_hz,
                         m.true_jump_frames == m.frames_in_contact ? "" : " of probed frames in contact"),
             shown(m.force_jump_p99_n, 1, " N"), shown(m.true_force_jump_p99_n, 1, " N"));
}

std::string rendered_text(const MethodSummary& m) {
  std::string text = fmt::format(
      "  force  rendered {} median, {} 99 %; clipped in {} of the frames in contact; {} above 30 Hz; K_eff "
      "{} 99 %",
      shown(m.rendered_force_median_n, 1, " N"), shown(m.rendered_force_p99_n, 1, " N"),
      shown(m.force_clipped_share, 100, " %"), shown(m.force_above_30_hz_n, 1, " N"),
      shown(m.effective_stiffness_p99_n_per_m, 1, " N/m"));
  if (!std::isnan(m.energy_created_j))
    text += fmt::format("; energy created {}, balance left over {}", shown(m.energy_created_j, 1e3, " mJ"),
                        shown(m.energy_balance_error, 1, ""));
  return text + "\n";
}

std::string method_text(const MethodSummary& m, const RunSummary& summary) {
  const bool closed_loop = summary.closed_loop;
  std::string text = fmt::format("{} (hash {}){}\n", m.label, m.result_hash,
                                 closed_loop ? fmt::format("; its device was in contact in {} frames",
                                                           shown(m.frames_in_contact, 1, "", "{:.0f}{}"))
                                             : "");
  text += fmt::format("  LMDs   {} in the median frame in contact, {} at most",
                      shown(m.lmd_count_median, 1, ""), shown(m.lmd_count_maximum, 1, ""));
  if (!std::isnan(m.candidates_median))
    text += fmt::format("; {} candidates a search in the median", shown(m.candidates_median, 1, ""));
  if (!std::isnan(m.reduction_ratio))
    text += fmt::format("; reduced {} to 1 (all candidates / all kept), {} to 1 at most",
                        shown(m.reduction_ratio, 1, ""), shown(m.reduction_ratio_maximum, 1, ""));
  text += '\n';
  text += rendered_text(m);
  text += summary.frames_probed > 0
              ? error_text(m, summary.frame_rate_hz)
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

/// The numbers that tell profiles apart, with their column and unit in the table.
struct ProfileColumn {
  const char* title;
  double MethodSummary::*value;
  double scale;
};
constexpr std::array PROFILE_COLUMNS = {
    ProfileColumn{"force [N]", &MethodSummary::rendered_force_median_n, 1.0},
    ProfileColumn{"99 % [N]", &MethodSummary::rendered_force_p99_n, 1.0},
    ProfileColumn{"clipped [%]", &MethodSummary::force_clipped_share, 100.0},
    ProfileColumn{">30 Hz [N]", &MethodSummary::force_above_30_hz_n, 1.0},
    ProfileColumn{"jumps", &MethodSummary::jumps, 1.0},
    ProfileColumn{"drops", &MethodSummary::dropouts, 1.0},
    ProfileColumn{"K_eff [N/m]", &MethodSummary::effective_stiffness_p99_n_per_m, 1.0},
    ProfileColumn{"error [N]", &MethodSummary::force_error_rms_n, 1.0},
    ProfileColumn{"made [mJ]", &MethodSummary::energy_created_j, 1e3},
};

/// One line a method and profile, and below it what the profile changes.
std::string profile_table(const RunSummary& summary) {
  std::string text = fmt::format("{:<24} {:<10}", "profiles", "");
  for (const ProfileColumn& column : PROFILE_COLUMNS) text += fmt::format(" {:>11}", column.title);
  text += "\n";
  const auto line = [&](const std::string& method, const std::string& profile, auto&& value_of) {
    text += fmt::format("{:<24} {:<10}", method, profile);
    for (const ProfileColumn& column : PROFILE_COLUMNS)
      text += fmt::format(" {:>11}", shown(value_of(column), column.scale, ""));
  };
  std::string before;
  for (const ProfileDifference& difference : summary.profiles) {
    const MethodSummary& first = summary.methods[difference.first];
    const MethodSummary& here = summary.methods[difference.method];
    const auto of = [](const MethodSummary& m) {
      return [&m](const ProfileColumn& c) { return m.*c.value; };
    };
    if (first.entry != before) {
      line(first.entry, first.profile, of(first));
      text += "\n";
      before = first.entry;
    }
    line("", here.profile, of(here));
    text += "\n";
    line("", "  change", [&](const ProfileColumn& c) { return here.*c.value - first.*c.value; });
    if (!std::isnan(difference.force_difference_rms_n))
      text += fmt::format("  same poses: forces differ by {} RMS, {} at most",
                          shown(difference.force_difference_rms_n, 1, " N"),
                          shown(difference.force_difference_maximum_n, 1, " N"));
    text += "\n";
  }
  return text;
}

nlohmann::ordered_json profile_json(const RunSummary& summary, const ProfileDifference& difference) {
  const MethodSummary& first = summary.methods[difference.first];
  const MethodSummary& here = summary.methods[difference.method];
  nlohmann::ordered_json json{{"method", here.entry},
                              {"profile", here.profile},
                              {"against", first.profile},
                              {"force_difference_rms_n", difference.force_difference_rms_n},
                              {"force_difference_maximum_n", difference.force_difference_maximum_n},
                              {"differences", nlohmann::ordered_json::object()}};
  for (const SummaryNumber& number : summary_numbers())
    json["differences"][std::string(number.name)] = here.*number.value - first.*number.value;
  return json;
}

nlohmann::ordered_json method_json(const MethodSummary& m) {
  nlohmann::ordered_json json{{"label", m.label}, {"result_hash", m.result_hash}};
  for (const SummaryNumber& number : summary_numbers()) json[std::string(number.name)] = m.*number.value;
  return json;
}

void summarise_truth(RunSummary& summary, const RunResult& result) {
  std::vector<double> counts, in_contact;
  const Track& track = result.track_of(0);
  const TruthFindings* truth = track.truth();
  if (truth == nullptr) return;
  summary.frames_probed = static_cast<std::int64_t>(truth->frames.size());
  if (const auto& complete = truth->complete) {
    summary.truth_of_every_frame = complete->label;
    for (std::size_t i = 0; i < complete->lmd_count.size(); ++i) {
      counts.push_back(static_cast<double>(complete->lmd_count[i]));
      if (track.in_contact[i]) in_contact.push_back(counts.back());
    }
    summary.true_lmd_count_median = median(in_contact);
    summary.true_lmd_count_maximum = maximum(counts);
    return;
  }
  for (const TruthFrame& frame : truth->frames) {
    counts.push_back(static_cast<double>(frame.lmds.size()));
    if (track.in_contact[static_cast<std::size_t>(frame.frame)]) in_contact.push_back(counts.back());
  }
  summary.true_lmd_count_median = median(in_contact);
  summary.true_lmd_count_maximum = maximum(counts);
}

/// Every method under a later profile against itself under the first one; the methods of a profile stand together.
void summarise_profiles(RunSummary& summary, const Experiment& experiment, const RunResult& result) {
  const std::size_t entries = experiment.methods.size() / experiment.profiles.size();
  for (std::size_t first = 0; first < entries; ++first) {
    for (std::size_t i = first + entries; i < experiment.methods.size(); i += entries) {
      ProfileDifference difference{.method = i, .first = first};
      if (!experiment.loop.closed) {
        std::vector<double> lengths;
        const auto in_contact = [&](std::size_t method, std::size_t frame) {
          return result.track_of(method).in_contact[frame];
        };
        for (std::size_t frame = 0; frame < result.records[i].frames.size(); ++frame)
          if (in_contact(i, frame) || in_contact(first, frame))
            lengths.push_back(
                (result.records[i].frames[frame].force - result.records[first].frames[frame].force).norm());
        difference.force_difference_maximum_n = maximum(lengths);
        for (double& length : lengths) length *= length;
        difference.force_difference_rms_n = std::sqrt(mean(lengths));
      }
      summary.profiles.push_back(difference);
    }
  }
}

}  // namespace

std::string NearestError::text() const {
  return fmt::format(
      "{} promises the complete set, but its nearest distance in frame {} is {:.6g} m, FCL's {:.6g} m, that "
      "of the exact search {:.6g} "
      "m; wrong in {} of the cross-checked frames (--verbose: poses)",
      label, first.frame, first.distance, first.fcl_distance, first.lmdbench_distance, frames);
}

RunSummary summarise(const Experiment& experiment, const RunResult& result) {
  RunSummary summary;
  summary.name = experiment.name;
  summary.frames = static_cast<std::int64_t>(result.prepared.times.size());
  summary.closed_loop = experiment.loop.closed;
  summary.frame_rate_hz = experiment.frame_rate_hz;
  summary.frames_in_contact = std::count(result.in_contact.begin(), result.in_contact.end(), true);
  summarise_truth(summary, result);
  summary.measured_repetitions = std::max<std::int64_t>(experiment.driver.repetitions - 1, 1);
  summary.cutoff_m = result.prepared.scene().cutoff;
  summary.warnings = result.warnings;
  summary.defaults = result.prepared.defaults;
  for (std::size_t i = 0; i < result.records.size(); ++i) {
    const MethodRecord& record = result.records[i];
    MethodSummary method;
    method.label = record.label;
    method.result_hash = fmt::format("{:016x}", record.result_hash);
    method.entry = experiment.methods[i].entry;
    const Track& track = result.track_of(i);
    const PreparedProfile& profile = result.prepared.profiles[track.profile];
    method.profile = profile.name;
    const RunFrames frames{track.in_contact, experiment.frame_rate_hz, profile.force.maximum_force};
    summarise_counts(method, record, frames);
    summarise_rendering(method, record, frames);
    summarise_jumps(method, record, frames);
    if (const TruthFindings* truth = track.truth()) {
      summarise_errors(method, experiment.methods[i].force_law, truth->frames, result.comparisons(i), frames);
      if (truth->complete)
        summarise_true_steps(method, experiment.methods[i].force_law, record, *truth->complete, frames);
    }
    summarise_times(method, record, track.in_contact);
    summary.methods.push_back(std::move(method));
  }
  summarise_profiles(summary, experiment, result);
  for (const Track& track : result.tracks) {
    const FclCheck* fcl = track.fcl();
    if (fcl == nullptr) continue;
    summary.fcl_tolerance_relative = fcl->tolerance_relative;
    summary.fcl_frames += static_cast<std::int64_t>(fcl->frames.size());
    for (const FclException& exception : fcl->exceptions) {
      ++summary.fcl_exceptions[exception.who];
      if (!exception.is_error) continue;
      std::vector<NearestError>& errors = summary.nearest_errors;
      auto known = std::ranges::find(errors, exception.who, &NearestError::label);
      if (known == errors.end()) known = errors.insert(known, {exception.who, 0, exception});
      ++known->frames;
    }
    for (const FclFrame& frame : fcl->frames) {
      summary.fcl_separated += frame.separated ? 1 : 0;
      summary.fcl_agreeing += frame.agrees ? 1 : 0;
    }
  }
  summary.broken_limits = broken_limits(experiment.acceptance, summary);
  return summary;
}

std::string summary_text(const RunSummary& summary) {
  std::string text =
      fmt::format("{}: {} frames, {} in contact (within the cutoff of {:.4g} mm{}), {} against truth{}, {}\n",
                  summary.name, summary.frames, summary.frames_in_contact, summary.cutoff_m * 1e3,
                  summary.closed_loop ? " on the path that the hand means" : "", summary.frames_probed,
                  summary.truth_of_every_frame.empty()
                      ? ""
                      : fmt::format(" by exhaustive search and in all of them by {}, which agrees there",
                                    summary.truth_of_every_frame),
                  summary.measured_repetitions == 1
                      ? std::string("1 measured repetition")
                      : fmt::format("{} measured repetitions", summary.measured_repetitions));
  for (const MethodSummary& method : summary.methods) text += method_text(method, summary);
  if (!summary.profiles.empty()) text += profile_table(summary);
  if (summary.fcl_frames > 0) {
    text += fmt::format("FCL: {} frames, {} separated; exact minimum distance agrees within {:g} in {}\n",
                        summary.fcl_frames, summary.fcl_separated, summary.fcl_tolerance_relative,
                        summary.fcl_agreeing);
    for (const auto& [who, count] : summary.fcl_exceptions)
      text += fmt::format("     {}: {} out of tolerance\n", who, count);
  }
  text += defaults_text(summary.defaults);
  for (const std::string& warning : summary.warnings) text += "note: " + warning + "\n";
  for (const NearestError& error : summary.nearest_errors) text += "ERROR: " + error.text() + "\n";
  for (const std::string& limit : summary.broken_limits) text += "limit broken: " + limit + "\n";
  return text;
}

std::string summary_json(const RunSummary& summary) {
  nlohmann::ordered_json json{
      {"name", summary.name},
      {"frames", summary.frames},
      {"frames_in_contact", summary.frames_in_contact},
      {"frame_rate_hz", summary.frame_rate_hz},
      {"frames_probed", summary.frames_probed},
      {"truth_of_every_frame", summary.truth_of_every_frame.empty()
                                   ? nlohmann::ordered_json(nullptr)
                                   : nlohmann::ordered_json(summary.truth_of_every_frame)},
      {"measured_repetitions", summary.measured_repetitions},
      {"cutoff_m", summary.cutoff_m},
      {"true_lmd_count_median", summary.true_lmd_count_median},
      {"true_lmd_count_maximum", summary.true_lmd_count_maximum}};
  json["methods"] = nlohmann::ordered_json::array();
  for (const MethodSummary& method : summary.methods) json["methods"].push_back(method_json(method));
  if (!summary.profiles.empty()) {
    json["profiles"] = nlohmann::ordered_json::array();
    for (const ProfileDifference& difference : summary.profiles)
      json["profiles"].push_back(profile_json(summary, difference));
  }
  json["fcl"] = nullptr;
  if (summary.fcl_frames > 0)
    json["fcl"] = {{"frames", summary.fcl_frames},
                   {"separated", summary.fcl_separated},
                   {"agreeing", summary.fcl_agreeing},
                   {"exceptions", summary.fcl_exceptions},
                   {"tolerance_relative", summary.fcl_tolerance_relative}};
  json["nearest_errors"] = nlohmann::ordered_json::array();
  for (const NearestError& error : summary.nearest_errors)
    json["nearest_errors"].push_back({{"method", error.label},
                                      {"frames", error.frames},
                                      {"frame", error.first.frame},
                                      {"distance_m", error.first.distance},
                                      {"fcl_distance_m", error.first.fcl_distance},
                                      {"exact_distance_m", error.first.lmdbench_distance}});
  json["warnings"] = summary.warnings;
  json["broken_limits"] = summary.broken_limits;
  json["defaults"] = defaults_json(summary.defaults);
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
  writer.attribute("/summary", "truth_of_every_frame", summary.truth_of_every_frame);
  write("/summary/true_lmd_count_median", "1", "true LMDs in a frame in contact whose truth is known, median",
        summary.true_lmd_count_median);
  write("/summary/true_lmd_count_maximum", "1", "true LMDs in a frame whose truth is known, most",
        summary.true_lmd_count_maximum);
  for (const MethodSummary& method : summary.methods)
    for (const SummaryNumber& number : summary_numbers()) {
      const std::string path = fmt::format("/methods/{}/summary/{}", method.label, number.name);
      write(path, number.units, number.long_name, method.*number.value);
      if (number.made_of_times()) writer.attribute(path, "made_of_times", std::int64_t{1});
    }
}

}  // namespace lmdbench
