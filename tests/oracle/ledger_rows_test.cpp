// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>

#include <gtest/gtest.h>
#include <judge/exact_distance.h>

/// Rows of the disagreement ledger, as lmdbench-judge ledger prints them. They show that a row can
/// be reproduced, and keep two errors of FCL's kernel on parallel edges.
namespace lmdbench {
namespace {

using testing::exact_distance;

/// Two cubes that slide past each other, 4.8 mm apart: FCL reports a contact.
TEST(LedgerRows, ExtremeFlushCubesFrame72) {
  const Pose X_WM{Vec3(-0.053444571428571418, -0.033325714285714292, 0.037769142857142862),
                  Eigen::Quaterniond(-0.50709255283710997, 0.1690308509457033, 0.67612340378281321,
                                     0.50709255283710997)};  // w, x, y, z
  {
    // the nearest pair: triangle 4 of the moving mesh and 36 of fixed mesh 0
    const Triangle moving_M{Vec3(-0.029999999999999999, 0, -0.029999999999999999),
                            Vec3(-0.029999999999999999, 0.029999999999999999, 0),
                            Vec3(-0.029999999999999999, 0.029999999999999999, -0.029999999999999999)};
    const Triangle fixed_W{Vec3(-0.0068571428571428603, -0.038571428571428569, -0.016285714285714289),
                           Vec3(0.0025714285714285752, -0.034285714285714287, 0.024857142857142852),
                           Vec3(-0.019714285714285715, -0.047142857142857139, 0.0094285714285714251)};
    EXPECT_EQ(exact_distance(RigidTransform(X_WM).triangle(moving_M), fixed_W), 0.0047999999999999996);
    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, 29.289321881345259).distance,
                     0.0048000000000000057);
    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, 1.0).distance, 0.0047999999999999987);
  }
  {
    // the pair that fcl names: triangle 35 of the moving mesh and 36 of fixed mesh 0
    const Triangle moving_M{Vec3(-0.029999999999999999, 0, -0.029999999999999999),
                            Vec3(-0.029999999999999999, 0.029999999999999999, -0.029999999999999999),
                            Vec3(0, 0.029999999999999999, -0.029999999999999999)};
    const Triangle fixed_W{Vec3(-0.0068571428571428603, -0.038571428571428569, -0.016285714285714289),
                           Vec3(0.0025714285714285752, -0.034285714285714287, 0.024857142857142852),
                           Vec3(-0.019714285714285715, -0.047142857142857139, 0.0094285714285714251)};
    EXPECT_EQ(exact_distance(RigidTransform(X_WM).triangle(moving_M), fixed_W), 0.0047999999999999996);
    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, 29.289321881345259).distance, 0);
    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, 1.0).distance, 0.0048000000000000013);
  }
}

/// Two triangles with parallel bases: FCL's distance is three and a half times too large, and so is
/// that of the meshes.
TEST(LedgerRows, ExtremeCombsFrame453) {
  const Pose X_WM{Vec3(-0.020473780035273368, 0.01002052910052911, 0.0056515249664903008),
                  Eigen::Quaterniond(0.11968797676063503, 0, 0.99281155725492332, 0)};
  {
    // the nearest pair: triangle 1 of the moving mesh and 2 of fixed mesh 0
    const Triangle moving_M{Vec3(-0.018645030268701734, -0.024471602227671026, -0.0093225151343508672),
                            Vec3(-0.018645030268701734, -0.03379411736202189, -0.0093225151343508672),
                            Vec3(0.0093225151343508655, -0.02913285979484646, 0.0093225151343508672)};
    const Triangle fixed_W{Vec3(-0.018645030268701734, -0.012818458309732441, -0.0093225151343508672),
                           Vec3(-0.018645030268701734, -0.02214097344408331, -0.0093225151343508672),
                           Vec3(0.018645030268701734, -0.014682961336602615, 0)};
    EXPECT_EQ(exact_distance(RigidTransform(X_WM).triangle(moving_M), fixed_W), 0.0088895688703011806);
    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, 42.402640317841716).distance,
                     0.031746979010289424);
    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, 1.0).distance, 0.0088895688703011806);
  }
  {
    // the pair that fcl names: triangle 1 of the moving mesh and 1 of fixed mesh 0
    const Triangle moving_M{Vec3(-0.018645030268701734, -0.024471602227671026, -0.0093225151343508672),
                            Vec3(-0.018645030268701734, -0.03379411736202189, -0.0093225151343508672),
                            Vec3(0.0093225151343508655, -0.02913285979484646, 0.0093225151343508672)};
    const Triangle fixed_W{Vec3(-0.018645030268701734, -0.024471602227671026, -0.0093225151343508672),
                           Vec3(-0.018645030268701734, -0.03379411736202189, -0.0093225151343508672),
                           Vec3(0.0093225151343508655, -0.02913285979484646, 0.0093225151343508672)};
    EXPECT_EQ(exact_distance(RigidTransform(X_WM).triangle(moving_M), fixed_W), 0.010139857483826965);
    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, 42.402640317841716).distance,
                     0.010139857483826963);
    EXPECT_DOUBLE_EQ(fcl_triangle_distance(moving_M, fixed_W, X_WM, 1.0).distance, 0.010139857483826967);
  }
}

}  // namespace
}  // namespace lmdbench
