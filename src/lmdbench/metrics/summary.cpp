// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/metrics/broken_limits.h>
#include <lmdbench/metrics/errors.h>
#include <lmdbench/metrics/summary.h>
#include <lmdbench/metrics/times.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace lmdbench {
namespace {

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

/// Every method under a later profile against itself under the first. Methods go by profile.
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
    const RunFrames frames{track.in_contact, experiment.frame_rate_hz, profile.force.maximum_force,
                           contact_ports(result.prepared.input)};
    summarise_counts(method, record, frames);
    summarise_rendering(method, record, frames);
    summarise_jumps(method, record, frames);
    if (const TruthFindings* truth = track.truth()) {
      summarise_errors(method, experiment.methods[i].force_law, truth->frames, result.comparisons(i), frames);
      if (method_description(experiment.methods[i].name).promise == Promise::FORCE_ONLY)
        method.frames_wrong = UNSET;
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
