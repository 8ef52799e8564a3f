// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/deformation.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// What a sequence of vertex files does after its last one.
enum class SequenceEnd : std::uint8_t {
  HOLD,    ///< The last shape stays.
  REPEAT,  ///< Continues to the first shape as to any next one, and repeats.
  BACK     ///< Returns through the files to the first one, and repeats.
};

/// "hold", "repeat", "back".
std::string_view to_string(SequenceEnd end);

/// `/moving/deformation` or `/fixed/.../deformation` of an experiment: how the vertices of a mesh
/// move each frame, by a generator or through vertex files. Triangles are unchanged.
struct MeshDeformation {
  std::filesystem::path experiment;            ///< File with this deformation, ...
  std::string place;                           ///< ... and the JSON pointer there; for messages.
  std::optional<DeformationChoice> generator;  ///< Unset: files.
  double period_s = 0.0;                       ///< Of a generator: both ways and back.
  std::vector<std::filesystem::path> files;    ///< Of a sequence, in order; empty with `folder`.
  std::filesystem::path folder;                ///< Its files are the sequence, in order of name.
  std::optional<double> interval_s;            ///< To the next file; unset: one haptic frame.
  SequenceEnd end = SequenceEnd::HOLD;
};

/// @param entry with its defaults
/// @param place JSON pointer of the entry; `file`, the experiment's, is the base of relative names
/// @throws UsageError unless exactly one of generator, files and folder is given, and for a
/// generator without amplitude or a direction without length
MeshDeformation read_mesh_deformation(const nlohmann::json& entry, const std::string& place,
                                      const std::filesystem::path& file);

/// "bend, amplitude 1, 8 % of the vertices, period 0.5 s" or "12 vertex files, ...".
std::string to_text(const MeshDeformation& deformation);

/// The files of a sequence; those of a folder in the order of their names.
/// @throws InputError for a folder that is missing or empty
std::vector<std::filesystem::path> vertex_files(const MeshDeformation& deformation);

}  // namespace lmdbench
