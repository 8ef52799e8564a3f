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

/// A force profile with its scene: the meshes under its cutoff. All profiles share the meshes.
struct PreparedProfile {
  std::string name;    ///< Empty for a single one.
  ForceProfile force;  ///< Its law is each method's own.
  Scene scene;
  const Aggregation* aggregation = &sum_law();
};

/// Treatment of deforming meshes and several movers by the caller of `prepare`.
enum class Deforming : std::uint8_t {
  REFUSED,  ///< For callers of one moving mesh at rest: an error otherwise.
  FOLLOWED  ///< Each frame has its shape and poses (DriverInput::motion).
};

/// An experiment's inputs, loaded: all that a run works on.
struct PreparedRun {
  std::vector<PreparedProfile> profiles;  ///< The experiment's, at least one.
  DriverInput input;
  std::vector<double> times = {};     ///< Of the frames, as the path counts them [s].
  std::vector<MeshNote> meshes = {};  ///< One an object.
  std::vector<InputFile> files = {};  ///< For the provenance.
  bool starts_touching = false;       ///< Triangles touch in the first frame.
  /// Changes of the meshes, and flaws that methods tolerate.
  std::vector<std::string> warnings = {};
  std::vector<RecordingGap> path_gaps = {};   ///< Intervals in which the pose is held.
  std::optional<GrazingPath> made_path = {};  ///< If the experiment names no path.
  std::vector<DefaultNote> defaults = {};     ///< Values that the file leaves open.

  /// The meshes under the first profile's cutoff.
  const Scene& scene() const { return profiles.front().scene; }
};

/// Loads meshes and path; makes a path where the experiment names none. Open and non-manifold
/// meshes and a start in contact are noted, not refused.
/// @param progress of making a path; false stops it: throws Interrupted
/// @throws InputError for an unusable mesh or path, UsageError for a profile that does not fit the
///         mesh, and for deforming meshes where they are refused
PreparedRun prepare(const Experiment& experiment, const Progress& progress = {},
                    Deforming deforming = Deforming::REFUSED);

/// Fixes all but the moving mesh at place and shape of the first frame.
void hold_first_frame(PreparedRun& prepared);

/// Files that the experiment will read, by its text: itself, path, manifest, meshes; some may be
/// missing. Outputs must replace none of them.
std::vector<std::filesystem::path> input_files(const Experiment& experiment);

/// The experiment's methods on the prepared scene.
std::vector<DrivenMethod> driven_methods(const Experiment& experiment, const PreparedRun& prepared);

}  // namespace lmdbench
