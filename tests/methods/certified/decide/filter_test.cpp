// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/pair_conditions.h>
#include <lmdbench/methods/certified/decide/filter.h>

#include <gtest/gtest.h>
#include <support/convex_bodies.h>
#include <support/rounded.h>
#include <support/shape_scene.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>

namespace lmdbench {
namespace {

/// Stops at the first condition that fails by more than a margin, and keeps its name.
class Recorder {
 public:
  /// @param touch  Directions of nearer pairs are not tested. Without a margin, pairs nearer than
  /// half of it and nearly parallel lines fail.
  Recorder(double reach, double length, double sine, double touch)
      : reach_(reach), length_(length), sine_(sine), touch_(touch) {}

  std::string failed;  ///< Empty where none does.
  double value = 0.0;  ///< Of that condition, as a length where the filter takes one.

  static bool is_long(const Line& line) { return line.length > 1e-8; }
  static bool has_area(const Plane&) { return true; }
  bool near(const ShapeSide&, const Vec3&, const Vec3&, const Vec3& d) {
    return holds("near", reach_ - d.norm(), length_) &&
           (length_ > 0.0 || holds("touch", d.norm() - 0.5 * touch_, 0.0));
  }
  bool above(const ShapeSide&, double height, const auto& gradient) {
    return holds("above", height, length_) && is_unit(gradient());
  }
  bool below_reach(const ShapeSide&, double height, const auto&) {
    return holds("below_reach", reach_ - height, length_);
  }
  bool foot_on(const ShapeSide&, const Vec3&, const Line& line, double parameter) {
    return holds("foot_on", -line.beyond(parameter), length_);
  }
  static double clamped(double parameter) { return parameter; }
  bool in_box(const ShapeSide&, double inside, const auto& gradient) {
    return holds("in_box", inside, length_) && is_unit(gradient());
  }
  bool in_triangle(const ShapeSide&, double inside, const Vec3& side, const Vec3&, const auto& gradient) {
    return holds("in_triangle", inside / side.norm(), length_) && is_unit(gradient() / side.norm());
  }
  bool crosses(const Line&, const Line&, const Vec3&, double sine) {
    return (length_ > 0.0 || holds("crosses", sine - 1e-4, 0.0)) && sine > 1e-4;
  }
  bool feet_on(const Crossing& x) {
    const double beyond_a = x.a.beyond(x.s), beyond_b = x.b.beyond(x.t);
    // If both feet are equally far outside, either may count.
    const double unit = std::abs(beyond_a - beyond_b) > 1e-5 ? 1.0 : std::numeric_limits<double>::quiet_NaN();
    return holds("feet_on", -x.sine * std::max(beyond_a, beyond_b), length_, unit);
  }
  std::optional<Vec3> perpendicular(const Crossing& x) {
    const Vec3 d = x.b.at(x.t) - x.a.at(x.s);
    if (!holds("perpendicular", reach_ - d.norm(), length_) || d.norm() < touch_) return std::nullopt;
    return d;
  }
  bool parallel(double sine) { return holds("parallel", LARGEST_PARALLEL_TILT - sine, sine_); }
  bool in_cone(const ShapeSide& side, const FeatureId& lead, const Vec3& d, const auto& /*how*/) {
    const FeatureId feature = side.feature_of_lead(lead);
    const Vec3 u = side.direction_to_surface(d) / d.norm();
    return side.shape.for_each_wing(side.surface, feature, [&](const Vec3& wing) {
      return wing.norm() < 1e-8 ||
             holds(lead.kind == FeatureKind::VERTEX ? "in_cone of a corner" : "in_cone of a chain",
                   -u.dot(wing) / wing.norm(), sine_, d.norm());
    });
  }
  static void share_points(const auto&...) {}
  static void share_foot(const auto&...) {}
  static void share_height(const auto&...) {}
  static void share_perpendicular(const auto&...) {}
  static void face_region(const auto&...) {}
  static void face_each_other(const auto&...) {}

