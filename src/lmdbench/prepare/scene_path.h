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

/// A path at the frames of a run, and its origin.
struct FramePath {
  Path frames;
  InputFile file;                   ///< For the provenance.
  std::vector<RecordingGap> gaps;   ///< Intervals in which the pose is held.
  std::optional<GrazingPath> made;  ///< If the experiment names none.
};

/// The held object's path.
/// @throws InputError for an unusable path
FramePath read_held_path(const Experiment& experiment);

/// A path for a scene that has none.
/// @param progress may return false to stop it, which throws Interrupted
/// @throws UsageError for a cutoff at which no path grazes
FramePath make_path(const Experiment& experiment, const Scene& scene, const Progress& progress);

/// The note about a path that was made.
DefaultNote note_of(const GrazingPath& made, double cutoff);

/// Repeats the path there and back until the run's end.
/// @param file of the experiment, for messages
/// @throws UsageError above the limit of frames
void lengthen(std::vector<Pose>& poses, std::vector<double>& times, double frame_rate_hz, double seconds,
              const std::string& file);

/// Poses of all movers in each frame, with the files of their paths and warnings.
struct MoverPoses {
  std::vector<std::vector<Pose>> of_mover;
  std::vector<InputFile> files;
  std::vector<std::string> warnings;
};

/// @param held poses of the held object
/// @param path its path, which it may repeat there and back, as the other movers then do
/// @throws InputError for a bad path, a shorter one and one that begins at another time; UsageError
/// for more poses than memory holds
MoverPoses mover_poses(const Experiment& experiment, const std::vector<Mover>& movers,
                       const std::vector<Pose>& held, const Path& path);

}  // namespace lmdbench
