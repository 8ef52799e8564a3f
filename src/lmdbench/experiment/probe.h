// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// Probes look at frames of a run, on a stride and outside the timed ones. Their descriptions make
/// schema, checks, plan and result. A new one: probes/NAME_probe.cpp, and a word in CMakeLists.txt.
namespace lmdbench {

struct DatasetInfo;
struct Experiment;
struct ProbedTrack;
class ResultWriter;

/// Findings of a probe along a track, in a type of its own (probes/probed_track.h).
struct ProbeFindings {
  ProbeFindings() = default;
  ProbeFindings(const ProbeFindings&) = delete;
  ProbeFindings& operator=(const ProbeFindings&) = delete;
  virtual ~ProbeFindings() = default;

  /// Facts that a reader of the result must know, in plain words.
  /// @param group of the track in the file: empty, or a method's
  virtual std::vector<std::string> notes(const std::string& /*group*/) const { return {}; }
};

/// A dataset of findings, with the fields of its row in results/README.md.
struct ProbeDataset {
  /// With a leading slash one a track ("/polylines/frame"), else one a method ("truth/frame").
  std::string path;
  std::string shape;  ///< Of the axes: "E, 3".
  std::string units;
  std::string long_name;
  /// @param method index among the track's methods; unused for a dataset of the track
  std::function<void(ResultWriter&, const DatasetInfo&, const ProbeFindings&, std::size_t method)> write;
};

/// A user's settings of a probe.
struct ProbeChoice {
  std::int64_t stride_frames = 0;                     ///< 0: the probe is off.
  nlohmann::json options = nlohmann::json::object();  ///< All of them.
};

struct Probe {
  std::string name;                ///< Key of its options, and name of its phase of a run.
  std::string title;               ///< In the plan.
  std::string parent;              ///< JSON pointer above its options: "/probes", "/record".
  std::int64_t stride_frames = 0;  ///< Default.
  /// Default for a file without path and probes, which is a first look at two meshes.
  std::int64_t first_stride_frames = 0;
  std::string stride_text;  ///< Describes the option `stride_frames`.
  /// Other options: "properties" of a draft-07 JSON Schema, each with a default.
  nlohmann::json options = nlohmann::json::object();
  bool reads_lmds = false;  ///< Whether it needs the methods' sets of its frames.
  /// Group of a track that has the (numeric) options as attributes; empty for none.
  std::string attributes = {};
  std::vector<ProbeDataset> datasets;

  std::string (*why)(const ProbeChoice& choice);  ///< What it does, for the plan.
  std::string left_out;                           ///< Consequence of its absence.
  /// @throws UsageError at `place` for an unfit scene, EnvironmentError for an unfit build
  void (*refuse)(const Experiment& experiment, const std::string& file, const std::string& place) = nullptr;
  /// Null where there is no frame to look at.
  std::unique_ptr<ProbeFindings> (*run)(const ProbedTrack& track) = nullptr;
};

/// In the order of plans and runs. The library of probes/ defines this.
const std::vector<Probe>& probes();

/// Adds their options to the schema of experiments.
void add_probe_schemas(nlohmann::json& schema);

/// @param document an experiment with its defaults
/// @throws as Probe::refuse
void read_probes(Experiment& experiment, const nlohmann::json& document);

/// Frames of a probe: multiples of the stride from `first` on that have a next frame; none for 0.
std::vector<std::int64_t> probed_frames(std::int64_t frame_count, std::int64_t stride,
                                        std::int64_t first = 0);

/// The same by an experiment's stride. A probe that reads sets begins with the first frame in which
/// a search can have arrived: before it no method on the two-rate clock has any.
std::vector<std::int64_t> probed_frames(const Experiment& experiment, std::string_view name,
                                        std::size_t frame_count);

}  // namespace lmdbench
