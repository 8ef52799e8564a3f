// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/contact.h>
#include <lmdbench/snch/minimum_distance.h>

#include <algorithm>
#include <limits>

namespace lmdbench {

std::vector<bool> frames_in_contact(const Scene& scene, const std::vector<Pose>& poses) {
  std::vector<bool> in_contact;
  in_contact.reserve(poses.size());
  for (const Pose& X_WM : poses)
    in_contact.push_back(std::any_of(scene.fixed.begin(), scene.fixed.end(), [&](const auto& fixed) {
      return within_distance(scene.moving->surface(), scene.moving->template prepared<Hierarchy>(),
                             fixed->surface(), fixed->template prepared<Hierarchy>(), X_WM, scene.cutoff);
    }));
  return in_contact;
}

double clearance(const Scene& scene, const Pose& X_WM) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& fixed : scene.fixed) {
    const NearestPair pair = nearest_pair(scene.moving->surface(), scene.moving->prepared<Hierarchy>(),
                                          fixed->surface(), fixed->prepared<Hierarchy>(), X_WM, least);
    if (pair.triangle_moving >= 0) least = std::min(least, pair.distance);
  }
  return least;
}

}  // namespace lmdbench
