// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/prepare/scene_deformation.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lmdbench {
namespace {

/// Goes through a body's frames.
void follow(DeformingBody& body, std::int64_t frames) {
  Surface surface = body.rest->surface();
  const std::vector<Vec3> at_rest = surface.mesh.vertices;
  SurfaceMover mover(surface);
  std::vector<Vec3> vertices;
  const MeshDeformation& choice = body.vertices->deformation();
  double squared_farthest = 0.0;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    body.vertices->at(frame, vertices);
    LMDBENCH_EXPECTS(vertices.size() == at_rest.size(), "vertex files of another mesh");
    try {
      check_moved_vertices(body.rest->name(), surface.mesh, vertices);
    } catch (const InputError& error) {
      throw InputError(choice.experiment.string(), fmt::format("{}, frame {}", choice.place, frame),
                       error.what(), "lower the amplitude, or mend the vertex files");
    }
    const SurfaceChange& change = mover.move(vertices, surface);
    for (const std::int32_t v : change.moved) {
      const auto at = static_cast<std::size_t>(v);
      squared_farthest = std::max(squared_farthest, (vertices[at] - at_rest[at]).squaredNorm());
    }
    body.steps.push_back({static_cast<std::int64_t>(change.moved.size()), change.largest_move,
                          change.turned_over, change.lost_area, change.first_turned_over,
                          change.first_lost_area});
  }
  body.farthest = std::sqrt(squared_farthest);
}

}  // namespace

SceneDeformation::SceneDeformation(std::vector<DeformingBody> bodies, std::int64_t frames)
    : bodies_(std::move(bodies)), ways_(static_cast<std::size_t>(frames), 0.0) {
  for (DeformingBody& body : bodies_) {
    follow(body, frames);
    double way = 0.0;
    for (std::size_t frame = 0; frame < ways_.size(); ++frame)
      ways_[frame] += way += body.steps[frame].largest_move;
  }
}

const DeformingBody* SceneDeformation::find(const Body* body) const {
  const auto found =
      std::ranges::find_if(bodies_, [&](const DeformingBody& one) { return one.rest.get() == body; });
  return found == bodies_.end() ? nullptr : &*found;
}

double SceneDeformation::way(std::int64_t from, std::int64_t to) const {
  LMDBENCH_EXPECTS(from >= 0 && to >= 0, "a frame before the first");
  const double steps =
      std::abs(ways_.at(static_cast<std::size_t>(to)) - ways_.at(static_cast<std::size_t>(from)));
  double at_most = 0.0;
  for (const DeformingBody& body : bodies_) at_most += 2.0 * body.farthest;
  return std::min(steps, at_most);
}

double SceneDeformation::farthest(const Body* body) const {
  const DeformingBody* found = find(body);
  return found == nullptr ? 0.0 : found->farthest;
}

}  // namespace lmdbench
