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

/// What `lmdbench init` may be told.
struct InitChoices {
  /// What a unit of the files' coordinates is: as `metres_of_units` reads it. Without it that of the format (`metres_of_format`), and one
  /// is chosen for files whose format has none: millimetres where either spans more than LARGEST_PLAUSIBLE_DIAGONAL, else metres.
  /// Meshes of the manifest are in metres.
  std::optional<std::string> unit = std::nullopt;
  /// Without it outward for a mesh that is inside out or disagrees with itself, else keep.
  std::optional<OrientationChoice> orientation = std::nullopt;
  /// Whether both meshes stay where their files have them or each is centred. Without it they stay where two files of one unit place
  /// them in or next to each other, as parts of one assembly.
  std::optional<bool> keep_place = std::nullopt;
  bool contact =
      false;  ///< A closed loop that begins at rest in contact (resting_pose.h), for `lmdbench stability`.
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
  /// At rest in contact: the override under which a hand's device is pressed on by just the force that balances the contact,
  /// for `lmdbench run`. Without it the contact pushes it out, by up to force over the hand's stiffness. Empty otherwise.
  std::string press;
  std::vector<DefaultNote> choices;   ///< Every value that was chosen, and why.
  std::vector<std::string> warnings;  ///< Flaws of the meshes, and sizes that tell of another unit.
};

/// Chooses everything for two meshes: units, cutoff, forces, a path that grazes, methods and probes.
/// @param moving,fixed  names of the manifest or mesh files, as seen from the present folder
/// @param folder        where the files will stand; mesh files are named relative to it
/// @param mesh_folder   of the manifest
/// @throws InputError for a mesh that cannot be used, or meshes that no path brings together; UsageError for meshes of sizes more
///         than UNLIKELY_SIZE_RATIO apart where nobody says their units
NewExperiment new_experiment(const std::string& moving, const std::string& fixed,
                             const std::filesystem::path& folder, const std::filesystem::path& mesh_folder,
                             const Progress& progress = {}, const InitChoices& chosen = {});

/// Writes the files (an empty text: none), making the folder.
/// @throws UsageError where one of them is there already: it may have been edited
void write_new_experiment(const NewExperiment& experiment);

}  // namespace lmdbench
