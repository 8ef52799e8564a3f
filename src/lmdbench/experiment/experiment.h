// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/acceptance.h>
#include <lmdbench/experiment/defaults.h>
#include <lmdbench/experiment/instance_choice.h>
#include <lmdbench/experiment/loop_choice.h>
#include <lmdbench/experiment/mesh_deformation.h>
#include <lmdbench/experiment/probe.h>
#include <lmdbench/experiment/realtime_choice.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/force/force_law.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/orientation_choice.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/motion/sway.h>
#include <lmdbench/shape/planar_tolerance.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// An experiment file after checking, with every default filled in (schema: experiments/schema).
namespace lmdbench {

struct Aggregation;
const Aggregation& sum_law();

/// A mesh of the scene.
struct MeshChoice {
  std::string mesh;                  ///< Name in the manifest, generated shape or file.
  Placement placement;               ///< In its own frame.
  Pose pose;                         ///< X_WF of a fixed mesh; identity for the moving one.
  PlanarTolerance planar_tolerance;  ///< Of rounded planes, see flatten.h; a length is in the scene's metres.
  OrientationChoice orientation = OrientationChoice::KEEP;  ///< Which side is outside.
  /// Of a fixed mesh: how many of it stand where, about `pose`. The mesh then stays in its own frame.
  std::optional<InstanceChoice> instances;
  std::optional<MeshDeformation> deformation;  ///< Unset: the mesh is rigid.
};

/// An entry of `/movers`: a mesh that moves beside the moving one, or several instances of it.
struct MoverChoice {
  std::string place;  ///< JSON pointer of the entry.
  MeshChoice mesh;    ///< Stays in its own frame; its pose and instances are where its paths are.
  std::filesystem::path path_file;  ///< Empty: it sways.
  Interpolation interpolation = Interpolation::CUBIC;
  double gap_intervals = 0.0;
  Sway sway;
};

/// Constants of the force profile (decision E8: the paper states none of them). Some are relative to the
/// moving mesh, so the profile exists only once that mesh is loaded.
struct ForceChoice {
  std::string name;                         ///< Of a profile among several; empty for one alone.
  std::optional<double> cutoff_m;           ///< At most one of the two cutoffs is set.
  std::optional<double> cutoff_diagonal;    ///< Share of the moving mesh's diagonal.
  std::optional<double> saturation_m;       ///< At most one of the two saturations is set.
  std::optional<double> saturation_cutoff;  ///< Share of the cutoff.
  double maximum_force_n = 0.0;
  double sharpness = 0.0;
  const Aggregation* aggregation = &sum_law();  ///< What becomes of a set of contacts.
  bool clip_at_maximum =
      false;  ///< The sum is clipped to F_max of one LMD, where that is below the device's limit.

  /// Cutoff [m] for a moving mesh of the given bounding-box diagonal [m]; unset where the scene decides
  /// (`default_cutoff`).
  std::optional<double> cutoff(double moving_diagonal) const;
  /// Saturation distance [m]; 0 where none is given.
  double saturation(double cutoff) const;
};

/// A method of the experiment. The same method may appear twice with other options under another label.
struct MethodChoice {
  std::string name;   ///< Name in the registry.
  std::string label;  ///< Unique; group of the result.
  std::string entry;  ///< Label of its entry in the file: `label` without the profile.
  ForceLaw force_law = ForceLaw::EXPONENTIAL;
  std::size_t profile = 0;  ///< Index in the experiment's profiles.
  /// The profile's, or the sum where the method does not find what that needs.
  const Aggregation* aggregation = &sum_law();
  nlohmann::json options = nlohmann::json::object();  ///< Every option of the method.
  std::string options_json;                           ///< The method's entry of the resolved experiment.

