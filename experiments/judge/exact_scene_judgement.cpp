// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/prepare.h>

#include <fmt/format.h>
#include <judge/exact_scene.h>
#include <judge/exact_scene_judgement.h>

#include <algorithm>
#include <memory>

namespace lmdbench::exact {
namespace {

void judge_frame(const Scene& scene, const Pose& X_WM, const std::vector<ExactLmd>& truth, bool touching,
                 const LmdSet& lmds, const std::string& frame, Judgement& judgement) {
  const ExactAgreement agreement = compare_with_exact(scene, lmds, truth);
  ++judgement.frames;
  judgement.exact += agreement.exact;
  judgement.same_features += agreement.same_features;
  judgement.same_contact += agreement.same_contact;
  judgement.uncertain += agreement.uncertain;
  judgement.found += agreement.found;
  judgement.sharing += agreement.sharing;
  judgement.touching += touching;
  for (const ExactLmd& lmd : agreement.missed) {
    ++judgement.missed;
    judgement.failures.push_back(frame + "misses " + describe(lmd));
  }
  for (const Lmd& lmd : agreement.untrue) {
    const bool tolerated = within_tolerance(scene, X_WM, lmd);
    ++(tolerated ? judgement.tolerated : judgement.untrue);
    if (!tolerated)
      judgement.failures.push_back(fmt::format("{}untrue at distance {:.17g}", frame, lmd.distance));
  }
  const bool contact = std::any_of(lmds.begin(), lmds.end(), [](const Lmd& lmd) { return lmd.intersecting; });
  if (contact == touching) return;
  ++judgement.wrong_contacts;
  judgement.failures.push_back(frame + (touching ? "sees no contact" : "sees contact where there is none"));
}

}  // namespace

std::vector<Judgement> judge_experiment(const std::filesystem::path& experiment_file,
                                        std::int64_t most_frames) {
  const Experiment experiment = load_experiment(experiment_file);
  const PreparedRun run = prepare(experiment);
  const auto frames = static_cast<std::int64_t>(run.input.poses.size());
  const std::int64_t samples = std::min(most_frames, frames);
  std::vector<Judgement> judgements;
  std::vector<std::unique_ptr<Method>> methods;
  for (const MethodDescription& description : method_descriptions()) {
    if (description.promise != Promise::COMPLETE_SET) continue;
    judgements.push_back({experiment.name, description.name});
    methods.push_back(make_method(description.name, run.scene()));
  }
  for (std::int64_t i = 0; i < samples; ++i) {
    const std::int64_t frame = samples == 1 ? 0 : i * (frames - 1) / (samples - 1);
    const Pose& X_WM = run.input.poses[static_cast<std::size_t>(frame)];
    const std::vector<ExactLmd> truth = exact_lmds(run.scene(), X_WM);
    const bool touching = exactly_touching(run.scene(), X_WM);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const LmdSet lmds = lmds_at(*methods[m], X_WM);
      const std::string place = fmt::format("{}, frame {}: ", judgements[m].method, frame);
      judge_frame(run.scene(), X_WM, truth, touching, lmds, place, judgements[m]);
    }
  }
  return judgements;
}

std::string judgement_table(const std::vector<Judgement>& judgements) {
  std::string text =
      "| experiment | method | LMD sets | exact LMDs | same features | in a plateau | left to rounding | "
      "missed | "
      "reported | sharing a plane | true by tolerance | untrue | touching frames | wrong contacts |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  Judgement all{"all", "both"};
  const auto row = [&](const Judgement& j) {
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", j.experiment,
                    j.method, j.frames, j.exact, j.same_features, j.same_contact, j.uncertain, j.missed,
                    j.found, j.sharing, j.tolerated, j.untrue, j.touching, j.wrong_contacts);
  };
  for (const Judgement& j : judgements) {
    row(j);
    for (auto member :
         {&Judgement::frames, &Judgement::exact, &Judgement::same_features, &Judgement::same_contact,
          &Judgement::uncertain, &Judgement::missed, &Judgement::found, &Judgement::sharing,
          &Judgement::tolerated, &Judgement::untrue, &Judgement::touching, &Judgement::wrong_contacts})
      all.*member += j.*member;
  }
  row(all);
  return text + R"(
Exact LMDs: feature pairs whose critical pair of distance meets the first-order condition on both sides in exact
arithmetic, by brute force. Each is known with the same features, or as a part of a plateau (edges or faces whose gap
changes by no more than the definition's tolerance) that the method reports as one LMD, or missed. Left to rounding:
not known, but the distance is within rounding of zero or the cutoff, or a triangle has no area. Sharing a plane:
reported LMDs in one plane of contact with another one: pieces of a plateau that tolerances tore apart, or several feet
on one plane. True by tolerance: reported LMDs that meet the condition but for a sine of 1e-9 and rounding: features
that are parallel up to rounding, and triangles that are segments. Wrong contacts: frames in which exact intersection
tests of all triangles and the method differ.
)";
}

}  // namespace lmdbench::exact
