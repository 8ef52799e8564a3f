// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/run/scene_deformation.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace lmdbench {
namespace {

const Body& body_at(const Scene& scene, std::size_t index) {
  return index == 0 ? *scene.moving : *scene.fixed.at(index - 1);
}

/// Goes through the frames of a body.
void follow(DeformingBody& body, const Body& rest, std::int64_t frames) {
  Surface surface = rest.surface();
  const std::vector<Vec3> at_rest = surface.mesh.vertices;
  SurfaceMover mover(surface);
  std::vector<Vec3> vertices;
  const MeshDeformation& choice = body.vertices->deformation();
  double squared_farthest = 0.0;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    body.vertices->at(frame, vertices);
    LMDBENCH_EXPECTS(vertices.size() == at_rest.size(), "vertex files of another mesh");
    try {
      check_moved_vertices(rest.name(), surface.mesh, vertices);
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

SceneDeformation::SceneDeformation(const Scene& rest, std::vector<DeformingBody> bodies, std::int64_t frames)
    : bodies_(std::move(bodies)), ways_(static_cast<std::size_t>(frames), 0.0) {
  for (DeformingBody& body : bodies_) {
    follow(body, body_at(rest, body.index), frames);
    double way = 0.0;
    for (std::size_t frame = 0; frame < ways_.size(); ++frame)
      ways_[frame] += way += body.steps[frame].largest_move;
  }
}

const DeformingBody* SceneDeformation::find(std::size_t index) const {
  const auto found =
      std::ranges::find_if(bodies_, [&](const DeformingBody& body) { return body.index == index; });
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

double SceneDeformation::farthest(std::size_t index) const {
  const DeformingBody* body = find(index);
  return body == nullptr ? 0.0 : body->farthest;
}

DeformingScene::DeformingScene(const Scene& rest, std::shared_ptr<const SceneDeformation> deformation)
    : scene_(rest), deformation_(std::move(deformation)) {
  if (!deformation_) return;
  for (const DeformingBody& body : deformation_->bodies()) {
    const Body& at_rest = body_at(rest, body.index);
    own_.push_back(std::make_shared<Body>(at_rest.name(), at_rest.surface()));
    if (body.index == 0)
      scene_.moving = own_.back();
    else
      scene_.fixed.at(body.index - 1).body = own_.back();
  }
}

void DeformingScene::prepare_to_deform() {
  for (const std::shared_ptr<Body>& body : own_) {
    vertices_ = body->surface().mesh.vertices;
    body->deform(vertices_);
  }
}

double DeformingScene::to_frame(std::int64_t frame) {
  double seconds = 0.0;
  LMDBENCH_EXPECTS(!deformation_ || own_.size() == deformation_->bodies().size(),
                   "a scene that was moved from");
  for (std::size_t i = 0; i < own_.size(); ++i) {
    deformation_->bodies()[i].vertices->at(frame, vertices_);
    const auto begin = std::chrono::steady_clock::now();
    own_[i]->deform(vertices_);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  return seconds;
}

}  // namespace lmdbench
