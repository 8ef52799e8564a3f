// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/progress.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/motion/grazing.h>
#include <lmdbench/prepare/driver_input.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/result_file/provenance.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// A force profile with the scene that it reaches into: the meshes under its cutoff, which all profiles share.
struct PreparedProfile {
  std::string name;    ///< Empty for one alone.
  ForceProfile force;  ///< Its law is each method's own.
  Scene scene;
  const Aggregation* aggregation = &sum_law();
};

/// What who prepares a run makes of meshes that deform, and of several that move.
enum class Deforming : std::uint8_t {
  REFUSED,  ///< Looks at one moving mesh and at meshes at rest alone: an error where one deforms, or another moves.
  FOLLOWED  ///< Takes each frame at its shape and its poses (DriverInput::motion).
};

/// An experiment's inputs, loaded: all that a run works on.
struct PreparedRun {
  std::vector<PreparedProfile> profiles;  ///< The experiment's, at least one.
  DriverInput input;
  std::vector<double> times = {};     ///< Of the frames, from the start of the path [s].
  std::vector<MeshNote> meshes = {};  ///< One an object.
  std::vector<InputFile> files = {};  ///< For the provenance.
  bool starts_touching = false;       ///< Triangles touch in the first frame.
  std::vector<std::string> warnings =
      {};  ///< What was done to the meshes and flaws that methods can live with.
  std::vector<RecordingGap> path_gaps = {};   ///< Intervals of the path in which the mesh is held.
  std::optional<GrazingPath> made_path = {};  ///< Where the experiment names no path.
  std::vector<DefaultNote> defaults = {};     ///< What the file leaves open, with the values of this scene.

  /// The meshes under the first profile's cutoff.
  const Scene& scene() const { return profiles.front().scene; }
};

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
