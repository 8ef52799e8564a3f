// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/scene/scene_search.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <study/completeness/study.h>
#include <support/program.h>

#include <algorithm>

namespace lmdbench::completeness {
namespace {

template <bool Coherent, WideKernel Kernel>
std::unique_ptr<Method> make_certified(const Scene& scene) {
  return std::make_unique<SceneSearch>(scene, certified_method(), [](const Scene& of_pair) {
    return std::make_unique<Certified>(of_pair, CertifiedOptions{.frame_coherence = Coherent}, Kernel);
  });
}

/// The pose as a line of a TUM file.
std::string pose_line(const Pose& pose, double time) {
  return tum_text({{time, pose}});
}

}  // namespace

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = {
      {"vector", make_certified<false, WideKernel::VECTOR>},
      {"scalar", make_certified<false, WideKernel::SCALAR>},
      {"coherent", make_certified<true, WideKernel::VECTOR>},
  };
  return all;
}

std::vector<CutoffResult> judge_poses(Scene scene, double diagonal, const std::vector<double>& cutoffs,
                                      const std::vector<Pose>& poses, const Complain& complain) {
  // The cutoff only decides whether an LMD counts: the truth of the largest contains the others.
  scene.cutoff = *std::max_element(cutoffs.begin(), cutoffs.end()) * diagonal;
  const std::unique_ptr<Method> exhaustive = make_method("exhaustive", scene);
  std::vector<CutoffResult> results;
  std::vector<std::vector<std::unique_ptr<Method>>> methods;
  for (const double cutoff : cutoffs) {
    scene.cutoff = cutoff * diagonal;
    results.push_back({cutoff, std::vector<Judgement>(variants().size())});
    methods.emplace_back();
    for (const Variant& variant : variants()) methods.back().push_back(variant.make(scene));
  }
  const NearestLmds nearest(scene);
  LmdSet all_truth, reported;
  WorkCounters counters;
  std::string objection;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    exhaustive->search(poses[i], all_truth, counters);
    for (std::size_t c = 0; c < cutoffs.size(); ++c) {
      const LmdSet truth = within_cutoff(all_truth, cutoffs[c] * diagonal);
      const auto nearest_lmd = nearest.at(poses[i], cutoffs[c] * diagonal);
      for (std::size_t v = 0; v < variants().size(); ++v) {
        methods[c][v]->search(poses[i], reported, counters);
        results[c].judgements[v] += judge(truth, reported, scene, diagonal, objection, nearest_lmd);
        if (!objection.empty())
          complain(fmt::format("pose {}, cutoff {:g} % of the diagonal, {}: {}\n{}", i, 100.0 * cutoffs[c],
                               variants()[v].label, objection, pose_line(poses[i], static_cast<double>(i))));
      }
    }
  }
  return results;
}

void judge_scene(const GeneratedScene& scene, const Complain& complain, std::vector<Judgement>& judgements) {
  const std::vector<CutoffResult> judged =
      judge_poses(scene.scene, scene.scale, {scene.scene.cutoff / scene.scale}, scene.poses,
                  [&](const std::string& what) { complain(scene.label + ", " + what); });
  judgements.resize(variants().size());
  for (std::size_t v = 0; v < variants().size(); ++v) judgements[v] += judged.front().judgements[v];
}

Judgement sum_of(const std::vector<Judgement>& judgements) {
  Judgement all;
  for (const Judgement& judgement : judgements) all += judgement;
  return all;
}

nlohmann::json to_json(const Judgement& judgement) {
  return {{"poses", judgement.poses},
          {"wrong_poses", judgement.wrong_poses},
          {"set", experiments::error_json(judgement.same, judgement.neighbours)},
          {"duplicates", judgement.duplicates},
          {"nearest_asked", judgement.nearest_asked},
          {"worst_distance_difference_diagonals", judgement.worst_distance_difference},
          {"worst_point_difference_diagonals", judgement.worst_point_difference}};
}

nlohmann::json variants_json(const std::vector<Judgement>& judgements) {
  nlohmann::json json;
  for (std::size_t v = 0; v < variants().size(); ++v) json[variants()[v].label] = to_json(judgements[v]);
  return json;
}

PathResult judge_path(const std::filesystem::path& experiment_file, const std::filesystem::path& meshes,
                      std::size_t truth_stride, const Complain& complain) {
  Experiment experiment = load_experiment(experiment_file);
  experiment.mesh_folder = meshes;
  const PreparedRun prepared = prepare(experiment);
  const double diagonal = bounding_box_diagonal(prepared.scene().moving->surface().mesh);
  const std::unique_ptr<Method> exhaustive = make_method("exhaustive", prepared.scene());
  const std::unique_ptr<Method> scratch = make_certified<false, WideKernel::VECTOR>(prepared.scene());
  const std::unique_ptr<Method> coherent = make_certified<true, WideKernel::VECTOR>(prepared.scene());
  PathResult result;
  result.experiment = experiment.name;
  LmdSet truth, from_scratch, from_coherent;
  WorkCounters counters;
  std::string objection;
  const auto complain_at = [&](std::size_t frame, const std::string& about) {
    if (!objection.empty())
      complain(fmt::format("frame {}, {}: {}\n{}", frame, about, objection,
                           pose_line(prepared.input.poses[frame], prepared.times[frame])));
  };
  for (std::size_t i = 0; i < prepared.input.poses.size(); ++i) {
    const Pose& pose = prepared.input.poses[i];
    scratch->search(pose, from_scratch, result.scratch_work);
    coherent->search(pose, from_coherent, result.coherent_work);
    ++result.frames;
    result.against_scratch += judge(from_scratch, from_coherent, prepared.scene(), diagonal, objection);
    complain_at(i, "coherent against from scratch");
    if (truth_stride == 0 || i % truth_stride != 0) continue;
    exhaustive->search(pose, truth, counters);
    result.against_truth += judge(truth, from_coherent, prepared.scene(), diagonal, objection);
    complain_at(i, "coherent against exhaustive");
  }
  return result;
}

}  // namespace lmdbench::completeness
