// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/mesh/surface_change.h>
#include <lmdbench/prepare/frame_vertices.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lmdbench {
namespace {

/// Intervals this near to whole frames, as a share of a frame, count as whole: seconds are rounded.
constexpr double WHOLE_FRAMES = 1e-9;

double in_frames(double seconds, double frame_rate_hz) {
  const double frames = seconds * frame_rate_hz;
  return std::abs(frames - std::round(frames)) <= WHOLE_FRAMES * frames ? std::round(frames) : frames;
}

/// Extension of vertex lists, which have no triangles.
constexpr const char* VERTEX_LIST = ".xyz";

constexpr const char* KEEPS_TOPOLOGY =
    "a deformation keeps the topology: write the mesh's own triangles, or the vertices alone as "
    "x y z lines in a file that ends in .xyz";

/// Where a mesh file with the triangles of the mesh at rest has each of its vertices. Vertices that
/// come together in this shape stay apart, as they are not at rest.
std::vector<Vec3> vertices_of_shape(const TriangleMesh& shape, const TriangleMesh& rest,
                                    const std::string& name) {
  if (shape.triangles.size() != rest.triangles.size())
    throw InputError(
        name, "triangles",
        fmt::format("{} triangles for a mesh of {}", shape.triangles.size(), rest.triangles.size()),
        KEEPS_TOPOLOGY);
  std::vector<std::optional<Vec3>> found(rest.vertices.size());
  for (std::size_t t = 0; t < rest.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& p = shape.vertices[static_cast<std::size_t>(shape.triangles[t][c])];
      std::optional<Vec3>& place = found[static_cast<std::size_t>(rest.triangles[t][c])];
      if (place && *place != p)
        throw InputError(name, fmt::format("triangle {}", t), "is not that of the mesh that deforms",
                         KEEPS_TOPOLOGY);
      place = p;
    }
  std::vector<Vec3> vertices;
  vertices.reserve(found.size());
  for (const std::optional<Vec3>& place : found) vertices.push_back(place.value());
  return vertices;
}

std::vector<Vec3> vertices_of_file(const FileContent& content, const TriangleMesh& rest) {
  const std::string name = content.file.string();
  std::vector<Vec3> vertices = content.file.extension() == VERTEX_LIST
                                   ? parse_vertex_list(content.bytes, name)
                                   : vertices_of_shape(import_unwelded(content), rest, name);
  check_moved_vertices(name, rest, vertices);
  return vertices;
}

}  // namespace

std::vector<Vec3> parse_vertex_list(const std::string& text, const std::string& name) {
  std::vector<Vec3> vertices;
  for_each_number_line(text, name, "write x y z, in the units of the mesh's file",
                       [&](const std::string& place, std::span<const double> n) {
                         if (n.size() != 3)
                           throw InputError(name, place, fmt::format("{} numbers", n.size()), "write x y z");
                         vertices.emplace_back(n[0], n[1], n[2]);
                       });
  return vertices;
}

FrameVertices::FrameVertices(const MeshDeformation& deformation, const DeformingMesh& mesh,
                             double frame_rate_hz)
    : deformation_(deformation) {
  if (mesh.X_WF) X_WF_.emplace(*mesh.X_WF);
  if (deformation.generator) {
    generator_.emplace(mesh.placed, *deformation.generator);
    period_frames_ = in_frames(deformation.period_s, frame_rate_hz);
    return;
  }
  period_frames_ = deformation.interval_s ? in_frames(*deformation.interval_s, frame_rate_hz) : 1.0;
  read_files(mesh);
}

void FrameVertices::read_files(const DeformingMesh& mesh) {
  const Vec3 origin = mesh.placement.centres() ? bounding_box_centre(mesh.in_file) : Vec3::Zero();
  const double factor = mesh.placement.factor(mesh.in_file);
  std::string hashes;
  std::int64_t bytes = 0;
  for (const std::filesystem::path& file : vertex_files(deformation_)) {
    const FileContent content = read_input_file(file, {.what = "vertex file"});
    hashes += content.sha256;
    file_bytes_ += static_cast<std::int64_t>(content.bytes.size());
    std::vector<Vec3> vertices = vertices_of_file(content, mesh.in_file);
    for (Vec3& vertex : vertices) {
      vertex = factor * (vertex - origin);
      if (X_WF_) vertex = X_WF_->point(vertex);
    }
    bytes += static_cast<std::int64_t>(vertices.size() * sizeof(Vec3));
    if (bytes > limit_of(Limit::FILE_BYTES))
      throw UsageError(
          deformation_.experiment.string(), deformation_.place,
          fmt::format("vertex files of more than {} bytes together", limit_of(Limit::FILE_BYTES)),
          "take fewer and a longer interval_s, or " + raise_remedy(Limit::FILE_BYTES));
    shapes_.push_back(std::move(vertices));
  }
  sha256_ = sha256_of_text(hashes);
}

void FrameVertices::at(std::int64_t frame, std::vector<Vec3>& vertices) const {
  LMDBENCH_EXPECTS(frame >= 0 && period_frames_ > 0.0,
                   "a frame before the first, or a period of another unit");
  const double step = static_cast<double>(frame) / period_frames_;
  if (generator_) {
    generator_->at(step, vertices);
    if (X_WF_)
      for (Vec3& vertex : vertices) vertex = X_WF_->point(vertex);
    return;
  }
  const auto count = static_cast<std::int64_t>(shapes_.size());
  const auto whole = static_cast<std::int64_t>(std::floor(step));
  const double part = step - static_cast<double>(whole);
  // The shape at a whole step.
  const auto shape = [&](std::int64_t at) -> const std::vector<Vec3>& {
    std::int64_t index = std::min(at, count - 1);
    if (deformation_.end == SequenceEnd::REPEAT) index = at % count;
    if (deformation_.end == SequenceEnd::BACK && count > 1) {
      index = at % (2 * (count - 1));
      if (index >= count) index = 2 * (count - 1) - index;
    }
    return shapes_[static_cast<std::size_t>(index)];
  };
  const std::vector<Vec3>& from = shape(whole);
  vertices = from;
  if (part == 0.0) return;
  const std::vector<Vec3>& to = shape(whole + 1);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    // Unmoved vertices keep their bits.
    if (from[v] != to[v]) vertices[v] = (1.0 - part) * from[v] + part * to[v];
}

}  // namespace lmdbench
