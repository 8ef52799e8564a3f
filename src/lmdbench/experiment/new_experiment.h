// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/defaults.h>
#include <lmdbench/experiment/lockstep.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// A mesh whose coordinates span more than this is taken for one in millimetres [m].
inline constexpr double LARGEST_PLAUSIBLE_DIAGONAL = 10.0;

/// Files of an experiment that is ready to run and to edit.
struct NewExperiment {
  std::string name;
  std::filesystem::path experiment_file;
  std::filesystem::path specification_file;  ///< Of the path.
  std::filesystem::path path_file;
  std::string experiment_text;
  std::string specification_text;
  std::string path_text;
  std::vector<DefaultNote> choices;  ///< Every value that was chosen, and why.
};

/// Chooses everything for two meshes: units, cutoff, forces, a path that grazes, methods and probes.
/// @param moving,fixed  names of the manifest or mesh files, as seen from the present folder
/// @param folder        where the files will stand; mesh files are named relative to it
/// @param mesh_folder   of the manifest
/// @throws InputError for a mesh that cannot be used, or meshes that no path brings together
NewExperiment new_experiment(const std::string& moving, const std::string& fixed,
                             const std::filesystem::path& folder, const std::filesystem::path& mesh_folder,
                             const Progress& progress = {});

/// Writes the three files, making the folder.
/// @throws UsageError where one of them is there already: it may have been edited
void write_new_experiment(const NewExperiment& experiment);

}  // namespace lmdbench
