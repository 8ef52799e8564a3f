// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/mover_play.h>
#include <lmdbench/prepare/prepare.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench {

/// The movers of an experiment, loaded: in the order of the file, the moving mesh first.
struct LoadedMovers {
  struct Mover {
    std::shared_ptr<const Body> body;
    std::string name;       ///< Tells meshes apart.
    std::size_t entry = 0;  ///< Of `/movers`; of the moving mesh it says nothing.
    std::size_t which = 0;  ///< Instance of the entry.
    Pose place;             ///< Frame of its path.
  };
  std::vector<Mover> movers;
};

/// @param scene of `load_scene`
/// @param notes of `load_scene`; receives one an entry
/// @throws UsageError, InputError naming the entry for a mesh that cannot be used
LoadedMovers load_movers(const Experiment& experiment, const Scene& scene, std::vector<MeshNote>& notes);

/// What stands and what moves as one scene, for what looks at sizes alone.
Scene with_movers(Scene scene, const LoadedMovers& movers);

/// All poses of all movers.
/// @param poses of the moving mesh
/// @param path_frames of its path, which it may take there and back; so do those that have paths of their own
/// @param files,warnings receive paths that are read, and their gaps
/// @throws InputError for a path that cannot be used or ends before that of the moving mesh; UsageError for more poses than memory holds
std::shared_ptr<const MoverPlay> play_of(const Experiment& experiment, const LoadedMovers& loaded,
                                         const std::vector<Pose>& poses, std::size_t path_frames,
                                         std::vector<InputFile>& files, std::vector<std::string>& warnings);

}  // namespace lmdbench
