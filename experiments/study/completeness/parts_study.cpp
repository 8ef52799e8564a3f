// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/contact_tolerance.h>

#include <fmt/format.h>
#include <study/completeness/metamorphic.h>
#include <study/completeness/parts_study.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

namespace lmdbench::completeness {
namespace {

/// Of the scale; the tolerance of the definition.
constexpr double SAME = 1e-9;
/// Of the scale: some roundings of the definition, within which an LMD may belong to what
/// intersects.
constexpr double BESIDE = 8.0 * CONTACT_ROUNDING;
/// Directions of one contact differ by no more: the largest tilt of exact meshes, once for each.
constexpr double SAME_DIRECTION = 2.0 * TILT_PER_TOLERANCE * LEAST_TOLERANCE;

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// Kinds, distances and places, for a person who looks for a difference.
std::string contacts_text(const LmdSet& lmds) {
  std::string text;
  for (const Lmd& lmd : lmds)
    text += fmt::format("  {}-{} {:.12g} at {:.12f} {:.12f} {:.12f}\n", to_string(lmd.feature_moving.kind),
                        to_string(lmd.feature_fixed.kind), lmd.distance, lmd.point_fixed.x(),
                        lmd.point_fixed.y(), lmd.point_fixed.z());
  return text;
}

}  // namespace

bool same_contacts(const LmdSet& a, const LmdSet& b, double scale, bool* beside) {
  const auto intersects = [](const Lmd& lmd) { return lmd.intersecting; };
  const bool is_beside = std::ranges::any_of(a, intersects) || std::ranges::any_of(b, intersects);
  LmdSet wanted = a, left = b;
  for (LmdSet* set : {&wanted, &left}) {
    std::erase_if(*set, intersects);
    if (is_beside &&
        std::erase_if(*set, [&](const Lmd& lmd) { return lmd.distance <= BESIDE * scale; }) > 0 &&
        beside != nullptr)
      *beside = true;
  }
  for (const Lmd& lmd : wanted) {
    const auto partner = std::find_if(left.begin(), left.end(), [&](const Lmd& other) {
      return lmd.feature_moving.kind == other.feature_moving.kind &&
             lmd.feature_fixed.kind == other.feature_fixed.kind &&
             std::abs(lmd.distance - other.distance) <= SAME * scale &&
             (lmd.point_moving - other.point_moving).norm() <= SAME * scale &&
             (lmd.point_fixed - other.point_fixed).norm() <= SAME * scale &&
             (lmd.direction - other.direction).norm() <= SAME_DIRECTION;
    });
    if (partner == left.end()) return false;
    left.erase(partner);
  }
  return left.empty();
}

bool is_at_a_border(const Scene& scene, const Pose& X_WM, double scale) {
  const auto exhaustive = make_method("exhaustive", scene);
  const LmdSet set = lmds_at(*exhaustive, X_WM);
  const auto changes = [&](const Vec3& translation, const Vec3& turn) {
    Pose moved = X_WM;
    moved.translation += translation;
    moved.rotation = Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()) * moved.rotation;
    return !same_contacts(set, lmds_at(*exhaustive, moved), 2.0 * scale);
  };
  for (const double part : {3.0, 5.0, 7.0}) {
    LmdSet rounded = set_of("exhaustive", scaled_by(1.0 / part, pair_of(scene, X_WM)));
    for (Lmd& lmd : rounded) {
      lmd.distance *= part;
      lmd.point_moving *= part;
      lmd.point_fixed *= part;
    }
    if (!same_contacts(set, rounded, 0.25 * scale)) return true;
  }
  for (const double by : {-SAME, SAME})
    for (int axis = 0; axis < 3; ++axis)
      if (changes(by * scale * Vec3::Unit(axis), Vec3::Zero()) ||
          changes(Vec3::Zero(), by * Vec3::Unit(axis)))
        return true;
  return false;
}

std::string test_line(const parts::PartsChoice& choice, const Pose& X_WM) {
  const Vec3& p = X_WM.translation;
  const Eigen::Quaterniond& q = X_WM.rotation;
  return fmt::format(
      "expect_right({{\"{}\", Coordinates::{}, {}, {}{}}}, {{Vec3({:.17g}, {:.17g}, {:.17g}), "
      "Eigen::Quaterniond({:.17g}, {:.17g}, {:.17g}, {:.17g})}});",
      choice.kind, upper_case(name_of(choice.coordinates)), choice.seed, choice.index,
      choice.poses == parts::PoseFamily::FLUSH ? ", PoseFamily::FLUSH" : "", p.x(), p.y(), p.z(), q.w(),
      q.x(), q.y(), q.z());
}

PartsResult judge_parts(const PartsStudy& study, const std::string& kind, parts::Coordinates coordinates,
                        const Complain& complain) {
  PartsResult result{kind, coordinates, 0, 0, 0, std::vector<Judgement>(variants().size())};
  for (std::size_t index = 0; index * parts::POSES_A_SCENE < study.poses; ++index) {
    parts::PartsChoice choice{kind, coordinates, study.seed, index, study.family};
    const parts::PartsScene scene = make_parts_scene(choice);
    const auto exhaustive = make_method("exhaustive", scene.scene);
    const NearestLmds nearest(scene.scene, true);
    std::vector<std::unique_ptr<Method>> methods;
    for (const Variant& variant : variants()) methods.push_back(variant.make(scene.scene));
    std::optional<parts::PartsScene> uncut;
    if (coordinates == parts::Coordinates::RECUT) {
      choice.coordinates = parts::Coordinates::EXACT;
      uncut = make_parts_scene(choice);
      choice.coordinates = coordinates;
    }
    const auto of_uncut = uncut ? make_method("exhaustive", uncut->scene) : nullptr;
    for (const Pose& pose : scene.poses) {
      const LmdSet truth = lmds_at(*exhaustive, pose);
      const auto nearest_lmd = nearest.at(pose, scene.scene.cutoff);
      ++result.poses;
      result.true_lmds += truth.size();
      std::string wrong, first;
      for (std::size_t v = 0; v < methods.size(); ++v) {
        std::string objection;
        result.judgements[v] +=
            judge(truth, lmds_at(*methods[v], pose), scene.scene, scene.diagonal, objection, nearest_lmd);
        if (objection.empty()) continue;
        wrong +=
            (wrong.empty() ? "" : ", ") + variants()[v].label + (objection == first ? "" : ": " + objection);
        first = objection;
      }
      if (!wrong.empty()) complain(test_line(choice, pose) + "  // " + wrong);
      result.wrong_poses += !wrong.empty();
      if (!uncut) continue;
      const LmdSet truth_of_uncut = lmds_at(*of_uncut, pose);
      bool beside = false;
      const bool same = same_contacts(truth, truth_of_uncut, scene.diagonal, &beside);
      result.poses_beside += beside;
      if (same) continue;
      ++result.poses_that_show_cut;
      if (is_at_a_border(uncut->scene, pose, scene.diagonal) ||
          is_at_a_border(scene.scene, pose, scene.diagonal)) {
        ++result.of_these_at_a_border;
        continue;
      }
      complain(fmt::format("{}  // the cut shows; exact:\n{}recut:\n{}", test_line(choice, pose),
                           contacts_text(truth_of_uncut), contacts_text(truth)));
    }
  }
  return result;
}

}  // namespace lmdbench::completeness
