// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/errors.h>
#include <lmdbench/metrics/number_text.h>
#include <lmdbench/metrics/summary.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

/// A number with its unit, or "-" if unmeasured.
std::string shown(double value, double scale, const char* unit) {
  return number_text(value * scale) + (std::isnan(value) ? "" : unit);
}

/// "0.885 (0.913)": of same features, and in brackets with neighbouring features.
std::string both(double same, double neighbours) {
  return fmt::format("{} ({})", share_text(same, 1.0), share_text(neighbours, 1.0));
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
                         m.true_jump_frames == m.frames_in_contact ? "" : " of frames with a true force"),
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
  std::string text = fmt::format(
      "{} (hash {}){}\n", m.label, m.result_hash,
      closed_loop ? fmt::format("; its device was in contact in {} frames", shown(m.frames_in_contact, 1, ""))
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
              : "  error  not measured: no frame is compared with truth, so the times below stand without "
                "what they bought\n";
  text += fmt::format("  time   local update {} median, {} 99 % of the frames in contact",
                      shown(m.local_update_median_s, 1e6, " us"), shown(m.local_update_p99_s, 1e6, " us"));
  if (!std::isnan(m.global_search_median_s))
    text += fmt::format("; global search {}, first reduction {}, second tracking {} (medians in contact)",
                        shown(m.global_search_median_s, 1e6, " us"),
                        shown(m.first_reduction_median_s, 1e6, " us"),
                        shown(m.second_tracking_median_s, 1e6, " us"));
  return text + "\n";
}

/// Numbers that differ between profiles, with their column and unit in the table.
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

/// One line for each method and profile, then the profile's changes.
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

/// Three digits in a fitting unit.
std::string duration(double seconds) {
  constexpr std::array<std::pair<double, const char*>, 4> UNITS{
      {{1.0, " s"}, {1e3, " ms"}, {1e6, " us"}, {1e9, " ns"}}};
  const auto unit = std::ranges::find_if(
      UNITS, [&](const auto& u) { return seconds * u.first >= 0.9995 || u.first == 1e9; });
  return shown(seconds, unit->first, unit->second);
}

/// In a closed loop every device goes its own way, and meets the mesh less often; profiles may have
/// cutoffs of their own.
const char* whose_contact(const RunSummary& summary) {
  if (summary.closed_loop) return " on the path that the hand means";
  return summary.profiles.empty() ? "" : " of the first profile";
}

}  // namespace

std::string NearestError::text() const {
  return fmt::format(
      "{} promises the complete set, but its nearest distance in frame {} is {:.6g} m, FCL's {:.6g} m, that "
      "of the exact search {:.6g} "
      "m; wrong in {} of the cross-checked frames (--verbose: poses)",
      label, first.frame, first.distance, first.fcl_distance, first.lmdbench_distance, frames);
}

std::string summary_verdicts(const RunSummary& summary) {
  std::string text;
  for (const std::string& warning : summary.warnings) text += "note: " + warning + "\n";
  for (const NearestError& error : summary.nearest_errors) text += "ERROR: " + error.text() + "\n";
  for (const std::string& limit : summary.broken_limits) text += "limit broken: " + limit + "\n";
  return text;
}

std::string summary_table(const RunSummary& summary) {
  std::vector<std::array<std::string, 6>> rows{
      {"method", "recall", "force error, RMS", "time a frame", "99 %", "frames above 1 ms"}};
  for (const MethodSummary& m : summary.methods)
    rows.push_back({m.label, std::isnan(m.recall) ? "-" : share_text(m.recall, 100.0) + " %",
                    shown(m.force_error_rms_n, 1, " N"), duration(m.frame_time_median_s),
                    duration(m.frame_time_p99_s), shown(m.frames_late, 1, "")});
  std::string text =
      fmt::format("{}: {} frames, {} in contact{}; {}\n", summary.name, summary.frames,
                  summary.frames_in_contact, whose_contact(summary),
                  summary.frames_probed > 0 ? fmt::format("{} compared with truth", summary.frames_probed)
                                            : "errors are not measured, no frame is compared with truth");
  for (const auto& row : rows) {
    for (std::size_t column = 0; column < row.size(); ++column) {
      std::size_t width = 0;
      for (const auto& other : rows) width = std::max(width, other[column].size());
      text += column == 0 ? fmt::format("{:<{}}", row[column], width)
                          : fmt::format("  {:>{}}", row[column], width);
    }
    text += "\n";
  }
  return text + summary_verdicts(summary);
}

std::string summary_text(const RunSummary& summary) {
  std::string text =
      fmt::format("{}: {} frames, {} in contact (within the cutoff of {:.4g} mm{}), {} against truth{}, {}\n",
                  summary.name, summary.frames, summary.frames_in_contact, summary.cutoff_m * 1e3,
                  whose_contact(summary), summary.frames_probed,
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
  return text + defaults_text(summary.defaults) + summary_verdicts(summary);
}

}  // namespace lmdbench
