// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/filter.h>

#include <gtest/gtest.h>
#include <support/convex_bodies.h>
#include <support/rounded.h>
#include <support/shape_scene.h>

#include <random>

namespace lmdbench {
namespace {

TEST(PairFilterAgainstTheDefinition, APairThatItRejectsHasNoContact) {
  std::mt19937_64 random(1);
  std::size_t rejected = 0, contacts = 0;
  for (int s = 0; s < 60; ++s) {
    const testing::ConvexBody moving = testing::random_convex_body(random),
                              fixed = testing::random_convex_body(random);
    const Pose whole = s % 2 == 0 ? Pose{} : testing::pose_of_seed(random());
    // Every fourth scene has saddles and reflex chains.
    testing::ShapeScene scene(s % 4 == 3 ? make_l_block(1.0) : moving.mesh(s % 3 == 0),
                              testing::placed(fixed.mesh(), whole), 0.5);
    for (int k = 0; k < 8; ++k) {
      const ShapePair pair = scene.at(whole * testing::flush_pose(moving, fixed, random));
      const double touch = 4e-8 * pair.tolerance.coordinates;
      const PairFilter filter{scene.moving(),
                              pair.moving.X_WS,
                              scene.fixed(),
                              pair.tolerance.reach,
                              pair.tolerance.rounding,
                              touch,
                              1e-5,
                              1e-8 * pair.tolerance.coordinates,
                              scene.shape_moving(),
                              scene.shape_fixed()};
      for (const FeatureId& f : testing::leads_of(scene.moving(), scene.shape_moving()))
        for (const FeatureId& g : testing::leads_of(scene.fixed(), scene.shape_fixed())) {
          ContactSet set;
          decide(pair, f, g, set);
          // Corners nearer than touch to corners and chains are found by the triangles that touch.
          std::erase_if(set.contacts, [&](const Contact& c) {
            return c.distance < touch && c.moving.kind != FeatureKind::FACE &&
                   c.fixed.kind != FeatureKind::FACE &&
                   (c.moving.kind == FeatureKind::VERTEX || c.fixed.kind == FeatureKind::VERTEX);
          });
          contacts += set.contacts.size();
          if (filter(f, g, 2.0).verdict != PairVerdict::NO_LMD) continue;
          ++rejected;
          EXPECT_TRUE(set.contacts.empty()) << "scene " << s << " pose " << k << ": " << to_string(f.kind)
                                            << " " << f.index << " - " << to_string(g.kind) << " " << g.index;
        }
    }
  }
  EXPECT_GT(rejected, 100000u);
  EXPECT_GT(contacts, 1000u);
}

}  // namespace
}  // namespace lmdbench
