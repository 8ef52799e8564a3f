// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/registry.h>

#include <nlohmann/json_fwd.hpp>
#include <study/completeness/judge.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lmdbench::completeness {

/// Receives every pose at which something is wrong: in words that say how to see it again.
using Complain = std::function<void(const std::string&)>;

/// A way to run `certified` that must give the true set.
struct Variant {
  std::string label;
  std::unique_ptr<Method> (*make)(const Scene& scene);
};

/// From scratch with the vector kernel, from scratch with the scalar one, and with frame coherence.
const std::vector<Variant>& variants();

/// One cutoff's judgements, in the order of `variants()`.
struct CutoffResult {
  double cutoff = 0.0;  ///< Share of the diagonal.
  std::vector<Judgement> judgements;
};

nlohmann::json to_json(const Judgement& judgement);

/// Judges every variant against `exhaustive` at every pose and cutoff.
/// @param cutoffs shares of the diagonal
std::vector<CutoffResult> judge_poses(Scene scene, double diagonal, const std::vector<double>& cutoffs,
                                      const std::vector<Pose>& poses, const Complain& complain);

/// Two meshes and poses of one, out of random numbers.
struct GeneratedScene {
  std::string label;        ///< How it came about, for messages.
  Scene scene;              ///< With its cutoff.
  double scale = 1.0;       ///< On which points are compared [m].
  std::vector<Pose> poses;  ///< World pose of the moving mesh.
};

/// Judges every variant at every pose of a scene, and adds that in the order of `variants()`.
void judge_scene(const GeneratedScene& scene, const Complain& complain, std::vector<Judgement>& judgements);

/// Of all variants together.
Judgement sum_of(const std::vector<Judgement>& judgements);
/// Of each variant under its label.
nlohmann::json variants_json(const std::vector<Judgement>& judgements);

/// Frames of an experiment's path: `certified` with frame coherence against `certified` from scratch in every
/// frame, and against `exhaustive` in every `truth_stride`-th.
struct PathResult {
  std::string experiment;
  std::size_t frames = 0;
  Judgement against_scratch;
  Judgement against_truth;
  /// Work of both over the whole path, for what coherence saves.
  WorkCounters coherent_work, scratch_work;
};

/// @param meshes folder of built meshes, instead of the experiment's own
PathResult judge_path(const std::filesystem::path& experiment, const std::filesystem::path& meshes,
                      std::size_t truth_stride, const Complain& complain);

}  // namespace lmdbench::completeness
