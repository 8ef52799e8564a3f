// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// What an experiment file may leave to the scene: two meshes are enough. Everything else that has a default has
/// it in the schema.
namespace lmdbench {

class Body;
struct Experiment;
struct Scene;

/// A value that the file does not give.
struct DefaultNote {
  std::string key;    ///< JSON pointer
  std::string value;  ///< With its unit.
  std::string from;   ///< Why this one.
};

/// Adds what needs no mesh: the name (the file's), the methods (all but those that look at every pair), the
/// largest force of an LMD (the device's continuous one). Values of a wrong type are left to the schema.
std::vector<DefaultNote> add_file_defaults(nlohmann::json& document, const std::filesystem::path& file);

/// Cutoff where the experiment gives none, in diagonals of the smaller mesh ...
inline constexpr double DEFAULT_CUTOFF_DIAGONALS = 0.02;
/// ... but no more mean edges of the coarser mesh, so that a cutoff does not hold thousands of triangles.
inline constexpr double DEFAULT_CUTOFF_EDGES = 10.0;

/// The cutoff of a scene [m].
/// @param notes receives where it comes from
double default_cutoff(const Scene& scene, std::vector<DefaultNote>& notes);

/// A line a value for people; nothing where there is none.
std::string defaults_text(const std::vector<DefaultNote>& notes);
/// [{"key", "value", "from"}]
nlohmann::ordered_json defaults_json(const std::vector<DefaultNote>& notes);

}  // namespace lmdbench
