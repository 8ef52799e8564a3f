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

/// How an object moves.
enum class MotionKind : std::uint8_t {
  HELD,    ///< Held by the device: the first object, along the run's path.
  STANDS,  ///< At its pose.
  PATH,    ///< Along a path of its own.
  SWAYS    ///< To and fro about its pose.
};
/// "held", "stands", "path", "sways".
std::string_view to_string(MotionKind kind);

struct ObjectMotion {
  MotionKind kind = MotionKind::STANDS;
  /// Of a path; empty for the held object: its path is made for the scene (`grazing_path`).
  std::filesystem::path path_file;
  std::string path_place = "/path/file";  ///< JSON pointer of that.
  Interpolation interpolation = Interpolation::CUBIC;
  double gap_intervals = 0.0;  ///< See PathInterpolator.
  Sway sway;
};

/// A mesh of the scene with its motion, or several instances of it. A moving one stays in its own
/// frame; pose and instances are where its path or sway is.
struct ObjectChoice {
  std::string name;  ///< The user's, else the role.
  /// In the result's groups: "moving" (held), "fixed_0", ... (standing), "mover_0", ... (moving).
  std::string role;
  std::string place;                 ///< JSON pointer of the entry.
  std::string mesh;                  ///< Name in the manifest, generated shape or file.
  Placement placement;               ///< In its own frame.
  Pose pose;                         ///< Identity for the held one.
  PlanarTolerance planar_tolerance;  ///< Of rounded planes, see flatten.h; in the scene's metres.
  OrientationChoice orientation = OrientationChoice::KEEP;  ///< Which side is outside.
  /// Unset: one, at `pose`. Else their poses, relative to `pose`; the mesh stays in its own frame.
  std::optional<InstanceChoice> instances;
  std::optional<MeshDeformation> deformation;  ///< Unset: the mesh is rigid.
  ObjectMotion motion;

  bool stands() const { return motion.kind == MotionKind::STANDS; }
};

/// The objects of an experiment, the held one first, from either set of keys: `objects`, or
/// `moving`, `fixed` and `movers`.
/// @param document checked and with its defaults
/// @throws UsageError naming the place in the file
std::vector<ObjectChoice> read_objects(const nlohmann::json& document, const std::filesystem::path& file);

/// Checks the scene's keys beyond what the schema can say; called before its check.
/// @throws UsageError where they are missing, or the held object has two paths
void check_scene_keys(const nlohmann::json& document, const std::string& file);

/// Constants of the force profile (decision E8: the paper states none of them). Some are relative
/// to the moving mesh, so the profile exists only once that mesh is loaded.
struct ForceChoice {
  std::string name;                         ///< Of one among several; else empty.
  std::optional<double> cutoff_m;           ///< At most one of the two cutoffs is set.
  std::optional<double> cutoff_diagonal;    ///< Share of the moving mesh's diagonal.
  std::optional<double> saturation_m;       ///< At most one of the two saturations is set.
  std::optional<double> saturation_cutoff;  ///< Share of the cutoff.
  double maximum_force_n = 0.0;
  double sharpness = 0.0;
  const Aggregation* aggregation = &sum_law();  ///< How a contact set combines.
  /// Whether the sum is clipped to F_max of one LMD, where that is below the device's limit.
  bool clip_at_maximum = false;

  /// Cutoff [m] for a moving mesh of this bounding-box diagonal [m]; unset where the scene decides
  /// (`default_cutoff`).
  std::optional<double> cutoff(double moving_diagonal) const;
  /// Saturation distance [m]; 0 where none is given.
  double saturation(double cutoff) const;
};

/// A method of the experiment. A method may appear again with other options and another label.
struct MethodChoice {
  std::string name;   ///< Name in the registry.
  std::string label;  ///< Unique; group of the result.
  std::string entry;  ///< Label of its entry in the file: `label` without the profile.
  ForceLaw force_law = ForceLaw::EXPONENTIAL;
  std::size_t profile = 0;  ///< Index in the experiment's profiles.
  /// The profile's, or the sum where the method does not provide what the profile's needs.
  const Aggregation* aggregation = &sum_law();
  nlohmann::json options = nlohmann::json::object();  ///< Every option of the method.
  std::string options_json;                           ///< Its entry of the resolved experiment.

