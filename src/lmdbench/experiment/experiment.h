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
  HELD,    ///< By the device: the first object, along the path of the run.
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

/// A mesh of the scene with its motion, or several instances of it. One that moves stays in its own frame; its pose and instances are
/// where its path or sway is.
struct ObjectChoice {
  std::string name;  ///< Of the user, else the role.
  std::string
      role;  ///< "moving" the held one, "fixed_0", ... what stands, "mover_0", ... what else moves; of the result's groups.
  std::string place;                 ///< JSON pointer of the entry.
  std::string mesh;                  ///< Name in the manifest, generated shape or file.
  Placement placement;               ///< In its own frame.
  Pose pose;                         ///< Identity for the held one.
  PlanarTolerance planar_tolerance;  ///< Of rounded planes, see flatten.h; a length is in the scene's metres.
  OrientationChoice orientation = OrientationChoice::KEEP;  ///< Which side is outside.
  /// How many of it stand or move where, about `pose`. The mesh then stays in its own frame.
  std::optional<InstanceChoice> instances;
  std::optional<MeshDeformation> deformation;  ///< Unset: the mesh is rigid.
  ObjectMotion motion;

  bool stands() const { return motion.kind == MotionKind::STANDS; }
};

/// The objects of an experiment, whichever keys it has them under: `objects`, or `moving`, `fixed` and `movers`. The held one is the
/// first.
/// @param document checked and with its defaults
/// @throws UsageError naming the place in the file
std::vector<ObjectChoice> read_objects(const nlohmann::json& document, const std::filesystem::path& file);

/// What the schema cannot say of the keys that the scene is under; before its check.
/// @throws UsageError where they are missing, or the held object has two paths
void check_scene_keys(const nlohmann::json& document, const std::string& file);

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
  std::vector<ObjectChoice> objects;  ///< At least two: the held one, and one that stands.
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
  /// The object that the device holds, and that paths, figures and numbers of one force are about.
  const ObjectChoice& held() const { return objects.front(); }
  /// Whether something moves beside the held object.
  bool several_move() const {
    return std::ranges::any_of(
        objects, [this](const ObjectChoice& object) { return &object != &held() && !object.stands(); });
  }
  /// Whether what stands are instances (lmd/scene.h).
  bool is_world() const {
    return std::ranges::any_of(
        objects, [](const ObjectChoice& object) { return object.stands() && object.instances.has_value(); });
  }
  /// Whether the vertices of some mesh move.
  bool deforms() const {
    return std::ranges::any_of(objects,
                               [](const ObjectChoice& object) { return object.deformation.has_value(); });
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

/// @throws UsageError naming the place, where an object moves beside the held one: for what looks at one mesh that moves
void refuse_movers(const Experiment& experiment);

/// The JSON Schema (draft 07) of experiment files: experiments/schema/experiment.schema.json, with the names
/// and options of the methods of this build.
const nlohmann::json& experiment_schema();

}  // namespace lmdbench
