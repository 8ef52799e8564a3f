// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// Values that an experiment file may leave to the scene: two meshes are enough. All other defaults
/// are in the schema.
namespace lmdbench {

class Body;
struct Experiment;
struct Scene;

/// A value missing in the file.
struct DefaultNote {
  std::string key;    ///< JSON pointer
  std::string value;  ///< With its unit.
  std::string from;   ///< Why this one.
};

/// Adds defaults that need no mesh: name (the file's), methods (all but those that test every
/// pair), force limit of an LMD (the device's continuous force). Wrong types are the schema's.
std::vector<DefaultNote> add_file_defaults(nlohmann::json& document, const std::filesystem::path& file);

/// Cutoff where the experiment gives none, in diagonals of the smaller mesh ...
inline constexpr double DEFAULT_CUTOFF_DIAGONALS = 0.02;
/// ... but at most so many mean edges of the coarser mesh, which bounds the triangles within it.
inline constexpr double DEFAULT_CUTOFF_EDGES = 10.0;

/// The cutoff of a scene [m].
/// @param notes receives its origin
double default_cutoff(const Scene& scene, std::vector<DefaultNote>& notes);

/// One line a value, for people; empty without values.
std::string defaults_text(const std::vector<DefaultNote>& notes);
/// [{"key", "value", "from"}]
nlohmann::ordered_json defaults_json(const std::vector<DefaultNote>& notes);

}  // namespace lmdbench