  /// Whether LMDs without an index are counted: of an aggregation that needs indices.
  bool counts_indices() const;
};

/// How searches and frames share the clock, see `drivers/lockstep.h`.
struct DriverChoice {
  std::int64_t search_every_frames = 0;
  std::int64_t search_latency_frames = 0;
  std::int64_t repetitions = 0;
  std::int64_t block_frames = 0;
  bool predict = false;  ///< Search where the mesh will be when the result arrives, see `two_rate.h`.
};

struct Experiment {
  std::filesystem::path file;  ///< For messages; relative names are relative to its folder.
  std::string name;
  std::string title;
  std::filesystem::path mesh_folder;  ///< Where the mesh manifest is.
  MeshChoice moving;
  std::vector<MeshChoice> fixed;
  std::vector<MoverChoice> movers;  ///< Beside `moving`; mostly none.
  std::filesystem::path path_file;  ///< Empty: the path is made for the scene (`grazing_path`).
  Interpolation interpolation = Interpolation::CUBIC;
  double gap_intervals = 0.0;  ///< See PathInterpolator.
  double frame_rate_hz = 0.0;
  std::optional<std::int64_t> frames;  ///< Run only this many frames from the start.
  std::vector<ForceChoice> profiles;   ///< At least one.
  /// With named profiles each method is there once a profile, under the label METHOD-PROFILE.
  std::vector<MethodChoice> methods;
  DriverChoice driver;
  std::optional<RealtimeChoice> realtime;  ///< Set: the driver is `realtime/`'s, not lockstep.
  std::string device;
  LoopChoice loop;
  std::map<std::string, ProbeChoice, std::less<>> probes;  ///< By name.
  bool record_frames = true;    ///< Every frame's and search's numbers, without counters and times.
  bool record_counters = true;  ///< Every frame's and search's work counters.
  bool record_timings = true;   ///< Every time of every repetition.
  bool record_lmds = false;
  bool record_torque = false;
  RuleSwitches rules{};
  Acceptance acceptance;
  /// Frames between two looks of a probe; 0: it is left out.
  std::int64_t probe_stride(std::string_view probe) const {
    const auto found = probes.find(probe);
    return found == probes.end() ? 0 : found->second.stride_frames;
  }
  /// Whether fixed meshes are instances (lmd/scene.h).
  bool is_world() const {
    return std::any_of(fixed.begin(), fixed.end(),
                       [](const MeshChoice& choice) { return choice.instances.has_value(); });
  }
  /// Whether the vertices of some mesh move.
  bool deforms() const {
    return moving.deformation.has_value() ||
           std::any_of(fixed.begin(), fixed.end(),
                       [](const MeshChoice& choice) { return choice.deformation.has_value(); }) ||
           std::any_of(movers.begin(), movers.end(),
                       [](const MoverChoice& mover) { return mover.mesh.deformation.has_value(); });
  }
  std::vector<DefaultNote> defaults;  ///< What the file leaves open and no mesh is needed for.
  std::vector<std::string> notes;     ///< What overrides replaced beside their own value.
  std::string resolved_json;          ///< The file with overrides and defaults, for the record.
};

/// One `--set /json/pointer=value`; the value is JSON, or else a string.
using Override = std::string;

/// Reads, overrides, checks and completes an experiment.
/// @throws UsageError naming the JSON pointer at fault: not JSON, unknown or repeated key, wrong type,
///         value out of range, unknown method or option, options that contradict each other
/// @param also methods that run beside those that the file names
Experiment load_experiment(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                           const std::vector<std::string>& also = {});

/// The same from text; `file` serves messages and relative names.
Experiment parse_experiment(const std::string& text, const std::filesystem::path& file,
                            const std::vector<Override>& overrides = {},
                            const std::vector<std::string>& also = {});

/// @throws UsageError naming the place, where a mesh deforms: for what looks at meshes at rest alone
void refuse_deformation(const Experiment& experiment);

/// @throws UsageError naming the place, where there are movers beside the moving mesh: for what looks at one mesh that moves
void refuse_movers(const Experiment& experiment);

/// The JSON Schema (draft 07) of experiment files: experiments/schema/experiment.schema.json, with the names
/// and options of the methods of this build.
const nlohmann::json& experiment_schema();

}  // namespace lmdbench
