// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/progress.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/motion/grazing.h>
#include <lmdbench/prepare/driver_input.h>
#include <lmdbench/prepare/scene_frames.h>
#include <lmdbench/result_file/provenance.h>
#include <lmdbench/shape/flatten.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// A mesh of the scene with what is worth knowing of it when one reads the result.
struct MeshNote {
  std::string role;  ///< "moving", "fixed_0", ..., "mover_0", ...
  std::string name;
  std::optional<std::filesystem::path> file;  ///< What was read; nothing for a generated shape.
  std::int64_t size = 0;                      ///< Bytes of that file
  std::string sha256;  ///< Of that file, or of the file that a generated shape would be built to.
  ValidityReport report;
  FlatteningReport flattening;  ///< In metres of the scene.
  OrientationReport orientation;
  std::vector<Pose> instances;        ///< X_WF of each; empty for a mesh that is in the world frame.
  std::int64_t first_fixed_body = 0;  ///< `Lmd::fixed_body` of the first of a fixed mesh.
  std::shared_ptr<const FrameVertices> vertices = nullptr;  ///< Of a mesh that deforms, frame by frame.
  std::int64_t first_mover = 0;  ///< Number of the first mover of an entry of `/movers`, and ...
  std::int64_t movers = 0;       ///< ... how many it has; 0 of other meshes.
  std::shared_ptr<const Body> body = nullptr;  ///< At rest.
};

/// A force profile with the scene that it reaches into: the meshes under its cutoff, which all profiles share.
struct PreparedProfile {
  std::string name;    ///< Empty for one alone.
  ForceProfile force;  ///< Its law is each method's own.
  Scene scene;
  const Aggregation* aggregation = &sum_law();
};

/// How the bodies of a loaded scene deform in so many frames; null where none does.
/// @param notes of `load_scene` and `load_movers`
std::shared_ptr<const SceneDeformation> deformation_of(const std::vector<MeshNote>& notes,
                                                       std::int64_t frames);

/// What who prepares a run makes of meshes that deform, and of several that move.
enum class Deforming : std::uint8_t {
  REFUSED,  ///< Looks at one moving mesh and at meshes at rest alone: an error where one deforms, or another moves.
  FOLLOWED  ///< Takes each frame at its shape and its poses (DriverInput::motion).
};

/// An experiment's inputs, loaded: all that a run works on.
struct PreparedRun {
  std::vector<PreparedProfile> profiles;  ///< The experiment's, at least one.
  DriverInput input;
  std::vector<double> times;  ///< Of the frames, from the start of the path [s].
  std::vector<MeshNote> meshes;
  std::vector<InputFile> files;         ///< For the provenance.
  bool starts_touching = false;         ///< Triangles touch in the first frame.
  std::vector<std::string> warnings;    ///< What was done to the meshes and flaws that methods can live with.
  std::vector<RecordingGap> path_gaps;  ///< Intervals of the path in which the mesh is held.
  std::optional<GrazingPath> made_path;  ///< Where the experiment names no path.
  std::vector<DefaultNote> defaults;     ///< What the file leaves open, with the values of this scene.

  /// The meshes under the first profile's cutoff.
  const Scene& scene() const { return profiles.front().scene; }
};

/// The meshes of the scene at their places; the cutoff is left to the caller.
/// @param notes receives one a mesh, the moving one first; movers are left to `load_movers`
/// @throws InputError for a mesh that cannot be used
Scene load_scene(const Experiment& experiment, std::vector<MeshNote>& notes);

/// Loads meshes and path; makes a path where the experiment names none. Open and non-manifold meshes and a start
/// in contact are noted, not refused.
/// @param progress of making a path; may stop it by returning false, which throws Interrupted
/// @throws InputError for a mesh or path that cannot be used, UsageError for a profile that does not
///         fit the mesh, and for meshes that deform where they are refused
PreparedRun prepare(const Experiment& experiment, const Progress& progress = {},
                    Deforming deforming = Deforming::REFUSED);

/// Lets all but the moving mesh stay where it is in the first frame, in the shape that it has there.
void hold_first_frame(PreparedRun& prepared);

/// Files that the experiment will read, as far as its text tells: itself, path, manifest, meshes; some may be
/// missing. For outputs, which must replace none of them.
std::vector<std::filesystem::path> input_files(const Experiment& experiment);

/// The experiment's methods on the prepared scene.
std::vector<DrivenMethod> driven_methods(const Experiment& experiment, const PreparedRun& prepared);

}  // namespace lmdbench
