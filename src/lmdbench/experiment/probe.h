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

/// Probes look at frames of a run, on a stride and outside the timed ones. What the rest of the program knows of one is its
/// description: schema, checks, plan and result are made from it. A probe is run/NAME_probe.cpp and a word in run/CMakeLists.txt.
namespace lmdbench {

struct DatasetInfo;
struct Experiment;
struct ProbedTrack;
class ResultWriter;

/// What a probe found along a track, in a type of its own (probes/probed_track.h).
struct ProbeFindings {
  ProbeFindings() = default;
  ProbeFindings(const ProbeFindings&) = delete;
  ProbeFindings& operator=(const ProbeFindings&) = delete;
  virtual ~ProbeFindings() = default;

  /// What a reader of the result must know, in plain words.
  /// @param group of the track in the file: empty, or that of a method
  virtual std::vector<std::string> notes(const std::string& /*group*/) const { return {}; }
};

/// A dataset of findings, as the row of results/README.md has it.
struct ProbeDataset {
  std::string
      path;  ///< From a slash on one a track ("/polylines/frame"), else one in the group of each method ("truth/frame").
  std::string shape;  ///< Of the axes: "E, 3".
  std::string units;
  std::string long_name;
  /// @param method which of the track's methods; for one a track without meaning
  std::function<void(ResultWriter&, const DatasetInfo&, const ProbeFindings&, std::size_t method)> write;
};

/// What a user asks of a probe.
struct ProbeChoice {
  std::int64_t stride_frames = 0;                     ///< 0: it is left out.
  nlohmann::json options = nlohmann::json::object();  ///< All of them.
};

struct Probe {
  std::string name;                ///< Of its options in the file and of its phase of a run.
  std::string title;               ///< In the plan.
  std::string parent;              ///< JSON pointer of what its options are in: "/probes" or "/record".
  std::int64_t stride_frames = 0;  ///< Default.
  /// Default of a file without path and probes: a first look at two meshes.
  std::int64_t first_stride_frames = 0;
  std::string stride_text;  ///< Describes the option `stride_frames`.
  /// The others, as "properties" of a draft-07 JSON Schema, each with a default.
  nlohmann::json options = nlohmann::json::object();
  bool reads_lmds = false;  ///< Whether it needs the sets that the methods had in its frames.
  std::string attributes =
      {};  ///< Group of a track whose attributes the options, numbers, are; empty for none.
  std::vector<ProbeDataset> datasets;

  std::string (*why)(const ProbeChoice& choice);  ///< What it does, for the plan.
  std::string left_out;                           ///< What its absence means.
  /// @throws UsageError at `place` for a scene that it cannot look at, EnvironmentError for a build that lacks what it needs
  void (*refuse)(const Experiment& experiment, const std::string& file, const std::string& place) = nullptr;
  /// Null where there is no frame to look at and so nothing to say.
  std::unique_ptr<ProbeFindings> (*run)(const ProbedTrack& track) = nullptr;
};

/// In the order of plans and runs. They stand in run/, whose library defines this.
const std::vector<Probe>& probes();

/// Adds their options to the schema of experiments.
void add_probe_schemas(nlohmann::json& schema);

/// @param document an experiment with its defaults
/// @throws as Probe::refuse
void read_probes(Experiment& experiment, const nlohmann::json& document);

/// Frames that a probe looks at: the multiples of the stride from `first` on, as long as the next frame exists. Empty for stride 0.
std::vector<std::int64_t> probed_frames(std::int64_t frame_count, std::int64_t stride,
                                        std::int64_t first = 0);

/// The same as an experiment asks; for a probe that reads sets from the first frame on in which a search can have arrived: no
/// method on the two-rate clock can know anything before.
std::vector<std::int64_t> probed_frames(const Experiment& experiment, std::string_view name,
                                        std::size_t frame_count);

}  // namespace lmdbench
