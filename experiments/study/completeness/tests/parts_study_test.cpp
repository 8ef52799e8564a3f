// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <study/completeness/parts_study.h>
#include <support/parts/prism_complex.h>

#include <array>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <string>

/// Machine parts: `certified` has the sets of `exhaustive`, which do not depend on the cut.
namespace lmdbench::completeness {
namespace {

using parts::Coordinates;
using parts::PartsChoice;
using parts::PartsKind;
using parts::PoseFamily;

/// Expects that every variant of `certified` has the set of `exhaustive`, and returns it.
LmdSet expect_same_sets(const Scene& scene, double diagonal, const Pose& X_WM) {
  const LmdSet truth = lmds_at(*make_method("exhaustive", scene), X_WM);
  for (const Variant& variant : variants()) {
    const LmdSet set = lmds_at(*variant.make(scene), X_WM);
    std::string objection;
    judge(truth, set, scene, diagonal, objection);
    EXPECT_EQ(objection, "") << variant.label;
  }
  return truth;
}

/// One pose of a scene, as lmdbench-study parts prints it.
void expect_right(const PartsChoice& choice, const Pose& X_WM) {
  SCOPED_TRACE(test_line(choice, X_WM));
  const parts::PartsScene scene = make_parts_scene(choice);
  const LmdSet truth = expect_same_sets(scene.scene, scene.diagonal, X_WM);
  if (choice.coordinates != Coordinates::RECUT) return;
  PartsChoice uncut = choice;
  uncut.coordinates = Coordinates::EXACT;
  EXPECT_TRUE(same_contacts(truth, expect_same_sets(make_parts_scene(uncut).scene, scene.diagonal, X_WM),
                            scene.diagonal))
      << "the cut shows";
}

TEST(PartsStudy, PrintsAPoseAsATest) {
  const PartsChoice choice{"ring on ring", Coordinates::TURNED, 7, 12, PoseFamily::ANY};
  EXPECT_EQ(test_line(choice, {Vec3(0.1, 0, 0), Eigen::Quaterniond::Identity()}),
            "expect_right({\"ring on ring\", Coordinates::TURNED, 7, 12}, {Vec3(0.10000000000000001, 0, 0), "
            "Eigen::Quaterniond(1, 0, 0, 0)});");
  expect_right({"block on block", Coordinates::EXACT, 1, 0},
               {Vec3(0, 0, 0.26), Eigen::Quaterniond::Identity()});
}

TEST(PartsStudy, ComparesContactsByKindAndPlace) {
  const auto lmd = [](double x, FeatureKind kind) {
    Lmd result;
    result.distance = 0.25;
    result.point_moving = Vec3(x, 0.0, 0.25);
    result.point_fixed = Vec3(x, 0.0, 0.0);
    result.direction = -Vec3::UnitZ();
    result.feature_moving = {kind, static_cast<std::int32_t>(1000.0 * x)};
    result.feature_fixed = {FeatureKind::FACE, 7};
    return result;
  };
  const Lmd one = lmd(0.1, FeatureKind::FACE), other = lmd(0.2, FeatureKind::FACE);
  EXPECT_TRUE(same_contacts({one, other}, {other, one}, 1.0));
  EXPECT_FALSE(same_contacts({one, other}, {one, one}, 1.0));
  EXPECT_FALSE(same_contacts({one}, {one, other}, 1.0));
  EXPECT_FALSE(same_contacts({one}, {lmd(0.1, FeatureKind::EDGE)}, 1.0));
  EXPECT_FALSE(same_contacts({one}, {lmd(0.1 + 1e-8, FeatureKind::FACE)}, 1.0));
  Lmd inside = one;
  inside.intersecting = true;
  EXPECT_TRUE(same_contacts({one, inside}, {one}, 1.0)) << "what intersects depends on the cut";
  EXPECT_FALSE(same_contacts({one, inside}, {other}, 1.0));
  Lmd beside = other;
  beside.distance = 5e-14;
  bool left_out = false;
  EXPECT_TRUE(same_contacts({one, inside, beside}, {one, inside}, 1.0, &left_out));
  EXPECT_TRUE(left_out);
  EXPECT_FALSE(same_contacts({one, beside}, {one}, 1.0)) << "nothing intersects";
  Lmd turned = one;
  turned.direction = -one.direction;
  EXPECT_FALSE(same_contacts({one}, {turned}, 1.0));
}

/// Three by three columns; those with a set bit are solid; the middle ones are 0.25 m wide.
std::shared_ptr<const Body> nine_columns(unsigned bits) {
  const double lines[] = {-0.5, -0.125, 0.125, 0.5};
  parts::PrismComplex solid({0.0, 0.25});
  solid.add_grid(lines, lines, [&](std::size_t i, std::size_t j) {
    return ((bits >> (3 * j + i)) & 1U) != 0 ? parts::ALL_LAYERS : parts::NO_LAYER;
  });
  return std::make_shared<const Body>("columns", build_surface(solid.mesh()));
}

// All of these fail where faces are decided triangle by triangle.

TEST(PartsStudy, ThirteenColumnsAreRight) {
  // A small pair whose contact point was wrong by 0.11.
  const Scene scene = {nine_columns(470), {nine_columns(446)}, 0.04};
  expect_same_sets(scene, 1.0,
                   {Vec3(-0.171875, 0.40625, 0.2578125),
                    Eigen::Quaterniond(Eigen::AngleAxisd(5.8134916474789105, Vec3::UnitZ()))});
}

TEST(PartsStudy, PosesThatWereFoundAreRight) {
  // Wrong points, one contact as two, features of other regions: exact faces, no tilt.
  expect_right({"slit plate on ring", Coordinates::EXACT, 2, 2},
               {Vec3(-0.375, 0.25, 0.12500008646327307),
                Eigen::Quaterniond(0.98843748132736087, 0, 0, 0.15162897317868759)});
  expect_right({"sprocket on ratchet", Coordinates::EXACT, 2, 3},
               {Vec3(0.11310026956859531, -0.49043857495653975, 0.15149278709298175),
                Eigen::Quaterniond(0.155608650186046, 0, 0, 0.9878187829694659)});
  // Borders overlap by a few 1e-9.
  expect_right({"egg crate on egg crate", Coordinates::EXACT, 2, 2},
               {Vec3(-0.24999999854546159, 0.031250006213938947, 0.93811418878956376),
                Eigen::Quaterniond(1, 0, 0, 0)});
  // Tilts of some 1e-9.
  expect_right({"nut on slotted plate", Coordinates::EXACT, 2, 0},
               {Vec3(-0.1875, -0.1875, 0.52252534075845003),
                Eigen::Quaterniond(1, -1.7151755243900191e-09, 5.0525770972272513e-10, 0)});
  expect_right({"gear on gear", Coordinates::RECUT, 2, 1},
               {Vec3(-0.12499999999976115, -0.31249999999976114, 0.15954060353441502),
                Eigen::Quaterniond(1, 8.8707628752415673e-10, 1.2129363294026798e-09, 0)});
  expect_right({"slit plate on ring", Coordinates::RECUT, 2, 2},
               {Vec3(-0.09375, -0.5, 0.12616947721437108),
                Eigen::Quaterniond(1, 2.4523623328817474e-09, -8.1833800028043225e-09, 0)});
  // Turned coordinates.
  expect_right({"slit plate on slit plate", Coordinates::TURNED, 2, 3},
               {Vec3(-0.01610029255386531, 0.96690611001602544, 0.38358265889321319),
                Eigen::Quaterniond(0.23783725258167454, 0.93062878973507845, 0.15123365061868471,
                                   -0.23343495865266103)});
  expect_right({"polycube on polycube", Coordinates::EXACT, 1, 6},
               {Vec3(0.071388623231602499, -0.23124413973568475, -0.39823987806466504),
                Eigen::Quaterniond(0.68819095895472615, 0.16245984792016782, 0.16245984990145354,
                                   0.68819096114140266)});
  // Parallel edges that touch up to rounding: their difference has no direction for a cone.
  expect_right({"retaining ring on gear", Coordinates::EXACT, 108, 27},
               {Vec3(-0.20479963923571631, -0.23941062268568203, 0.12499919112054809),
                Eigen::Quaterniond(1, 0, 1.17883980572663e-13, 0)});
  expect_right({"honeycomb on honeycomb", Coordinates::TURNED, 108, 19},
               {Vec3(-0.81515057852453432, -0.0026207494845079671, 0.3512920904039496),
                Eigen::Quaterniond(0.72313143699919447, -0.39879086308885225, 0.015337292955345194,
                                   -0.56374776255443382)});
  expect_right({"threaded rod in threaded nut", Coordinates::TURNED, 108, 40},
               {Vec3(-0.13922516500732249, -0.029131019384604662, 0.58187167550989116),
                Eigen::Quaterniond(-0.47087357376304401, 0.80848839156785568, 0.066390526035828706,
                                   0.34672308299899318)});
  // A cap inside a reflex corner beside a step of 2.4e-8 m.
  expect_right({"slit block on its copy", Coordinates::RECUT, 20261126, 76},
               {Vec3(-0.99220915180388625, 0.82689688261752003, -0.44922842577661476),
                Eigen::Quaterniond(0.7060450655708671, -0.038733922840181588, -0.70604513862579243,
                                   -0.038733846017747035)});
  // Faces on both sides of a slit of 3.5e-8 m, cut into pieces with sharp corners there.
  expect_right({"any formed shape on any formed shape", Coordinates::RECUT, 777, 178},
               {Vec3(-0.030428002831715262, -0.53139620999500459, -0.36668960959144759),
                Eigen::Quaterniond(0.18758935119039558, -0.79465640232841528, -0.49112466601667187,
                                   -0.30352594615360073)});
  // Borders overlap by 1e-13 to 1e-11: segments of one length between edges, edges and faces.
  expect_right({"egg crate on egg crate", Coordinates::RECUT, 501, 30},
               {Vec3(0.57812499998498812, 0.3105834925951006, 0.57821771595748772),
                Eigen::Quaterniond(-8.7646386605429999e-14, 0, 0, 1)});
  expect_right({"stairs on stairs", Coordinates::RECUT, 501, 21},
               {Vec3(-0.23790308567918012, 0.74999999998139422, 0.50009559374947987),
                Eigen::Quaterniond(-0.70710678118655501, 0, 0, 0.70710678118654002)});
  expect_right({"half pipe on rack", Coordinates::RECUT, 501, 30},
               {Vec3(-0.15437808873808648, -1.0000000000009441, 0.65403422037168435),
                Eigen::Quaterniond(3.5759655836946568e-11, -0, -0, -1)});
  // Edges that touch along each other, or at a corner, in no known direction, beside faces in known
  // ones.
  expect_right({"T-nut on keyway", Coordinates::RECUT, 20261126, 18},
               {Vec3(-0.78280882742895452, 0.70291365721535548, 0.24213196173202808),
                Eigen::Quaterniond(-0.089330328042982035, 0, 0, 0.99600205446160262)});
  expect_right({"ring on ring", Coordinates::RECUT, 20261126, 10},
               {Vec3(-1.5387122782630915e-15, -0.1875, 0.5625), Eigen::Quaterniond(1, 0, 0, 0)});
  // A side over a side leads from one polygon to another one, whichever pair of faces comes first.
  expect_right({"cage on cage", Coordinates::RECUT, 20261126, 29},
               {Vec3(0.74999999859591504, -0.67072076143557902, 1.0368798095673433),
                Eigen::Quaterniond(-0.70710678118654746, 2.236773357626369e-11, 1.4618844098833199e-11,
                                   0.70710678118654757)});
  // Rounded, and nearer than the planar tolerance.
  expect_right({"star prism on polycube", Coordinates::ROUNDED, 1, 9},
               {Vec3(-0.074400323817917446, 0.92235974455194869, 1.4108620553268474),
                Eigen::Quaterniond(0.24476040192141804, -0.47076035073133565, 0.22470651031198569,
                                   0.81730489292573394)});
}

TEST(PartsStudy, TellsPosesAtABorderOfTheTolerance) {
  const parts::PartsScene scene =
      parts::make_parts_scene({"block on block", Coordinates::EXACT, 1, 0, PoseFamily::ANY});
  // 0.5 wide and 0.25 high: beside each other by the width, sides are over sides.
  const auto at_border = [&](double beside) {
    return is_at_a_border(scene.scene, {Vec3(beside, 0.1, 0.26), Eigen::Quaterniond::Identity()},
                          scene.diagonal);
  };
  EXPECT_FALSE(at_border(0.2));
  EXPECT_FALSE(at_border(0.4));
  EXPECT_FALSE(at_border(0.7)) << "no LMD";
  // A turn about z moves the middle of so narrow an overlap along it, a move makes it an edge's.
  EXPECT_TRUE(at_border(0.5 - 1e-6));
  EXPECT_TRUE(at_border(0.5));
  // A face 3e-9 wide, cut otherwise: its middle lies 1.2e-9 beside, by rounding alone.
  const Pose X_WM{Vec3(-0.88470117551058758, -0.20220396228244608, -0.32789735828438243),
                  Eigen::Quaterniond(-0.20489844364268023, -0.67676925742294736, -0.67676925742294725,
                                     0.2048984436426802)};
  const parts::PartsScene thin =
      parts::make_parts_scene({"slit block on thin plate", Coordinates::EXACT, 777, 12, PoseFamily::ANY});
  EXPECT_TRUE(is_at_a_border(thin.scene, X_WM, thin.diagonal));
}

/// Share of poses where the cut may show: where a move as small as the tolerance changes the set.
constexpr double MOST_THAT_SHOW_CUT = 0.002;

/// LMDBENCH_PARTS_POSES poses of each kind in each kind of coordinates; unset: one scene a kind.
TEST(PartsStudy, FindsNothingWrong) {
  const char* const wanted = std::getenv("LMDBENCH_PARTS_POSES");
  PartsStudy study;
  study.poses = wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 1;
  study.seed = 4;
  std::string complaints;
  std::size_t lmds = 0, kind_number = 0;
  std::array<std::size_t, std::size(parts::ALL_COORDINATES)> poses{}, wrong{}, show_cut{}, at_border{};
  for (const PartsKind& kind : parts::parts_kinds()) {
    for (std::size_t c = 0; c < poses.size(); ++c) {
      if (wanted == nullptr && kind_number % poses.size() != c) continue;
      const PartsResult result = judge_parts(study, kind.name, parts::ALL_COORDINATES[c],
                                             [&](const std::string& what) { complaints += what + "\n"; });
      lmds += result.true_lmds;
      poses[c] += result.poses;
      wrong[c] += result.wrong_poses;
      show_cut[c] += result.poses_that_show_cut;
      at_border[c] += result.of_these_at_a_border;
    }
    ++kind_number;
  }
  for (std::size_t c = 0; c < poses.size(); ++c) {
    SCOPED_TRACE(name_of(parts::ALL_COORDINATES[c]) + (":\n" + complaints));
    EXPECT_EQ(wrong[c], 0u);
    EXPECT_EQ(show_cut[c], at_border[c]);
    EXPECT_LE(static_cast<double>(show_cut[c]), MOST_THAT_SHOW_CUT * static_cast<double>(poses[c]));
  }
  EXPECT_GT(lmds, 2 * parts::POSES_A_SCENE * parts::parts_kinds().size());
}

}  // namespace
}  // namespace lmdbench::completeness
