// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/progress.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/motion/grazing.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/result_file/provenance.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// A path at the frames of a run, and where it comes from.
struct FramePath {
  Path frames;
  InputFile file;                   ///< For the provenance.
  std::vector<RecordingGap> gaps;   ///< Intervals in which the mesh is held.
  std::optional<GrazingPath> made;  ///< Where the experiment names none.
};

/// The held object's path.
/// @throws InputError for a path that cannot be used
FramePath read_held_path(const Experiment& experiment);

/// A path for a scene that has none.
/// @param progress may stop it by returning false, which throws Interrupted
/// @throws UsageError for a cutoff that no path grazes
FramePath make_path(const Experiment& experiment, const Scene& scene, const Progress& progress);

/// What is said of a path that was made.
DefaultNote note_of(const GrazingPath& made, double cutoff);

/// The path there and back until the run is over.
void lengthen(std::vector<Pose>& poses, std::vector<double>& times, double frame_rate_hz, double seconds);

/// Where all movers are in each frame, with the files of their paths and what was done to them.
struct MoverPoses {
  std::vector<std::vector<Pose>> of_mover;
  std::vector<InputFile> files;
  std::vector<std::string> warnings;
};

/// @param held poses of the held object
/// @param path_frames of its path, which it may take there and back; so do those that have paths of their own
/// @throws InputError for a path that cannot be used or ends before the held one; UsageError for more poses than memory holds
MoverPoses mover_poses(const Experiment& experiment, const std::vector<Mover>& movers,
                       const std::vector<Pose>& held, std::size_t path_frames);

}  // namespace lmdbench
