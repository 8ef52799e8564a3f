// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <support/convex_bodies.h>
#include <support/lmd_text.h>
#include <support/rounded.h>
#include <support/scenes.h>

#include <cstdlib>

/// Two convex bodies that are apart have exactly one LMD at every pose, at their distance.
namespace lmdbench {
namespace {

using testing::ConvexBody;
using testing::text;
using testing::uniform;

/// LMDBENCH_CONVEX_SCENES, or a few.
int scene_count() {
  const char* const wanted = std::getenv("LMDBENCH_CONVEX_SCENES");
  return wanted != nullptr ? std::atoi(wanted) : 150;
}
std::uint64_t first_seed() {
  const char* const wanted = std::getenv("LMDBENCH_CONVEX_SEED");
  return wanted != nullptr ? static_cast<std::uint64_t>(std::atoll(wanted)) : 0;
}

TEST(ConvexBodies, HaveOneLmdAtEveryPose) {
  int asked = 0, touching = 0;
  for (int s = 0; s < scene_count(); ++s) {
    const std::uint64_t seed = first_seed() + static_cast<std::uint64_t>(s);
    std::mt19937_64 random(seed);
    const ConvexBody moving = testing::random_convex_body(random),
                     fixed = testing::random_convex_body(random);
    const bool is_turned = random() % 2 == 0;
    const Pose whole = is_turned ? testing::pose_of_seed(random()) : Pose{};
    TriangleMesh mesh_fixed = fixed.mesh(random() % 2 == 0);
    if (is_turned) mesh_fixed = testing::placed(std::move(mesh_fixed), whole);
    const Scene scene = testing::make_scene(moving.mesh(random() % 2 == 0), std::move(mesh_fixed), 0.6);
    const Body &a = *scene.moving, &b = *scene.fixed[0];
    const auto truth = make_method("exhaustive", scene), certified = make_method("certified", scene);
    for (int k = 0; k < 20; ++k) {
      Pose pose = testing::flush_pose(moving, fixed, random);
      if (is_turned) pose = whole * pose;
      const double apart = nearest_pair(a, b, pose).distance;
      const ContactTolerance tolerance = ContactTolerance::of(a, b, RigidTransform(pose), scene.cutoff);
      if (!(apart > 4.0 * tolerance.rounding)) {
        ++touching;
        continue;
      }
      ++asked;
      for (const auto& method : {truth.get(), certified.get()}) {
        const LmdSet lmds = lmds_at(*method, pose);
        const bool right = lmds.size() == 1 && lmds[0].distance >= apart - 4.0 * tolerance.rounding &&
                           lmds[0].distance <= apart + tolerance.widest_tie(apart);
        EXPECT_TRUE(right) << method->description().name << ", scene " << seed << " pose " << k << ", apart "
                           << fmt::format("{:.17g}", apart) << "\n"
                           << text(pose) << "\n"
                           << text(lmds);
      }
    }
  }
  EXPECT_GT(asked, 5 * touching);
}

}  // namespace
}  // namespace lmdbench
