// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/well_formed.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <functional>
#include <limits>

namespace lmdbench {
namespace {

/// Two boxes, corner over corner.
class WellFormed : public ::testing::Test {
 protected:
  WellFormed() : scene_(testing::make_scene(make_box(Vec3::Ones()), make_box(Vec3::Ones()), 1.0)) {
    const Surface& surface = scene_.moving->surface();
    lmd_.feature_moving = lmd_.feature_fixed = {FeatureKind::VERTEX, 0};
    lmd_.triangle_moving = lmd_.triangle_fixed = surface.incident_triangles(lmd_.feature_moving).front();
    lmd_.point_moving = Vec3::Zero();
    lmd_.point_fixed = Vec3(0.0, 0.0, 0.5);
    lmd_.direction = Vec3::UnitZ();
    lmd_.distance = 0.5;
  }
  bool with(const std::function<void(Lmd&)>& change) const {
    Lmd changed = lmd_;
    change(changed);
    return is_well_formed(LmdSet{changed}, scene_);
  }

  Scene scene_;
  Lmd lmd_;
};

TEST_F(WellFormed, WhatMethodsReport) {
  EXPECT_TRUE(is_well_formed(LmdSet{}, scene_));
  EXPECT_TRUE(is_well_formed(LmdSet{lmd_}, scene_));
  EXPECT_TRUE(with([](Lmd& lmd) {
    lmd.distance = 0.0;
    lmd.point_fixed = lmd.point_moving;
    lmd.direction.setConstant(std::numeric_limits<double>::quiet_NaN());
  })) << "two that touch have no direction";
  EXPECT_TRUE(with([](Lmd& lmd) {
    lmd.distance = 1e-11;
    lmd.point_fixed = Vec3(0.0, 0.0, 1e-11 + 1e-17);
  })) << "points next to the origin carry the rounding of their triangles";
}

TEST_F(WellFormed, SeesEachKindOfDamage) {
  EXPECT_FALSE(with([](Lmd& lmd) { lmd.distance = 0.6; }));
  EXPECT_FALSE(with([](Lmd& lmd) { lmd.distance = -0.5; }));
  EXPECT_FALSE(with([](Lmd& lmd) { lmd.direction *= 2.0; }));
  EXPECT_FALSE(with([](Lmd& lmd) { lmd.fixed_body = 1; }));
  EXPECT_FALSE(with([](Lmd& lmd) { lmd.triangle_fixed = -1; }));
  EXPECT_FALSE(with([](Lmd& lmd) { lmd.triangle_moving = 12; }));
  EXPECT_FALSE(with([](Lmd& lmd) {
    lmd.feature_fixed = {FeatureKind::VERTEX, 7};
  })) << "not of that triangle";
  Lmd nearer = lmd_;
  nearer.distance = 0.25;
  nearer.point_fixed *= 0.5;
  EXPECT_TRUE(is_well_formed(LmdSet{nearer, lmd_}, scene_));
  EXPECT_FALSE(is_well_formed(LmdSet{lmd_, nearer}, scene_)) << "not sorted";
}

}  // namespace
}  // namespace lmdbench
