// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/remade_method.h>

#include <algorithm>
#include <utility>

namespace lmdbench {

RemadeMethod::RemadeMethod(const Scene& scene, Make make)
    : scene_(scene), bodies_{scene.moving}, make_(std::move(make)), method_(make_(scene_)) {
  for (std::size_t i = 0; i < scene.object_count(); ++i) bodies_.push_back(scene.body(i));
  std::ranges::sort(bodies_);
  bodies_.erase(std::unique(bodies_.begin(), bodies_.end()), bodies_.end());
  deformations_ = deformations();
}

std::uint64_t RemadeMethod::deformations() const {
  std::uint64_t sum = 0;
  for (const auto& body : bodies_) sum += body->deformations();
  return sum;
}

Method& RemadeMethod::current() {
  if (const std::uint64_t now = deformations(); now != deformations_) {
    method_ = make_(scene_);
    deformations_ = now;
  }
  return *method_;
}

void RemadeMethod::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  current().search(X_WM, lmds, counters);
}

void RemadeMethod::track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  current().track(X_WM, lmds, counters);
}

void RemadeMethod::find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) {
  current().find_critical(X_WM, critical, counters);
}

}  // namespace lmdbench
