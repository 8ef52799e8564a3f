// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic_result.h"

#include <lmdbench/result_file/provenance.h>
#include <lmdbench/result_file/result_writer.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace lmdbench::testing {
namespace {

constexpr int FRAMES = 10;
constexpr int SEARCHES = 2;
constexpr double MICROSECOND = 1e-6;

void write_real(ResultWriter& writer, const std::string& path, const std::vector<double>& values,
                const std::vector<std::size_t>& shape, const std::string& units = "1") {
  writer.write({path, units, "test data"}, values, shape);
}

void write_integers(ResultWriter& writer, const std::string& path, const std::vector<std::int64_t>& values) {
  writer.write({path, "1", "test data"}, values, {values.size()});
}

std::vector<std::int64_t> lmd_counts(const SyntheticResult& result, const std::string& method) {
  std::vector<std::int64_t> counts;
  for (int f = 0; f < FRAMES; ++f)
    counts.push_back(2 + f % 3 - (method == "certified" && f == result.frame_with_lost_lmd ? 1 : 0));
  return counts;
}

void write_lists(ResultWriter& writer, const SyntheticResult& result, const std::string& method) {
  const std::string group = "/methods/" + method + "/lmds";
  std::vector<std::int64_t> offsets{0};
  std::vector<double> distances;
  const std::vector<std::int64_t> counts = lmd_counts(result, method);
  for (int f = 0; f < FRAMES; ++f) {
    for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(f)]; ++i)
      distances.push_back(0.001 * f + 0.0001 * static_cast<double>(i));
    offsets.push_back(static_cast<std::int64_t>(distances.size()));
  }
  write_integers(writer, group + "/frame_offset", offsets);
  write_real(writer, group + "/distance", distances, {distances.size()}, "m");
}

/// Two polylines of two points in frames 3 and 6, none in 0 and 9.
void write_polylines(ResultWriter& writer, const SyntheticResult& result, const std::string& method) {
  const std::string group = "/methods/" + method + "/polylines";
  write_integers(writer, group + "/frame", {0, 3, 6, 9});
  write_integers(writer, group + "/frame_offset", {0, 0, 2, 4, 4});
  write_integers(writer, group + "/point_offset", {0, 2, 4, 6, 8});
  std::vector<double> lengths(4, 0.5), points(24, 0.25);
  if (result.other_polyline >= 0) {
    lengths[static_cast<std::size_t>(result.other_polyline)] = 1.0;
    points[6 * static_cast<std::size_t>(result.other_polyline) + 5] = 1.0;
  }
  write_real(writer, group + "/length", lengths, {4}, "m");
  write_real(writer, group + "/point", points, {8, 3}, "m");
}

/// (repetition, column) times, all equal except for the warm-up and the spike.
void write_times(ResultWriter& writer, const SyntheticResult& result, const std::string& path, double seconds,
                 int columns, const std::string& stage) {
  if (!result.times) return;
  const auto found = result.slowdown.find(stage);
  const double factor = result.process_factor * (found == result.slowdown.end() ? 1.0 : found->second);
  std::vector<double> times;
  for (int r = 0; r < result.repetitions; ++r) {
    for (int c = 0; c < columns; ++c) {
      double time = seconds * factor * (r == 0 ? 5.0 : 1.0) + (c == 0 ? result.jitter : 0.0);
      if (r == 1 && c == result.spike_frame) time += 1e-3;
      if (stage == result.lost_times) time = std::numeric_limits<double>::quiet_NaN();
      times.push_back(time);
    }
  }
  write_real(writer, path, times,
             {static_cast<std::size_t>(result.repetitions), static_cast<std::size_t>(columns)}, "s");
}

