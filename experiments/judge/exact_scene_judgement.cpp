// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/prepare.h>

#include <fmt/format.h>
#include <judge/exact_scene.h>
#include <judge/exact_scene_judgement.h>

#include <algorithm>
#include <array>
#include <memory>

namespace lmdbench::exact {
namespace {

/// @return whether something is wrong
bool judge_set(const Scene& scene, const Pose& X_WM, const std::vector<ExactLmd>& truth, bool touching,
               const LmdSet& lmds, const std::string& place, Judgement& judgement) {
  const ExactAgreement agreement = compare_with_exact(scene, X_WM, lmds, truth);
  const std::size_t failures_before = judgement.failures.size();
  const auto fail = [&](const std::string& what) {
    judgement.failures.push_back(fmt::format("{}, {}: {}", judgement.method, place, what));
  };
  ++judgement.frames;
  judgement.exact += agreement.exact;
  judgement.certain += agreement.certain;
  judgement.required += agreement.required;
  judgement.same_features += agreement.same_features;
  judgement.same_contact += agreement.same_contact;
  judgement.uncertain += agreement.uncertain;
  judgement.found += agreement.found;
  judgement.sharing += agreement.sharing;
  judgement.touching += touching;
  for (const ExactLmd& lmd : agreement.missed) {
    ++judgement.missed;
    fail("misses " + describe(lmd));
  }
  for (const Lmd& lmd : agreement.untrue) {
    const bool tolerated = within_tolerance(scene, X_WM, lmd);
    ++(tolerated ? judgement.tolerated : judgement.untrue);
    if (!tolerated) fail("untrue " + describe(lmd));
  }
  for (const Lmd& lmd : agreement.doubled) {
    ++judgement.doubled;
    fail("doubled " + describe(lmd));
  }
  for (const Lmd& lmd : agreement.misplaced) {
    ++judgement.misplaced;
    fail("misplaced " + describe(lmd));
  }
  const bool contact = std::any_of(lmds.begin(), lmds.end(), [](const Lmd& lmd) { return lmd.intersecting; });
  if (contact != touching) {
    ++judgement.wrong_contacts;
    fail(touching ? "sees no contact" : "sees contact where there is none");
  }
  const bool wrong = judgement.failures.size() > failures_before;
  judgement.wrong_frames += wrong;
  return wrong;
}

std::vector<std::string> judged_names() {
  std::vector<std::string> names;
  for (const MethodDescription& description : method_descriptions())
    if (description.promise == Promise::COMPLETE_SET) names.emplace_back(description.name);
  return names;
}

}  // namespace

std::vector<std::unique_ptr<Method>> judged_methods(const Scene& scene) {
  std::vector<std::unique_ptr<Method>> methods;
  for (const std::string& name : judged_names()) methods.push_back(make_method(name, scene));
  return methods;
}

std::vector<Judgement> empty_judgements(const std::string& scene) {
  std::vector<Judgement> judgements;
  for (const std::string& name : judged_names()) judgements.push_back({scene, name});
  return judgements;
}

bool judge_pose(const Scene& scene, const Pose& X_WM, std::span<const std::unique_ptr<Method>> methods,
                const std::string& place, std::span<Judgement> judgements) {
  const std::vector<ExactLmd> truth = exact_lmds(scene, X_WM);
  const bool touching = exactly_touching(scene, X_WM);
  bool wrong = false;
  for (std::size_t m = 0; m < methods.size(); ++m)
    wrong =
        judge_set(scene, X_WM, truth, touching, lmds_at(*methods[m], X_WM), place, judgements[m]) || wrong;
  return wrong;
}

std::vector<Judgement> judge_experiment(const std::filesystem::path& experiment_file,
                                        std::int64_t most_frames) {
  const Experiment experiment = load_experiment(experiment_file);
  const PreparedRun run = prepare(experiment);
  const auto frames = static_cast<std::int64_t>(run.input.poses.size());
  const std::int64_t samples = std::min(most_frames, frames);
  const auto methods = judged_methods(run.scene());
  std::vector<Judgement> judgements = empty_judgements(experiment.name);
  for (std::int64_t i = 0; i < samples; ++i) {
    const std::int64_t frame = samples == 1 ? 0 : i * (frames - 1) / (samples - 1);
    judge_pose(run.scene(), run.input.poses[static_cast<std::size_t>(frame)], methods,
               fmt::format("frame {}", frame), judgements);
  }
  return judgements;
}

std::string judgement_table(const std::vector<Judgement>& judgements, const char* heading) {
  std::string text = fmt::format(
      "| {} | method | LMD sets | exact LMDs | asked for | required | same features | in a plateau | left to "
      "rounding | missed | reported | sharing a plane | doubled | true by tolerance | untrue | misplaced | "
      "touching frames | wrong contacts |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      heading);
  Judgement all{"all", "both"};
  constexpr std::array COLUMNS = {
      &Judgement::frames,        &Judgement::exact,        &Judgement::certain,   &Judgement::required,
      &Judgement::same_features, &Judgement::same_contact, &Judgement::uncertain, &Judgement::missed,
      &Judgement::found,         &Judgement::sharing,      &Judgement::doubled,   &Judgement::tolerated,
      &Judgement::untrue,        &Judgement::misplaced,    &Judgement::touching,  &Judgement::wrong_contacts};
  const auto row = [&](const Judgement& j) {
    text += fmt::format("| {} | {} |", j.scene, j.method);
    for (const auto column : COLUMNS) text += fmt::format(" {} |", j.*column);
    text += "\n";
  };
  for (const Judgement& j : judgements) {
    row(j);
    for (const auto column : COLUMNS) all.*column += j.*column;
  }
  row(all);
  return text + R"(
Exact LMDs: feature pairs whose critical pair of distance meets the first-order condition on both sides in exact
arithmetic, by brute force. Each is known with the same features, or as a part of a plateau (edges or faces whose gap
changes by no more than the definition's tolerance) that the method reports as one LMD, or missed. Asked for: those that
rounding does not decide; only these can be missed. Required: reported LMDs without which one of these would be missed;
that another one is gone is not seen. Left to rounding: not known, but the distance is within rounding of zero or the
cutoff, or a triangle has no area. Sharing a plane: reported LMDs in one plane of contact with another one: pieces of a
plateau that tolerances tore apart, or doubled. Doubled: of the name or at the place of another one, or of its contact:
exact LMDs that hang together over common triangles. True by tolerance: reported LMDs that meet the condition of their
own triangles but for a sine of 1e-9 (segments and areas: the tilt at which the meshes are parallel) and rounding:
features that are nearly parallel, also where another part of the same mesh touches them without common vertices, and
triangles that are segments. Misplaced: with a point off its feature, or an intersection whose named triangles are
apart. Where on a plateau its LMD lies is not asked. Wrong contacts: frames in which exact intersection tests of all
triangles and the method differ; how many intersections there are is not asked.
)";
}

}  // namespace lmdbench::exact
