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
  REPEAT,  ///< Goes on to the first shape, as from any file to the next, and begins again.
  BACK     ///< Goes back through the files to the first one, and begins again.
};

/// "hold", "repeat", "back".
std::string_view to_string(SequenceEnd end);

/// `/moving/deformation` or `/fixed/.../deformation` of an experiment: how the vertices of a mesh move from frame to frame, by a
/// generator or through vertex files. Triangles stay.
struct MeshDeformation {
  std::filesystem::path experiment;            ///< File that asks for it, ...
  std::string place;                           ///< ... and the JSON pointer there; for messages.
  std::optional<DeformationChoice> generator;  ///< Unset: files.
  double period_s = 0.0;                       ///< Of a generator: there and back to both sides.
  std::vector<std::filesystem::path>
      files;                         ///< Of a sequence, in their order; empty where `folder` names them.
  std::filesystem::path folder;      ///< Its files are the sequence, in the order of their names.
  std::optional<double> interval_s;  ///< From one file to the next; unset: one haptic frame.
  SequenceEnd end = SequenceEnd::HOLD;
};

/// @param entry with its defaults
/// @param place JSON pointer of the entry; `file` is the experiment's, whose folder names are relative to
/// @throws UsageError for none or several of generator, files and folder, a generator without amplitude, a direction without length
MeshDeformation read_mesh_deformation(const nlohmann::json& entry, const std::string& place,
                                      const std::filesystem::path& file);

/// "bend, amplitude 1, 8 % of the vertices, period 0.5 s" or "12 vertex files, ...".
std::string to_text(const MeshDeformation& deformation);

/// The files of a sequence; of a folder those in it, in the order of their names.
/// @throws InputError for a folder that is not there or has no file
std::vector<std::filesystem::path> vertex_files(const MeshDeformation& deformation);

}  // namespace lmdbench
