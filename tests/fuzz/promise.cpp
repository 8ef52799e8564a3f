// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "promise.h"

#include <lmdbench/base/error.h>
#include <lmdbench/base/printable_text.h>

#include <fmt/format.h>
#include <support/scratch_directory.h>

#include <cstring>
#include <exception>

namespace lmdbench::testing {

std::optional<std::string> broken_unless_refused(const std::string& file,
                                                 const std::function<std::string()>& read) {
  try {
    return read();
  } catch (const Error& error) {
    const std::string_view message = error.what();
    if (error.code() != ExitCode::USAGE && error.code() != ExitCode::INPUT_DATA)
      return fmt::format("refused with exit code {}: {}", static_cast<int>(error.code()), message);
    if (!message.starts_with(file + ": ")) return fmt::format("does not name the file: {}", message);
    if (message.find("(remedy: ") == std::string_view::npos)
      return fmt::format("names no remedy: {}", message);
    if (printable(message) != message) return fmt::format("not printable: {}", printable(message));
    return std::nullopt;
  } catch (const std::exception& error) {
    return fmt::format("threw what a user cannot act upon: {}", error.what());
  }
}

std::string broken_mesh(const TriangleMesh& mesh) {
  const auto vertex_count = static_cast<std::int64_t>(mesh.vertices.size());
  for (const auto& corners : mesh.triangles)
    for (const std::int32_t corner : corners)
      if (corner < 0 || corner >= vertex_count)
        return fmt::format("index {} of {} vertices", corner, vertex_count);
  for (const Vec3& vertex : mesh.vertices)
    if (!vertex.allFinite()) return "a coordinate that is not finite";
  return {};
}

bool same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
  return a.triangles == b.triangles && a.vertices.size() == b.vertices.size() &&
         (a.vertices.empty() ||
          std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vec3)) == 0);
}

std::filesystem::path written_file(std::string_view bytes) {
  static const ScratchDirectory scratch;
  return scratch.write("fuzz", std::string(bytes));
}

}  // namespace lmdbench::testing