  /// Whether to count LMDs without an index: for an aggregation that needs indices.
  bool counts_indices() const;
};

/// How searches and frames share the clock, see `drivers/lockstep.h`.
struct DriverChoice {
  std::int64_t search_every_frames = 0;
  std::int64_t search_latency_frames = 0;
  std::int64_t repetitions = 0;
  std::int64_t block_frames = 0;
  bool predict = false;  ///< Searches where the mesh will be on arrival, see `two_rate.h`.
};

struct Experiment {
  std::filesystem::path file;  ///< For messages; relative names are relative to its folder.
  std::string name;
  std::string title;
  std::filesystem::path mesh_folder;  ///< Where the mesh manifest is.
  std::vector<ObjectChoice> objects;  ///< At least two: the held one, and one that stands.
  double frame_rate_hz = 0.0;
  std::optional<std::int64_t> frames;  ///< Runs only this many frames from the start.
  std::vector<ForceChoice> profiles;   ///< At least one.
  /// With named profiles each method appears once a profile, labelled METHOD-PROFILE.
  std::vector<MethodChoice> methods;
  DriverChoice driver;
  std::optional<RealtimeChoice> realtime;  ///< Set: the driver is `realtime/`'s, not lockstep.
  std::string device;
  LoopChoice loop;
  std::map<std::string, ProbeChoice, std::less<>> probes;  ///< By name.
  bool record_frames = true;    ///< Numbers of all frames and searches, without counters and times.
  bool record_counters = true;  ///< Work counters of every frame and search.
  bool record_timings = true;   ///< Every time of every repetition.
  bool record_lmds = false;
  bool record_torque = false;
  RuleSwitches rules{};
  Acceptance acceptance;
  /// Frames between two looks of a probe; 0: the probe is off.
  std::int64_t probe_stride(std::string_view probe) const {
    const auto found = probes.find(probe);
    return found == probes.end() ? 0 : found->second.stride_frames;
  }
  /// The object held by the device: paths, figures and numbers of one force are about it.
  const ObjectChoice& held() const { return objects.front(); }
  /// Whether more than the held object moves.
  bool several_move() const {
    return std::ranges::any_of(
        objects, [this](const ObjectChoice& object) { return &object != &held() && !object.stands(); });
  }
  /// Whether the standing objects are instances (lmd/scene.h).
  bool is_world() const {
    return std::ranges::any_of(
        objects, [](const ObjectChoice& object) { return object.stands() && object.instances.has_value(); });
  }
  /// Whether the vertices of some mesh move.
  bool deforms() const {
    return std::ranges::any_of(objects,
                               [](const ObjectChoice& object) { return object.deformation.has_value(); });
  }
  std::vector<DefaultNote> defaults;  ///< Defaults that need no mesh.
  std::vector<std::string> notes;     ///< Values that overrides changed as a consequence.
  std::string resolved_json;          ///< The file with overrides and defaults, for the record.
};

/// One `--set /json/pointer=value`; the value is JSON, or else a string.
using Override = std::string;

/// Reads, overrides, checks and completes an experiment.
/// @throws UsageError naming the JSON pointer at fault: not JSON, unknown or repeated key, wrong
///         type, value out of range, unknown method or option, contradicting options
/// @param also methods to run in addition to those of the file
Experiment load_experiment(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                           const std::vector<std::string>& also = {});

/// The same from text; `file` serves messages and relative names.
Experiment parse_experiment(const std::string& text, const std::filesystem::path& file,
                            const std::vector<Override>& overrides = {},
                            const std::vector<std::string>& also = {});

/// @throws UsageError naming a mesh that deforms: for callers that need meshes at rest
void refuse_deformation(const Experiment& experiment);

/// @throws UsageError naming a second moving object: for callers that need one moving mesh
void refuse_movers(const Experiment& experiment);

/// The JSON Schema (draft 07) of experiment files: experiments/schema/experiment.schema.json, with
/// the names and options of this build's methods.
const nlohmann::json& experiment_schema();

}  // namespace lmdbench
