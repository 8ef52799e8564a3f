// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/remade_method.h>

#include <utility>

namespace lmdbench {

namespace {

std::uint64_t deformations_of(const Scene& scene) {
  std::uint64_t sum = scene.moving->deformations();
  for (const auto& body : scene.fixed) sum += body->deformations();
  return sum;
}

}  // namespace

RemadeMethod::RemadeMethod(const Scene& scene, Make make)
    : scene_(scene), make_(std::move(make)), method_(make_(scene_)), deformations_(deformations_of(scene_)) {}

Method& RemadeMethod::current() {
  if (const std::uint64_t deformations = deformations_of(scene_); deformations != deformations_) {
    method_ = make_(scene_);
    deformations_ = deformations;
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
