// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/method.h>

#include <fmt/core.h>
#include <support/poses.h>
#include <support/setting.h>

#include <algorithm>

namespace lmdbench::experiments {
namespace {

constexpr std::uint64_t SEED = 1;

}  // namespace

std::vector<Setting> grazing_settings(const SceneChoice& choice, const std::vector<double>& cutoffs,
                                      std::size_t pose_count) {
  Scene scene = load_scene(choice);
  const std::vector<Pose> poses =
      grazing_poses(*scene.moving, *scene.fixed.at(0), choice.gap * choice.diagonal, pose_count, SEED);
  // The cutoff only decides whether an LMD counts: the truth of the largest contains the others.
  scene.cutoff = *std::max_element(cutoffs.begin(), cutoffs.end()) * choice.diagonal;
  const Truth all = exhaustive_truth(scene, poses);
  std::vector<Setting> settings;
  for (const double cutoff : cutoffs) {
    scene.cutoff = cutoff * choice.diagonal;
    Truth truth;
    for (const LmdSet& set : all) truth.push_back(within_cutoff(set, scene.cutoff));
    settings.push_back({fmt::format("{:g}%", 100.0 * cutoff), scene, poses, truth});
  }
  return settings;
}

}  // namespace lmdbench::experiments
