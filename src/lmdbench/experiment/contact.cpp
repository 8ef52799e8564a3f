// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/contact.h>
#include <lmdbench/snch/minimum_distance.h>

#include <algorithm>

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

}  // namespace lmdbench
