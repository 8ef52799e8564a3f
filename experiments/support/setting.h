// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <support/bodies.h>
#include <support/lmd_error.h>

#include <string>
#include <vector>

namespace lmdbench::experiments {

/// A scene at unrelated poses, with the true LMD sets.
struct Setting {
  std::string name;  ///< Of the cutoff, for example "0.5%".
  Scene scene;
  std::vector<Pose> poses;
  Truth truth;
};

/// Random grazing poses of a scene, one setting per cutoff; the same in every run.
/// @param cutoffs shares of the diagonal
std::vector<Setting> grazing_settings(const SceneChoice& choice, const std::vector<double>& cutoffs,
                                      std::size_t pose_count);

}  // namespace lmdbench::experiments
