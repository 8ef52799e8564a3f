// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// Limits of inputs. Files come from everywhere: a file larger than any honest one is refused, with
/// the limit's name, before it costs minutes or the machine's memory.
namespace lmdbench {

enum class Limit : std::uint8_t {
  FILE_BYTES,        ///< Of a mesh or path file.
  JSON_BYTES,        ///< Of an experiment, path specification or manifest.
  JSON_DEPTH,        ///< Arrays and objects inside each other.
  JSON_TEXT,         ///< Bytes of one text or key.
  TRIANGLES,         ///< Of one mesh.
  POLYGON_CORNERS,   ///< Of a face that is cut into triangles.
  EDGE_TRIANGLES,    ///< Triangles that share one edge.
  VERTEX_TRIANGLES,  ///< Triangles that share one vertex.
  VERTEX_PAIRS,      ///< Triangle pairs round a vertex of one mesh and a vertex of another.
  IMPORT_SECONDS,    ///< Processor time of the child process that reads a mesh or result.
  IMPORT_BYTES,      ///< Memory of that process.
  PATH_SECONDS,      ///< Processor time to make or check a path.
  FRAMES,            ///< Haptic frames of a run or a path.
  PLUGIN_SECONDS,    ///< Wall clock, for one answer of a plugin in a process of its own.
  PLUGIN_BYTES,      ///< Memory of that process.
  COUNT
};

struct LimitInfo {
  Limit limit;
  std::string_view name;  ///< As `--limit NAME=NUMBER` takes it.
  std::int64_t usual;     ///< Without an option.
  std::int64_t most;      ///< No option may ask for more: the program itself would break.
  std::string_view meaning;
};

/// All limits, in the order of `Limit`.
std::span<const LimitInfo> limit_table();

std::int64_t limit_of(Limit limit);

/// Sets a limit for the whole process, from text "NAME=NUMBER". Only at the start of a program:
/// readers on other threads would see it at once.
/// @throws UsageError for an unknown name and for a number that is not from 1 to `most`
void set_limit(const std::string& text);

/// "raise it with --limit frames=NUMBER": the end of a remedy, after other advice.
std::string raise_remedy(Limit limit);

}  // namespace lmdbench