void write_method(ResultWriter& writer, const SyntheticResult& result, const std::string& method) {
  const std::string group = "/methods/" + method;
  const bool searches = method == "original";
  writer.attribute(group, "method_order", std::int64_t{searches ? 0 : 1});
  std::vector<double> force, distance;
  for (int f = 0; f < FRAMES; ++f) {
    double z = 0.1 * (f + 1);
    if (searches && f == result.frame_with_other_force) z = std::nextafter(z, 1.0);
    force.insert(force.end(), {0.0, -0.5, z});
    distance.push_back(f == 3 ? std::numeric_limits<double>::quiet_NaN() : 0.001 * f);
  }
  write_real(writer, group + "/force", force, {FRAMES, 3}, "N");
  write_real(writer, group + "/minimum_distance", distance, {FRAMES}, "m");
  write_integers(writer, group + "/lmd_count", lmd_counts(result, method));
  std::vector<std::int64_t> node_pairs, per_search, global_frame;
  for (int f = 0; f < FRAMES; ++f) node_pairs.push_back(100 + f);
  for (int s = 0; s < SEARCHES; ++s) {
    global_frame.push_back(5 * s);
    per_search.push_back(1000 + (s == result.search_with_more_work ? 100 : 0));
  }
  if (result.counters) {
    write_integers(writer, group + "/counters/node_pairs", node_pairs);
    write_integers(writer, group + "/counters/leaf_pairs", node_pairs);
  }
  if (!result.extra_counter.empty() && !searches)
    write_integers(writer, group + "/counters/" + result.extra_counter, node_pairs);
  if (!result.idle_counter.empty() && !searches)
    write_integers(writer, group + "/counters/" + result.idle_counter, std::vector<std::int64_t>(FRAMES, 0));
  write_times(writer, result, group + "/local_update_time", 2 * MICROSECOND, FRAMES,
              method + "/local update");
  if (searches) {
    write_integers(writer, group + "/global_frame", global_frame);
    if (result.counters) write_integers(writer, group + "/global_counters/node_pairs", per_search);
    write_times(writer, result, group + "/global_search_time", 50 * MICROSECOND, SEARCHES,
                method + "/search");
    write_real(writer, group + "/first_reduction_time",
               std::vector<double>(static_cast<std::size_t>(result.repetitions) * SEARCHES,
                                   std::numeric_limits<double>::quiet_NaN()),
               {static_cast<std::size_t>(result.repetitions), SEARCHES}, "s");
  }
  write_real(writer, group + "/summary/local_update_median_s", {result.process_factor}, {1}, "s");
  write_real(writer, group + "/summary/force_error_p99_n", {result.summary}, {1}, "N");
  write_real(writer, group + "/summary/true_jumps", {result.true_jumps}, {1}, "1");
  if (result.lists) write_lists(writer, result, method);
  if (result.polylines) write_polylines(writer, result, method);
  const bool changed = searches ? result.frame_with_other_force >= 0 : result.frame_with_lost_lmd >= 0;
  writer.attribute(group, "result_hash", std::string(changed ? "changed" : "hash"));
}

nlohmann::json experiment_of(const SyntheticResult& result) {
  nlohmann::json experiment{{"name", "synthetic"},
                            {"moving", nlohmann::json::parse(result.moving)},
                            {"path", {{"file", "path.tum"}}},
                            {"force", {{"cutoff_m", result.cutoff}}},
                            {"driver", {{"repetitions", result.repetitions}}},
                            {"record", nlohmann::json::parse(result.record)},
                            {"methods", nlohmann::json::array()}};
  for (const std::string& method : result.methods)
    experiment["methods"].push_back({{"name", method}, {"label", method}});
  experiment.merge_patch(nlohmann::json::parse(result.patch));
  return experiment;
}

}  // namespace

std::filesystem::path SyntheticResult::write(const std::filesystem::path& file) const {
  ResultWriter writer(file);
  writer.attribute("/", "format", RESULT_FORMAT);
  writer.attribute("/", "format_version", std::int64_t{RESULT_FORMAT_VERSION});
  writer.attribute("/provenance/machine", "processor", processor);
  writer.attribute("/provenance", "compiler", "GNU 12");
  writer.write({"/provenance/experiment", "1", "experiment"}, {experiment_of(*this).dump()});
  std::vector<std::string> roles{"path", "mesh:" + mesh}, hashes{"ff", moving_hash};
  if (!vertices_hash.empty()) {
    roles.emplace_back("vertices:moving");
    hashes.push_back(vertices_hash);
  }
  writer.write({"/provenance/inputs/role", "1", "role"}, roles);
  writer.write({"/provenance/inputs/sha256", "1", "hash"}, hashes);
  writer.attribute("/scene", "cutoff_m", scene_cutoff > 0.0 ? scene_cutoff : cutoff);
  writer.attribute("/summary", "truth_of_every_frame", truth_of_every_frame);
  if (sweep) writer.attribute("/sweep", "name", std::string("budget"));
  writer.attribute("/methods", "warm_up_repetitions", std::int64_t{warm_up});
  std::vector<double> time;
  for (int f = 0; f < FRAMES; ++f) time.push_back(0.001 * f);
  write_real(writer, "/path/time", time, {FRAMES}, "s");
  for (const std::string& method : methods) write_method(writer, *this, method);
  for (const auto& [path, values] : more) write_integers(writer, path, values);
  writer.commit();
  return file;
}

}  // namespace lmdbench::testing
