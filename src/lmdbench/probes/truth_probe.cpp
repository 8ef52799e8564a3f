// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/drivers/contact_finder.h>
#include <lmdbench/drivers/render_movers.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/geometry/cone.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/probes/truth_probe.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

namespace lmdbench {

double force_angle(const Vec3& a, const Vec3& b) {
  return a.isZero(0.0) || b.isZero(0.0) ? UNSET : angle_between(a, b);
}

std::array<double, FORCE_LAW_COUNT> change_of_force(const TruthFrame& here, const TruthFrame& next) {
  std::array<double, FORCE_LAW_COUNT> change{};
  for (std::size_t law = 0; law < FORCE_LAW_COUNT; ++law)
    change[law] = (next.force[law] - here.force[law]).norm();
  return change;
}

namespace {

/// The forces of the frame's set; NaN where triangles intersect, as no force is the true one.
/// @param contacts that have searched it
void render_laws(TruthFrame& here, ContactFinder& contacts, const Scene& scene, const DriverInput& input,
                 ForceProfile profile, const Pose& X_WM) {
  const Vec3 reference_W = RigidTransform(X_WM).point(input.reference_M);
  for (const ForceLaw law : force_laws()) {
    const auto index = static_cast<std::size_t>(law);
    profile.law = law;
    const Wrench wrench = contacts.combine(here.lmds, profile, reference_W);
    here.force[index] = input.device.render(wrench, profile.largest_sum).force;
    here.torque[index] = wrench.torque;
    if (input.motion.movers)
      std::ranges::transform(
          render_movers(contacts, scene, X_WM, *input.motion.movers, profile, input.device),
          std::back_inserter(here.movers[index]), &MoverFrame::force);
  }
  if (here.contact_without_direction() == 0) return;
  const Vec3 none = Vec3::Constant(UNSET);
  here.force.fill(none);
  here.torque.fill(none);
  for (std::vector<Vec3>& forces : here.movers) std::ranges::fill(forces, none);
}

}  // namespace

std::vector<TruthFrame> probe_truth(const Scene& scene, const DriverInput& input, const ForceProfile& profile,
                                    const Aggregation& aggregation, const std::vector<std::int64_t>& frames,
                                    const Progress& progress, const std::vector<bool>* in_contact,
                                    bool reuse_repeated) {
  SceneFrames bodies(scene, input.motion);
  const MoverPlay* play = input.motion.movers.get();
  reuse_repeated = reuse_repeated && !bodies.is_any();
  const std::unique_ptr<Method> exhaustive = make_method("exhaustive", bodies.scene());
  ContactFinder contacts(aggregation, bodies.scene());
  WorkCounters ignored;
  std::optional<Pose> searched;  // pose of the last search, ...
  TruthFrame last;               // ... and its result
  const auto search = [&](std::int64_t frame) -> TruthFrame {
    const auto at = static_cast<std::size_t>(frame);
    const bool is_empty = in_contact != nullptr && !(*in_contact)[at];
    if (is_empty && play == nullptr) return {};
    const Pose& X_WM = input.poses[at];
    if (reuse_repeated && searched && same_pose(*searched, X_WM)) return last;
    bodies.to_frame(frame);
    TruthFrame found;
    if (is_empty) {
      for (std::vector<Vec3>& forces : found.movers) forces.resize(play->count(), Vec3::Zero());
    } else {
      contacts.search(*exhaustive, X_WM, found.lmds, ignored);
      render_laws(found, contacts, bodies.scene(), input, profile, X_WM);
    }
    if (reuse_repeated) {
      searched = X_WM;
      last = found;
    }
    return found;
  };
  std::vector<TruthFrame> truth;
  for (const std::int64_t frame : frames) {
    TruthFrame here = search(frame);
    here.frame = frame;
    here.force_jump = change_of_force(here, search(frame + 1));
    truth.push_back(std::move(here));
    tell_progress(progress, truth.size(), frames.size());
  }
  return truth;
}

std::int64_t TruthFrame::contact_without_direction() const {
  return std::ranges::count_if(lmds, [](const Lmd& lmd) { return lmd.direction.hasNaN(); });
}

std::vector<TruthComparison> compare_with_truth(const std::vector<TruthFrame>& truth,
                                                const MethodRecord& record, ForceLaw law,
                                                const Scene* scene) {
  std::vector<TruthComparison> comparisons;
  for (const TruthFrame& here : truth) {
    const LmdSet& lmds = record.lmds.at(here.frame);
    const auto at = static_cast<std::size_t>(here.frame);
    const FrameRecord &frame = record.frames[at], &next = record.frames[at + 1];
    const Vec3& true_force = here.force[static_cast<std::size_t>(law)];
    TruthComparison comparison;
    if (scene != nullptr) {
      comparison.same = agreement(here.lmds, lmds, Match::SAME_FEATURES, *scene);
      comparison.neighbours = agreement(here.lmds, lmds, Match::NEIGHBOURING_FEATURES, *scene);
    }
    comparison.minimum_distance_error = minimum_distance(lmds) - minimum_distance(here.lmds);
    comparison.force_error = (frame.force - true_force).norm();
    comparison.force_angle_error = force_angle(frame.force, true_force);
    const std::vector<Vec3>& forces = here.movers[static_cast<std::size_t>(law)];
    // Realtime runs render only the held object's force.
    for (std::size_t i = 0; i < forces.size() && !record.movers.empty(); ++i) {
      const Vec3& force = record.movers[at * forces.size() + i].force;
      comparison.force_error = std::max(comparison.force_error, (force - forces[i]).norm());
      const double angle = force_angle(force, forces[i]);
      if (!(angle <= comparison.force_angle_error) && !std::isnan(angle))
        comparison.force_angle_error = angle;
    }
    comparison.force_jump = (next.force - frame.force).norm();
    comparisons.push_back(comparison);
  }
  return comparisons;
}

std::optional<CompleteTruth> complete_truth(std::vector<ProbedRecord> candidates) {
  // By label, so that truth does not depend on the order of methods.
  std::sort(candidates.begin(), candidates.end(),
            [](const ProbedRecord& a, const ProbedRecord& b) { return a.record->label < b.record->label; });
  for (const auto& [record, probed] : candidates) {
    const bool stands =
        !probed->empty() && std::all_of(probed->begin(), probed->end(),
                                        [](const TruthComparison& row) { return row.same.exact(); });
    if (!stands || record->force_by_law.front().empty()) continue;
    CompleteTruth truth{record->label, record->force_by_law, {}};
    for (const FrameRecord& frame : record->frames) truth.lmd_count.push_back(frame.lmd_count);
    return truth;
  }
  return std::nullopt;
}

namespace {

/// Whether a method from outside breaks its promise.
bool breaks(Promise promise, const TruthComparison& row, double cutoff) {
  constexpr double NEAREST_TOLERANCE = 1e-5;  // cutoffs; suits single precision
  if (promise == Promise::COMPLETE_SET) return !row.same.exact();
  if (promise == Promise::APPROXIMATION || promise == Promise::FORCE_ONLY) return false;
  // NaN: nothing is near, or only one of the two has a pair.
  if (std::isnan(row.minimum_distance_error)) return row.same.true_lmds + row.same.reported > 0;
  return std::abs(row.minimum_distance_error) > NEAREST_TOLERANCE * cutoff;
}

std::unique_ptr<ProbeFindings> find_truth(const ProbedTrack& track) {
  if (track.frames.empty()) return nullptr;
  auto found = std::make_unique<TruthFindings>();
  const std::vector<bool>* empty_elsewhere =
      is_on(track.rules, Rule::TRUTH_IN_CONTACT) ? &track.in_contact : nullptr;
  const ForceProfile& force = track.profile.force;
  found->frames = probe_truth(track.profile.scene, track.input, force, *track.aggregation, track.frames,
                              track.progress, empty_elsewhere, is_on(track.rules, Rule::REPEATED_POSE));
  std::vector<ProbedRecord> candidates;
  found->comparisons.reserve(track.methods.size());
  for (std::size_t i = 0; i < track.methods.size(); ++i) {
    const MethodRecord& record = *track.records[i];
    LMDBENCH_EXPECTS(record.frames.size() == track.input.poses.size(),
                     "a record of other frames than the track's");
    const ForceLaw law = track.methods[i].profile.law;
    const MethodDescription& method = method_description(track.choices[i]->name);
    std::vector<TruthComparison>& rows =
        found->comparisons.emplace_back(compare_with_truth(found->frames, record, law, &track.profile.scene));
    if (method.promise == Promise::FORCE_ONLY)
      for (TruthComparison& row : rows) row.same = row.neighbours = {};
    // Truth of every frame comes from methods that promise the complete set and keep the promise.
    if (!method.plugin.empty()) {
      const auto broken = std::ranges::count_if(rows, [&](const TruthComparison& row) {
        return breaks(method.promise, row, track.methods[i].profile.cutoff);
      });
      if (broken > 0)
        found->doubts.push_back(
            fmt::format("{} breaks its promise ({}) in {} of {} probed frames: disqualified for that promise",
                        record.label, to_string(method.promise), broken, rows.size()));
      continue;
    }
    if (method.promise != Promise::COMPLETE_SET || method.tracks_locally) continue;
    candidates.push_back({&record, &rows});
    const auto wrong =
        std::ranges::count_if(rows, [](const TruthComparison& row) { return !row.same.exact(); });
    if (wrong > 0)
      found->doubts.push_back(
          fmt::format("{}: its set is not the exhaustive one in {} of {} probed frames, so it is not taken "
                      "for the truth of the others",
                      record.label, wrong, rows.size()));
  }
  found->complete = complete_truth(std::move(candidates));
  return found;
}

std::vector<ProbeDataset> truth_datasets() {
  using T = TruthFindings;
  using Row = const TruthComparison&;
  using Frame = const TruthFrame&;
  std::vector<ProbeDataset> all;
  const auto frames = [](const T& t, std::size_t) -> const auto& {
    return t.frames;
  };
  ProbeTable<T, TruthFrame>("truth", "K", frames)
      .column("frame", "1", "frame that was compared with truth", [](Frame t) { return t.frame; })
      .into(all);
  ProbeTable<T, TruthComparison>(
      "truth", "K", [](const T& t, std::size_t method) -> const auto& { return t.comparisons[method]; })
      .column("recall", "1", "share of true LMDs found, same features", [](Row r) { return r.same.recall(); })
      .column("precision", "1", "share of LMDs that are true, same features",
              [](Row r) { return r.same.precision(); })
      .column("recall_adjacent", "1", "share of true LMDs found, adjacent features",
              [](Row r) { return r.neighbours.recall(); })
      .column("precision_adjacent", "1", "share of LMDs that are true, adjacent features",
              [](Row r) { return r.neighbours.precision(); })
      .column("minimum_distance_error", "m", "minimum distance minus the true one",
              [](Row r) { return r.minimum_distance_error; })
      .column("force_error", "N",
              "length of the difference to the true rendered force under the same law and the profile's "
              "aggregation",
              [](Row r) { return r.force_error; })
      .column("force_angle_error", "rad", "angle to the true force",
              [](Row r) { return r.force_angle_error; })
      .column("force_jump", "N", "change of the method's force to the next frame",
              [](Row r) { return r.force_jump; })
      .into(all);
  ProbeTable<T, TruthFrame> reference("/reference", "K", frames);
  reference.column("frame", "1", "frame of the exhaustive set", [](Frame t) { return t.frame; })
      .column("lmd_count", "1", "true LMDs within the cutoff",
              [](Frame t) { return static_cast<std::int64_t>(t.lmds.size()); })
      .column("minimum_distance", "m", "smallest true LMD distance",
              [](Frame t) { return minimum_distance(t.lmds); })
      .column("contact_without_direction", "1",
              "true LMDs of triangles that intersect: with one, no force is the true one",
              [](Frame t) { return t.contact_without_direction(); });
  for (const ForceLaw law : force_laws())
    reference.column(fmt::format("force_{}", to_string(law)), "N",
                     fmt::format("rendered force of the true set, {} law", to_string(law)),
                     [law](Frame t) { return t.force[static_cast<std::size_t>(law)]; });
  for (const ForceLaw law : force_laws())
    reference.column(fmt::format("force_jump_{}", to_string(law)), "N",
                     fmt::format("change of the true force to the next frame, {} law", to_string(law)),
                     [law](Frame t) { return t.force_jump[static_cast<std::size_t>(law)]; });
  reference.into(all);
  for (const ForceLaw law : force_laws())
    all.push_back({fmt::format("/reference/movers/force_{}", to_string(law)), "K, B, 3", "N",
                   fmt::format("rendered force of the true set on each mover, {} law", to_string(law)),
                   [law](ResultWriter& writer, const DatasetInfo& info, const ProbeFindings& findings,
                         std::size_t /*method*/) {
                     const auto& truth = static_cast<const T&>(findings).frames;
                     const std::size_t movers = truth.front().movers.front().size();
                     if (movers == 0) return;
                     std::vector<double> values;
                     for (const TruthFrame& frame : truth)
                       for (const Vec3& force : frame.movers[static_cast<std::size_t>(law)])
                         values.insert(values.end(), force.begin(), force.end());
                     writer.write(info, std::span<const double>(values), {truth.size(), movers, 3});
                   }});
  return all;
}

}  // namespace

Probe truth_probe() {
  return {.name = "truth",
          .title = "truth probe",
          .parent = "/probes",
          .stride_frames = 100,
          .first_stride_frames = 20,
          .stride_text =
              "the LMD sets are compared with exhaustive truth every this many frames; 0 switches "
              "the probe off",
          .reads_lmds = true,
          .datasets = truth_datasets(),
          .why =
              [](const ProbeChoice& choice) {
                return fmt::format("exhaustive LMD sets every {} frames, outside the timed frames",
                                   choice.stride_frames);
              },
          .left_out = "probes/truth/stride_frames is 0: times of this run stand without an error",
          .run = find_truth};
}

TrueSets true_sets(const PreparedRun& run, std::int64_t checks, const Progress& progress) {
  SceneFrames bodies(run.scene(), run.input.motion);
  const std::unique_ptr<Method> certified = make_method("certified", bodies.scene());
  const std::unique_ptr<Method> exhaustive = make_method("exhaustive", bodies.scene());
  ContactFinder contacts(*run.profiles.front().aggregation, bodies.scene());
  const auto frames = static_cast<std::int64_t>(run.input.poses.size());
  TrueSets truth;
  WorkCounters ignored;
  LmdSet other;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const Pose& X_WM = run.input.poses[static_cast<std::size_t>(frame)];
    bodies.to_frame(frame);
    TruthFrame here;
    here.frame = frame;
    contacts.search(*certified, X_WM, here.lmds, ignored);
    render_laws(here, contacts, bodies.scene(), run.input, run.profiles.front().force, X_WM);
    // Spreads `checks` frames evenly over `frames`, the first one included.
    if (frame * checks / frames != (frame - 1) * checks / frames || (frame == 0 && checks > 0)) {
      other.clear();
      exhaustive->search(X_WM, other, ignored);
      ++truth.checked_frames;
      if (!agreement(other, here.lmds, Match::SAME_FEATURES, run.scene()).exact()) ++truth.wrong_frames;
    }
    if (frame > 0) truth.frames.back().force_jump = change_of_force(truth.frames.back(), here);
    truth.frames.push_back(std::move(here));
    if (progress && !progress(frame + 1, frames)) throw Interrupted();
  }
  return truth;
}

}  // namespace lmdbench
