// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/progress.h>
#include <lmdbench/experiment/defaults.h>
#include <lmdbench/mesh/length_unit.h>
#include <lmdbench/mesh/orientation_choice.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// What a user may tell `lmdbench init`.
struct InitChoices {
  /// Unit of the files' coordinates, for `metres_of_units`. Unset: the format's
  /// (`metres_of_format`), else millimetres where a mesh spans more than
  /// LARGEST_PLAUSIBLE_DIAGONAL, else metres. Meshes of the manifest are in metres.
  std::optional<std::string> unit = std::nullopt;
  /// Unset: outward for a mesh of which that turns triangles, else keep.
  std::optional<OrientationChoice> orientation = std::nullopt;
  /// Whether both meshes stay at their files' places, or are centred. Unset: they stay where two
  /// files of one unit have them next to or in each other, as parts of one assembly.
  std::optional<bool> keep_place = std::nullopt;
  /// Whether to make a closed loop from rest in contact (resting_pose.h), for `lmdbench stability`.
  bool contact = false;
};

/// Files of an experiment that is ready to run and to edit.
struct NewExperiment {
  std::string name;
  std::filesystem::path experiment_file;
  std::filesystem::path specification_file;  ///< Of the path.
  std::filesystem::path path_file;
  std::string experiment_text;
  std::string specification_text;
  std::string path_text;
  /// At rest in contact: the override for `lmdbench run` that makes the hand press with just the
  /// balancing force. Else the contact pushes the device out, by up to force / hand stiffness.
  std::string press;
  std::vector<DefaultNote> choices;   ///< Every value that was chosen, and why.
  std::vector<std::string> warnings;  ///< Flaws of meshes, sizes of another unit.
};

/// Chooses all for two meshes: units, cutoff, forces, a path that grazes, methods and probes.
/// @param moving,fixed  names of the manifest or mesh files, as seen from the present folder
/// @param folder        of the new files, to which names of mesh files are relative
/// @param mesh_folder   of the manifest
/// @throws InputError for an unusable mesh, or meshes that no path brings together; UsageError for
///         sizes more than UNLIKELY_SIZE_RATIO apart without a given unit
NewExperiment new_experiment(const std::string& moving, const std::string& fixed,
                             const std::filesystem::path& folder, const std::filesystem::path& mesh_folder,
                             const Progress& progress = {}, const InitChoices& chosen = {});

/// Writes the files (none for an empty text), making the folder.
/// @throws UsageError where one of them exists: it may have been edited
void write_new_experiment(const NewExperiment& experiment);

}  // namespace lmdbench
