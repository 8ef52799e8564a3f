// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/shapes.h>

#include <support/poses.h>
#include <support/setting.h>

namespace lmdbench::experiments {

/// Two bumpy balls of different sizes, 0.02 apart.
inline Setting shapes_setting(double cutoff, std::size_t pose_count) {
  Setting setting;
  setting.name = "shapes";
  setting.scene = {std::make_shared<const Body>("small", build_surface(make_blob(1.0, 0.2, 3))),
                   {std::make_shared<const Body>("large", build_surface(make_blob(1.3, 0.3, 3)))},
                   cutoff};
  setting.poses = grazing_poses(*setting.scene.moving, *setting.scene.fixed[0], 0.02, pose_count, 11);
  setting.truth = exhaustive_truth(setting.scene, setting.poses);
  return setting;
}

}  // namespace lmdbench::experiments