 private:
  static bool is_unit(const Vec3& gradient) {
    EXPECT_NEAR(gradient.norm(), 1.0, 1e-9);
    return true;
  }
  bool holds(const char* name, double of, double margin, double unit = 1.0) {
    if (of >= -margin) return true;
    failed = name;
    value = unit * of;
    return false;
  }
  double reach_, length_, sine_, touch_;
};

Recorder recorded(const ShapePair& pair, const FeatureId& f, const FeatureId& g, double length, double sine,
                  double touch) {
  Recorder recorder(pair.tolerance.reach, length, sine, touch);
  PairConditions(recorder).ask(pair.moving, f, pair.fixed, g);
  return recorder;
}

/// Pairs that the definition accepts pass each condition with any margin of the filter; rejected
/// pairs fail one: for all kinds of pairs, and each condition for some. The failure less the margin
/// is the certificate's slack, and its change with the motion is the gradient.
TEST(PairFilterAgainstTheDefinition, TheyDifferByMarginsAlone) {
  std::mt19937_64 random(1);
  std::map<std::string, std::size_t> rejected, moved;
  std::size_t contacts = 0;
  for (int s = 0; s < 60; ++s) {
    const testing::ConvexBody moving = testing::random_convex_body(random),
                              fixed = testing::random_convex_body(random);
    const Pose whole = s % 2 == 0 ? Pose{} : testing::pose_of_seed(random());
    // Every fourth scene has saddles and reflex chains.
    testing::ShapeScene scene(s % 4 == 3 ? make_l_block(1.0) : moving.mesh(s % 3 == 0),
                              testing::placed(fixed.mesh(), whole), 0.5);
    for (int k = 0; k < 8; ++k) {
      const Pose pose = whole * testing::flush_pose(moving, fixed, random);
      const ShapePair pair = scene.at(pose);
      const double wider = std::pow(10.0, 2.0 * testing::uniform(random));
      const double touch = 4e-8 * wider * pair.tolerance.coordinates, margin = 1e-5 * wider;
      const PairFilter filter{pair, pair.tolerance.reach, touch, margin, 1e-8 * pair.tolerance.coordinates};
      for (const FeatureId& f : testing::leads_of(scene.moving(), scene.shape_moving()))
        for (const FeatureId& g : testing::leads_of(scene.fixed(), scene.shape_fixed())) {
          SCOPED_TRACE(std::string(to_string(f.kind)) + " " + std::to_string(f.index) + " - " +
                       std::string(to_string(g.kind)) + " " + std::to_string(g.index) + ", scene " +
                       std::to_string(s) + " pose " + std::to_string(k));
          ContactSet set;
          decide(pair, f, g, set);
          // Next to touch the definition is asked, whatever the conditions say.
          const auto is_next_to_touch = [&](const Contact& c) {
            return c.distance < touch && c.moving.kind != FeatureKind::FACE &&
                   c.fixed.kind != FeatureKind::FACE &&
                   (c.moving.kind == FeatureKind::VERTEX || c.fixed.kind == FeatureKind::VERTEX);
          };
          if (std::ranges::any_of(set.contacts, is_next_to_touch)) continue;
          contacts += set.contacts.size();
          const PairAnswer answer = filter(f, g, 2.0);
          if (!set.contacts.empty()) {
            EXPECT_EQ(answer.verdict, PairVerdict::ASK);
            EXPECT_EQ(recorded(pair, f, g, 0.5 * touch, 0.5 * margin, touch).failed, "");
          }
          if (answer.verdict != PairVerdict::NO_LMD) continue;
          const Recorder before = recorded(pair, f, g, 0.0, 0.0, touch);
          EXPECT_NE(before.failed, "");
          ++rejected[before.failed];
          // The filter may name another condition that fails by more.
          const bool is_same = std::abs(answer.certificate.slack + before.value + 2.0 * touch) <= 1e-9;
          if (!is_same || before.value > -1e-4 || random() % 8 != 0) continue;
          Pose after = pose;
          const Vec3 way = 1e-6 * testing::random_direction(random);
          after.translation += way;
          const Recorder there = recorded(scene.at(after), f, g, 0.0, 0.0, touch);
          // Otherwise another condition fails first after the motion.
          if (there.failed == before.failed && std::abs(there.value - before.value) < 1e-5) {
            EXPECT_NEAR(there.value - before.value, answer.certificate.gradient.dot(way), 1e-10)
                << before.failed << ' ' << before.value;
            ++moved[before.failed];
          }
          scene.at(pose);  // `pair` is for `pose` again.
        }
    }
  }
  EXPECT_GT(contacts, 1000u);
  for (const char* name :
       {"near", "above", "below_reach", "foot_on", "in_box", "in_triangle", "crosses", "feet_on",
        "perpendicular", "parallel", "in_cone of a corner", "in_cone of a chain"})
    EXPECT_GT(rejected[name], 100u) << name;
  for (const char* name : {"near", "above", "below_reach", "foot_on", "in_box", "in_triangle", "feet_on",
                           "perpendicular", "in_cone of a corner", "in_cone of a chain"})
    EXPECT_GT(moved[name], 10u) << name;
}

}  // namespace
}  // namespace lmdbench
