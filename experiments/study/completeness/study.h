// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/registry.h>

#include <nlohmann/json_fwd.hpp>
#include <study/completeness/judge.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lmdbench::completeness {

/// Receives a message for every wrong pose, which tells how to reproduce it.
using Complain = std::function<void(const std::string&)>;

/// A way to run `certified`; each must give the true set.
struct Variant {
  std::string label;
  std::unique_ptr<Method> (*make)(const Scene& scene);
};

/// From scratch with the vector kernel, from scratch with the scalar one, and with frame coherence.
const std::vector<Variant>& variants();

/// The judgements at one cutoff, in the order of `variants()`.
struct CutoffResult {
  double cutoff = 0.0;  ///< Share of the diagonal.
  std::vector<Judgement> judgements;
};

nlohmann::json to_json(const Judgement& judgement);

/// Judges every variant against `exhaustive` at every pose and cutoff.
/// @param cutoffs shares of the diagonal
std::vector<CutoffResult> judge_poses(Scene scene, double diagonal, const std::vector<double>& cutoffs,
                                      const std::vector<Pose>& poses, const Complain& complain);

/// Two random meshes and random poses of the moving one.
struct GeneratedScene {
  std::string label;        ///< Describes in messages how the scene was made.
  Scene scene;              ///< With its cutoff.
  double scale = 1.0;       ///< Scale of the comparison of points [m].
  std::vector<Pose> poses;  ///< World poses of the moving mesh.
};

/// Judges every variant at every pose and adds that to `judgements`, ordered as `variants()`.
void judge_scene(const GeneratedScene& scene, const Complain& complain, std::vector<Judgement>& judgements);

/// Sum over all variants.
Judgement sum_of(const std::vector<Judgement>& judgements);
/// The judgement of each variant under its label.
nlohmann::json variants_json(const std::vector<Judgement>& judgements);

/// Frames of an experiment's path: `certified` with frame coherence against `certified` from
/// scratch in every frame, and against `exhaustive` in every `truth_stride`-th one.
struct PathResult {
  std::string experiment;
  std::size_t frames = 0;
  Judgement against_scratch;
  Judgement against_truth;
  /// Work over the whole path, which shows what coherence saves.
  WorkCounters coherent_work, scratch_work;
};

/// @param meshes folder of built meshes that replaces the experiment's own
PathResult judge_path(const std::filesystem::path& experiment, const std::filesystem::path& meshes,
                      std::size_t truth_stride, const Complain& complain);

}  // namespace lmdbench::completeness
