// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/overlap.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>
#include <support/rounded.h>
#include <support/shape_scene.h>
#include <support/sheets.h>
#include <support/sleeves.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

/// Overlaps of polygons with holes against exact clipping of their triangles, pair by pair.
namespace lmdbench {
namespace {

using testing::make_gear;
using testing::make_ring;
using testing::ShapeScene;
using testing::sheet_of;
using testing::uniform;

using Rational = boost::multiprecision::cpp_rational;
struct Exact {
  Rational x, y;
};
using ExactPolygon = std::vector<Exact>;

Rational turn(const Exact& a, const Exact& b, const Exact& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

ExactPolygon clipped(ExactPolygon polygon, const ExactPolygon& by) {
  for (std::size_t k = 0; k < by.size() && !polygon.empty(); ++k) {
    const Exact &p = by[k], &q = by[(k + 1) % by.size()];
    ExactPolygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Exact &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const Rational of_a = turn(p, q, a), of_b = turn(p, q, b);
      if (of_a >= 0) kept.push_back(a);
      if ((of_a > 0 && of_b < 0) || (of_a < 0 && of_b > 0)) {
        const Rational s = of_a / (of_a - of_b);
        kept.push_back({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)});
      }
    }
    polygon = std::move(kept);
  }
  return polygon;
}

/// Whether two convex polygons with an area share a point.
bool share_a_point(const ExactPolygon& a, const ExactPolygon& b) {
  const auto separates = [](const ExactPolygon& x, const ExactPolygon& y) {
    for (std::size_t k = 0; k < x.size(); ++k)
      if (std::ranges::all_of(y, [&](const Exact& p) { return turn(x[k], x[(k + 1) % x.size()], p) < 0; }))
        return true;
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

struct Part {
  double area;
  Vec2 centroid;
};

/// Connected parts of the overlap of two regions, from their triangles.
std::vector<Part> exact_overlap(const ShapeSide& a, std::int32_t region_a, const ShapeSide& b,
                                std::int32_t region_b, const PlanarFrame& frame) {
  struct Flat {
    ExactPolygon exact;
    ConvexPolygon rough;
  };
  const auto triangles_of = [&](const ShapeSide& side, std::int32_t region) {
    std::vector<Flat> triangles;
    for (const std::int32_t t : side.shape.regions.region_triangles[region]) {
      const Triangle corners = side.surface.mesh.triangle(t);
      const ConvexPolygon rough(frame, side.is_moving ? side.X_WS.triangle(corners) : corners);
      ExactPolygon exact;
      for (const Vec2& x : rough.corners) exact.push_back({Rational(x[0]), Rational(x[1])});
      triangles.push_back({std::move(exact), rough});
    }
    return triangles;
  };
  struct Cut {
    ExactPolygon polygon;
    Box2 box;
    double area;
    Vec2 moment;
  };
  std::vector<Cut> cuts;
  const std::vector<Flat> of_a = triangles_of(a, region_a), of_b = triangles_of(b, region_b);
  for (const Flat& s : of_a)
    for (const Flat& t : of_b) {
      if (!s.rough.touches(t.rough, 1e-9)) continue;
      Cut cut{clipped(s.exact, t.exact), {}, 0.0, Vec2::Zero()};
      Rational twice = 0, x = 0, y = 0;
      for (std::size_t k = 1; k + 1 < cut.polygon.size(); ++k) {
        const Exact &p = cut.polygon[0], &q = cut.polygon[k], &r = cut.polygon[k + 1];
        const Rational part = turn(p, q, r);
        twice += part;
        x += part * (p.x + q.x + r.x);
        y += part * (p.y + q.y + r.y);
      }
      cut.area = static_cast<double>(twice) / 2.0;
      cut.moment = Vec2(static_cast<double>(x), static_cast<double>(y)) / 6.0;
      // A sliver from the rounding of both placements, where borders coincide.
      if (cut.area < 1e-12) continue;
      for (const Exact& p : cut.polygon) cut.box.add({static_cast<double>(p.x), static_cast<double>(p.y)});
      cuts.push_back(std::move(cut));
    }
  std::vector<std::size_t> label(cuts.size());
  std::iota(label.begin(), label.end(), std::size_t{0});
  for (std::size_t i = 0; i < cuts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (label[i] != label[j] && cuts[i].box.comes_within(cuts[j].box, 1e-12) &&
          share_a_point(cuts[i].polygon, cuts[j].polygon)) {
        const std::size_t from = std::max(label[i], label[j]), to = std::min(label[i], label[j]);
        for (std::size_t& l : label)
          if (l == from) l = to;
      }
  std::vector<Part> parts;
  for (std::size_t root = 0; root < cuts.size(); ++root) {
    Part part{0.0, Vec2::Zero()};
    for (std::size_t i = 0; i < cuts.size(); ++i)
      if (label[i] == root) {
        part.area += cuts[i].area;
        part.centroid += cuts[i].moment;
      }
    if (part.area == 0.0) continue;
    part.centroid /= part.area;
    parts.push_back(part);
  }
  return parts;
}

/// The region with most triangles whose normal is along an axis of its mesh.
std::int32_t region_towards(const ShapeComplex& shape, const Vec3& axis) {
  std::int32_t best = -1;
  for (std::int32_t r = 0; r < shape.regions.region_count(); ++r)
    if (shape.regions.planes[static_cast<std::size_t>(r)].normal.dot(axis) > 0.999 &&
        (best < 0 || shape.regions.region_triangles[r].size() > shape.regions.region_triangles[best].size()))
      best = r;
  return best;
}

struct Checked {
  int parts = 0, several = 0;
};

void check_overlap(const ShapePair& pair, std::int32_t r_moving, std::int32_t r_fixed, Checked& checked) {
  const PlanarFrame frame(pair.fixed.plane(r_fixed).point, -pair.fixed.plane(r_fixed).normal);
  const auto exact = exact_overlap(pair.moving, r_moving, pair.fixed, r_fixed, frame);
  const auto parts =
      overlap_of_regions(pair.moving, r_moving, pair.fixed, r_fixed, frame, 0.125 * pair.tolerance.rounding);
  // The exact parts have no slivers.
  std::vector<const OverlapPart*> real;
  for (const OverlapPart& part : parts)
    if (part.area > 2e-12) real.push_back(&part);
  ASSERT_EQ(real.size(), std::ranges::count_if(exact, [](const Part& p) { return p.area > 2e-12; }));
  checked.parts += static_cast<int>(real.size());
  checked.several += real.size() > 1 ? 1 : 0;
  for (const OverlapPart* part : real) {
    EXPECT_TRUE(std::ranges::any_of(exact,
                                    [&](const Part& other) {
                                      return std::abs(other.area - part->area) < 1e-12 &&
                                             (other.centroid - part->centroid).norm() * other.area < 1e-12;
                                    }))
        << part->area << " at " << part->centroid.transpose();
    double area = 0.0;
    for (const ConvexPolygon& piece : part->pieces) area += piece.measure().area;
    EXPECT_NEAR(area, part->area, 1e-14);
  }
}

Pose in_plane(double x, double y, double angle, bool is_upside_down) {
  Pose pose;
  pose.rotation = Eigen::AngleAxisd(angle, Vec3::UnitZ());
  if (is_upside_down) pose.rotation = pose.rotation * Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX());
  pose.translation = Vec3(x, y, 0.3);
  return pose;
}

TriangleMesh comb() {
  return sheet_of({"#.#.#.#.#", "#.#.#.#.#", "#.#.#.#.#", "#########"}, 0.125);
}
TriangleMesh perforated() {
  return sheet_of({"########", "#.##.#.#", "##.#####", "#.###..#", "###.##.#", "########"}, 0.125);
}
TriangleMesh slits() {
  return sheet_of({"#########", "#.#.#.#.#", "#.#.#.#.#", "#.#.#.#.#", "#########"}, 0.125);
}
TriangleMesh checkerboard() {
  return sheet_of({"#.#.#", ".#.#.", "#.#.#"}, 0.25);
}

TEST(Overlap, IsThatOfTheTrianglesAtRandomPosesInThePlane) {
  std::mt19937_64 random(1);
  const std::vector<std::pair<TriangleMesh, TriangleMesh>> pairs{
      {make_ring(0.5, 0.3, 24, 2), make_ring(0.45, 0.35, 30, 2)},
      {make_gear(7), make_gear(9)},
      {comb(), comb()},
      {perforated(), slits()},
      {slits(), make_ring(0.5, 0.4, 20, 2)},
      {comb(), make_gear(8)},
      {checkerboard(), perforated()}};
  Checked checked;
  for (const auto& [moving, fixed] : pairs) {
    const Pose whole = testing::pose_of_seed(random());
    for (const bool is_turned : {false, true}) {
      ShapeScene scene(moving, is_turned ? testing::placed(fixed, whole) : fixed);
      const std::int32_t r_moving = region_towards(scene.shape_moving(), Vec3::UnitZ());
      const std::int32_t r_fixed = region_towards(
          scene.shape_fixed(), is_turned ? Vec3(whole.rotation * Vec3::UnitZ()) : Vec3::UnitZ());
      for (int i = 0; i < 4; ++i) {
        const Pose pose =
            in_plane(uniform(random) - 0.5, uniform(random) - 0.5, 6.28 * uniform(random), i % 2 == 0);
        check_overlap(scene.at(is_turned ? whole * pose : pose), r_moving, r_fixed, checked);
      }
    }
  }
  EXPECT_GT(checked.parts, 60);
  EXPECT_GT(checked.several, 10);
}

TEST(Overlap, IsThatOfTheTrianglesWhereBordersLieOnEachOther) {
  std::mt19937_64 random(2);
  const std::vector<TriangleMesh> sheets{comb(), perforated(), slits()};
  Checked checked;
  for (const TriangleMesh& moving : sheets)
    for (const TriangleMesh& fixed : sheets) {
      ShapeScene scene(moving, fixed);
      for (int i = 0; i < 5; ++i) {
        // Sixteenths: whole and half squares. Not turned or upside down, which is exact.
        Pose pose = in_plane((static_cast<double>(random() % 17) - 8.0) / 16.0,
                             (static_cast<double>(random() % 13) - 6.0) / 16.0, 0.0, false);
        if (i % 2 == 0) pose.rotation = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
        check_overlap(scene.at(pose), 0, 0, checked);
      }
    }
  EXPECT_GT(checked.parts, 40);
}

/// Turned by a rounding, a side that was level passes over all that is beside it in one thin row.
TEST(Overlap, IsThatOfTheTrianglesUnderTurnsAsSmallAsRounding) {
  const std::vector<TriangleMesh> sheets{comb(), perforated(), slits(), make_ring(0.5, 0.4, 20, 2)};
  Checked checked;
  const auto check = [&](std::size_t moving, std::size_t fixed, double x, double y, int quarters, double tiny,
                         bool is_upside_down = false) {
    ShapeScene scene(sheets[moving], sheets[fixed]);
    Pose pose = in_plane(x, y, 0.5 * std::numbers::pi * quarters, is_upside_down);
    pose.rotation = Eigen::AngleAxisd(tiny, Vec3::UnitZ()) * pose.rotation;
    SCOPED_TRACE(::testing::Message() << moving << " on " << fixed << " at " << x << ", " << y
                                      << " turned by " << quarters << " quarters and " << tiny);
    check_overlap(scene.at(pose), region_towards(scene.shape_moving(), Vec3::UnitZ()),
                  region_towards(scene.shape_fixed(), Vec3::UnitZ()), checked);
  };
  std::mt19937_64 random(3);
  for (std::size_t moving = 0; moving < 3; ++moving)
    for (std::size_t fixed = 0; fixed < 3; ++fixed)
      for (int i = 0; i < 12; ++i) {
        const auto odd = [&](std::uint64_t count) {  // Of 64ths: no border lies on another one.
          return (2.0 * static_cast<double>(random() % count) + 1.0 - static_cast<double>(count)) / 64.0;
        };
        const double x = odd(34), y = odd(26) + 0.005;
        const double tiny = std::exp2(-52.0 + 12.0 * uniform(random)) * (uniform(random) < 0.5 ? -1.0 : 1.0);
        check(moving, fixed, x, y, static_cast<int>(random() % 4), tiny, i % 2 == 0);
      }
  // A wall crosses a nearly level side; corners of several pieces lie on one.
  check(2, 1, -0.296875, -0.260625, 2, 7.675888611009714e-15);
  check(3, 1, -0.234375, -0.22865910089049341, 2, 8.405424712921473e-15);
  check(3, 2, -0.453125, -0.22889124978396855, 2, 8.742063849250986e-15);
  check(3, 2, -0.234375, -0.32223289904771435, 2, -7.6013790105364426e-15, true);
  check(1, 2, 0.296875, -0.29107793763818746, 2, 2.4215104173112952e-14);
  EXPECT_GT(checked.several, 20);
}

TEST(Overlap, OfWhatIsApartIsNothingAndASliverAsWideAsRoundingIsNone) {
  ShapeScene scene(sheet_of({"##"}, 0.5), sheet_of({"##"}, 0.5));
  const auto parts_at = [&](double x) {
    const ShapePair pair = scene.at(in_plane(x, 0.0, 0.0, false));
    return overlap_of_regions(pair.moving, 0, pair.fixed, 0, PlanarFrame(Vec3::Zero(), Vec3::UnitZ()), 1e-14)
        .size();
  };
  EXPECT_EQ(parts_at(0.5), 1u);
  EXPECT_EQ(parts_at(1.0 - 1e-13), 1u);
  EXPECT_EQ(parts_at(1.0 - 1e-15), 0u);
  EXPECT_EQ(parts_at(1.0), 0u);
  EXPECT_EQ(parts_at(2.0), 0u);
}

TEST(PartsOverRegion, AreThoseOfTheTriangles) {
  std::mt19937_64 random(3);
  std::size_t several = 0;
  for (const TriangleMesh& mesh :
       {comb(), perforated(), slits(), checkerboard(), make_ring(0.5, 0.3, 24, 2), make_gear(9)}) {
    ShapeScene scene(mesh, mesh);
    const std::int32_t region = region_towards(scene.shape_moving(), Vec3::UnitZ());
    for (int i = 0; i < 80; ++i) {
      const ShapePair pair = scene.at(testing::pose_of_seed(random()));
      const Plane plane = pair.moving.plane(region);
      const PlanarFrame frame(plane.point, plane.normal);
      const auto point = [&] {
        return frame.lifted({1.4 * (uniform(random) - 0.5), 1.4 * (uniform(random) - 0.5)});
      };
      const Vec3 begin = point(), end = point();
      const auto parts =
          parts_over_region(pair.moving.point_to_surface(begin), pair.moving.point_to_surface(end),
                            pair.moving, region, pair.tolerance.rounding);
      several += parts.size() > 1 ? 1 : 0;
      const auto holds = [&](double s) {
        const Vec2 x = frame.flat(begin + s * (end - begin));
        double nearest = -1e300;  // Depth in the triangle that holds it best.
        for (const std::int32_t t : pair.moving.shape.regions.region_triangles[region]) {
          const ConvexPolygon triangle(frame,
                                       pair.moving.X_WS.triangle(pair.moving.surface.mesh.triangle(t)));
          double depth = 1e300;
          for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 side = triangle.corners[(k + 1) % 3] - triangle.corners[k];
            depth = std::min(depth, cross(side, x - triangle.corners[k]) / side.norm());
          }
          nearest = std::max(nearest, depth);
        }
        return nearest;
      };
      for (int k = 0; k < 40; ++k) {
        const double s = uniform(random), depth = holds(s);
        if (std::abs(depth) < 1e-9) continue;
        EXPECT_EQ(
            std::ranges::any_of(parts, [&](const SegmentPart& p) { return p.begin <= s && s <= p.end; }),
            depth > 0.0);
      }
      for (std::size_t k = 0; k < parts.size(); ++k) {
        EXPECT_LT(parts[k].begin, parts[k].end);
        if (k > 0) {
          EXPECT_GT(parts[k].begin, parts[k - 1].end) << "parts that meet are one";
        }
      }
    }
  }
  EXPECT_GT(several, 100u);
}

TEST(PartsOverRegion, AlongABorderItIsWholeAndBesideItNothing) {
  ShapeScene scene(slits(), slits());
  const ShapePair pair = scene.at(Pose{});
  const auto parts_at = [&](double y) {
    return parts_over_region({-2.0, y, 0.0}, {2.0, y, 0.0}, pair.fixed, 0, pair.tolerance.rounding);
  };
  const double top = 2.5 * 0.125, rounding = pair.tolerance.rounding;
  for (const double y : {top, -top, 0.1 * rounding + top}) {
    const auto parts = parts_at(y);
    ASSERT_EQ(parts.size(), 1u) << y;
    EXPECT_NEAR(parts[0].begin, (2.0 - 4.5 * 0.125) / 4.0, 1e-13);
    EXPECT_NEAR(parts[0].end, (2.0 + 4.5 * 0.125) / 4.0, 1e-13);
  }
  EXPECT_TRUE(parts_at(top + 2.0 * rounding).empty());
  EXPECT_EQ(parts_at(0.0).size(), 5u) << "over the slits";
  EXPECT_EQ(parts_at(1.5 * 0.125).size(), 1u) << "along their ends";
}

TEST(FacesAt, AreClosedAtTheReach) {
  ShapeScene scene(slits(), slits());
  const ShapePair pair = scene.at(Pose{});
  const auto holds = [&](double x, double y, double within) {
    return !for_each_face_at(pair.fixed, 0, {x, y, 0.0}, within, [](std::int32_t) { return false; });
  };
  const double right = 4.5 * 0.125;
  EXPECT_TRUE(holds(0.0, 0.0, 0.0));
  EXPECT_FALSE(holds(0.125, 0.0, 1e-12)) << "amid a slit";
  EXPECT_TRUE(holds(0.0625, 0.0, 1e-15)) << "on its border";
  EXPECT_TRUE(holds(right, 0.1, 0.0));
  for (const double within : {1e-13, 1e-9, 1e-3}) {
    EXPECT_TRUE(holds(right + 0.5 * within, 0.1, within));
    EXPECT_FALSE(holds(right + 2.0 * within, 0.1, within));
    EXPECT_TRUE(holds(0.0625 + 0.5 * within, 0.1, within));
    EXPECT_FALSE(holds(0.0625 + 2.0 * within, 0.1, within));
  }
}

TEST(RegionShape, SaysClearlyInsideAndOutsideOnlyWhereItIs) {
  std::mt19937_64 random(5);
  std::size_t inside = 0, outside = 0, unclear = 0;
  for (const TriangleMesh& mesh : {slits(), perforated(), checkerboard(), make_gear(7)}) {
    ShapeScene scene(mesh, mesh);
    const ShapePair pair = scene.at(Pose{});
    const std::int32_t region = pair.fixed.shape.region_of(0);
    const RegionShape& shape = *pair.fixed.shape.shapes.of_region(region);
    const double within = 1e-3;
    const auto place = [&](const Vec2& x) { return shape.frame.lifted(x); };
    const auto holds = [&](const Vec2& x, double spare) {
      return !for_each_face_at(pair.fixed, region, place(x), spare, [](std::int32_t) { return false; });
    };
    const auto is_near_border = [&](const Vec2& x) {
      return std::ranges::any_of(shape.sides, [&](const PolygonSide& side) {
        const Vec2 along = side.to - side.from;
        const double s = std::clamp((x - side.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
        return (side.from + s * along - x).norm() <= within;
      });
    };
    for (int k = 0; k < 4000; ++k) {
      const Vec2 x(1.4 * uniform(random) - 0.7, 1.4 * uniform(random) - 0.7);
      const std::optional<bool> clear = shape.clearly_holds(x, within);
      if (!clear) {
        ++unclear;
        continue;
      }
      ++(*clear ? inside : outside);
      EXPECT_EQ(*clear, holds(x, 1e-12));
      EXPECT_FALSE(is_near_border(x) && *clear);
      const Vec2 y = x + 0.3 * Vec2(uniform(random) - 0.5, uniform(random) - 0.5);
      if (!shape.clearly_holds_segment(x, y, within)) continue;
      for (int i = 0; i <= 50; ++i)
        EXPECT_TRUE(holds(x + i / 50.0 * (y - x), 1e-12) && !is_near_border(x + i / 50.0 * (y - x)));
    }
  }
  EXPECT_GT(inside, 2000u);
  EXPECT_GT(outside, 3000u);
  EXPECT_LT(unclear, (inside + outside) / 10);
}

TEST(RegionShape, BesideAFinOnAFaceNothingIsClearlyInside) {
  // A vertical triangle on a square: its lower side and corners are features inside the square.
  TriangleMesh mesh = sheet_of({"####", "####", "####", "####"}, 0.25);
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  ShapeScene plain(mesh, mesh);
  const RegionShape& whole = *plain.at(Pose{}).fixed.shape.shapes.of_region(0);
  EXPECT_FALSE(whole.has_features_inside);
  const auto index_at = [&](double x, double y) {
    for (std::int32_t v = 0; v < first; ++v)
      if ((mesh.vertices[static_cast<std::size_t>(v)] - Vec3(x, y, 0.0)).norm() < 1e-12) return v;
    return -1;
  };
  const std::int32_t a = index_at(0.0, 0.0), b = index_at(0.25, 0.0);
  ASSERT_GE(std::min(a, b), 0);
  mesh.vertices.emplace_back(0.1, 0.0, 0.3);
  mesh.triangles.push_back({a, b, first});
  ShapeScene scene(mesh, mesh);
  const ShapePair pair = scene.at(Pose{});
  const std::int32_t region = pair.fixed.shape.region_of(0);
  const RegionShape* shape = pair.fixed.shape.shapes.of_region(region);
  ASSERT_NE(shape, nullptr);
  EXPECT_TRUE(shape->has_features_inside);
  EXPECT_FALSE(shape->clearly_holds(shape->frame.flat(Vec3(0.125, 0.0, 0.0)), 1e-12).value_or(false));
}

}  // namespace
}  // namespace lmdbench
