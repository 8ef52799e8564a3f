// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/critical_index.h>
#include <lmdbench/decision/pair_conditions.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <optional>

namespace lmdbench {

namespace {

using CornerKind = SignedFeatures::CornerKind;

// The quantities whose signs neighbouring features share, each computed in one form: when one of
// them changes its sign a foot leaves a feature and enters its neighbour, with the same bits.

/// > 0: x lies beyond v on the way along the chain from v to o.
double beyond_corner(const Vec3& x, const Vec3& v, const Vec3& o) {
  return (x - v).dot(o - v);
}

using LongVec3 = Eigen::Matrix<long double, 3, 1>;

/// A product in double below this part of its bound may have lost its sign: it is made again in
/// long double. Edges parallel but for GENERIC_TURN have them at gaps of 1e-6 of their length.
constexpr double LOST_SIGN = 0x1p-44;

template <class Vector>
auto along_chain_of(const Vector& r, const Vector& a, const Vector& b) {
  return r.dot(a) * b.squaredNorm() - r.dot(b) * a.dot(b);
}

/// > 0: d, from v to its foot on a line of another mesh, has a component along the chain from v to
/// o. Also the place on that chain, from v, of the foot of the common perpendicular.
double along_chain(const Vec3& v, const Vec3& o, const std::array<Vec3, 2>& line) {
  const Vec3 r = line[0] - v, a = o - v, b = line[1] - line[0];
  const double value = along_chain_of(r, a, b), size = LOST_SIGN * b.squaredNorm();
  if (value * value > size * size * r.squaredNorm() * a.squaredNorm()) return value;
  const LongVec3 from = v.cast<long double>(), start = line[0].cast<long double>();
  return static_cast<double>(along_chain_of<LongVec3>(start - from, o.cast<long double>() - from,
                                                      line[1].cast<long double>() - start));
}

/// Volume that two lines span: > 0 if the second lies on the side of a x b.
double orientation_of(const std::array<Vec3, 2>& first, const std::array<Vec3, 2>& second) {
  const Vec3 a = first[1] - first[0], b = second[1] - second[0], r = second[0] - first[0];
  const double value = r.dot(a.cross(b)), size = LOST_SIGN * LOST_SIGN * r.squaredNorm();
  if (value * value > size * a.squaredNorm() * b.squaredNorm()) return value;
  const LongVec3 start = first[0].cast<long double>(), other = second[0].cast<long double>();
  const LongVec3 a_long = first[1].cast<long double>() - start,
                 b_long = second[1].cast<long double>() - other;
  return static_cast<double>((other - start).dot(a_long.cross(b_long)));
}

/// > 0: the point x lies on a region's side of one of its chains.
double inside_chain(const Vec3& x, const std::array<Vec3, 2>& chain, const Vec3& normal, double sense) {
  return sense * (x - chain[0]).dot(normal.cross(chain[1] - chain[0]));
}

Vec3 normal_of(const ShapeSide& side, std::int32_t region) {
  return side.direction(side.shape.regions.planes[static_cast<std::size_t>(region)].normal);
}

std::array<Vec3, 2> ends_of(const ShapeSide& side, std::int32_t chain) {
  const auto& ends = side.shape.ends_of_chain(chain);
  return {side.vertex(ends[0]), side.vertex(ends[1])};
}

/// i(f, u), and whether nothing round f reaches farther along u than f itself.
struct Sign {
  int index = 0;
  bool is_lowest = false;
};

/// Sign of a corner.
/// @param rises  whether u has a component along the chain to a vertex
template <class Rises>
Sign sign_of_corner(const ShapeSide& side, const SignedFeatures& signs, std::int32_t vertex, const Vec3& u_W,
                    Rises&& rises) {
  const SignedFeatures::Corner& corner = signs.corners[static_cast<std::size_t>(vertex)];
  const auto others = signs.others_of(corner);
  if (corner.kind == CornerKind::NONE) return {};
  const Vec3 u = side.direction_to_surface(u_W);
  const auto next = [&](std::size_t k) { return k + 1 < others.size() ? k + 1 : 0; };
  if (corner.kind == CornerKind::SIMPLE) {
    if (!(u.dot(corner.outward) > 0.0)) return {};
    int index = 1;
    bool is_lowest = true;
    const bool first_falls = !rises(others[0]);
    bool falls = first_falls;
    for (std::size_t k = 0; k < others.size(); ++k) {
      const bool next_falls = next(k) == 0 ? first_falls : !rises(others[k + 1]);
      const Vec3& inner = signs.inner[corner.first + k];
      if (falls) --index;
      is_lowest = is_lowest && falls;
      if (inner.isZero(0.0))
        index += falls && next_falls;
      else if (u.dot(inner) <= 0.0)
        index += falls + next_falls - 1;
      falls = next_falls;
    }
    return {index, is_lowest};
  }
  // Winding number: sum over signed triangles from `outward` to the polygon of normals that hold u.
  const auto normal_at = [&](std::size_t k) -> const Vec3& {
    return side.shape.regions.planes[static_cast<std::size_t>(signs.regions[corner.first + k])].normal;
  };
  int index = corner.away;
  const Vec3 across = u.cross(corner.outward);
  for (std::size_t k = 0; k < others.size(); ++k) {
    // Normals before and after the chain next(k).
    const Vec3 &n = normal_at(k), &m = normal_at(next(k));
    const bool left = across.dot(n) > 0.0, next_left = across.dot(m) > 0.0;
    if (left == next_left) continue;
    const Vec3 product = n.cross(m);
    const Vec3 along = side.vertex_S(others[next(k)]) - side.vertex_S(vertex);
    const bool convex = product.dot(along) < 0.0;
    const bool within = convex ? !rises(others[next(k)]) : rises(others[next(k)]);
    const bool positive = corner.outward.dot(product) > 0.0;
    if (positive && left && within) ++index;
    if (!positive && next_left && !within) --index;
  }
  return {index, std::ranges::none_of(others, rises)};
}

/// Sign of a chain, for u square to it.
/// @param inside  whether u has a component into either region
Sign sign_of_chain(const ShapeSide& side, const SignedFeatures::Chain& chain, const Vec3& u_W,
                   const std::array<bool, 2>& inside) {
  const Vec3 outward = normal_of(side, chain.sides[0].region) + normal_of(side, chain.sides[1].region);
  if (!(u_W.dot(outward) > 0.0)) return {};
  return {1 - static_cast<int>(inside[0]) - static_cast<int>(inside[1]), !inside[0] && !inside[1]};
}

/// Whether a region holds the foot of x: a triangle by its sides, a polygon by a ray's crossings.
bool holds_foot(const ShapeSide& side, const SignedFeatures& signs, std::int32_t region, const Vec3& normal,
                const Vec3& x) {
  const RegionShape* shape = side.shape.shapes.of_region(region);
  const auto row = side.shape.regions.straight_edges_of_region[region];
  const auto sense_of = [&](std::int32_t c) {
    const SignedFeatures::Chain& chain = signs.chains[static_cast<std::size_t>(c)];
    return chain.sides[chain.sides[0].region == region ? 0 : 1].sense;
  };
  if (shape == nullptr)
    return std::ranges::all_of(row, [&](std::int32_t c) {
      return signs.chains[static_cast<std::size_t>(c)].has_index &&
             inside_chain(x, ends_of(side, c), normal, sense_of(c)) > 0.0;
    });
  const auto height = [&](const Vec3& p_S) { return shape->frame.flat(p_S).y(); };
  const double level = height(side.point_to_surface(x));
  int winding = 0;
  for (const std::int32_t c : row) {
    if (!signs.chains[static_cast<std::size_t>(c)].has_index) return false;
    const double sense = sense_of(c);
    const auto& ends = side.shape.ends_of_chain(c);
    double from = height(side.vertex_S(ends[0])), to = height(side.vertex_S(ends[1]));
    if (sense < 0.0) std::swap(from, to);
    const bool up = from <= level && level < to, down = to <= level && level < from;
    if (!up && !down) continue;
    const bool inside = inside_chain(x, ends_of(side, c), normal, sense) > 0.0;
    if (up && inside) ++winding;
    if (down && !inside) --winding;
  }
  return winding > 0;
}

/// Reads the signs of a pair's conditions (pair_conditions.h): whether feet are on their features,
/// i(f, u) and i(g, -u), and whether nothing round either feature is nearer.
class SignReader {
 public:
  SignReader(const SignedPair::Side& moving, const SignedPair::Side& fixed, double reach, const FeatureId& f,
             const FeatureId& g, ContactSet& found)
      : moving_(moving), fixed_(fixed), reach_(reach), f_(f), g_(g), found_(found) {}

  // Conditions.

  static bool is_long(const Line&) {
    return true;
  }  // A chain with an index is one between triangles with area.
  static bool has_area(const Plane&) { return true; }
  bool near(const ShapeSide&, const Vec3&, const Vec3&, const Vec3& d) const {
    return d.squaredNorm() <= reach_ * reach_;
  }
  static bool above(const ShapeSide&, double height, const auto&) { return height > 0.0; }
  bool below_reach(const ShapeSide&, double height, const auto&) const { return height <= reach_; }
  static bool foot_on(const ShapeSide&, const Vec3& p, const Line& line, double) {
    return beyond_corner(p, line.ends[0], line.ends[1]) > 0.0 &&
           beyond_corner(p, line.ends[1], line.ends[0]) > 0.0;
  }
  static double clamped(double parameter) { return parameter; }
  static bool in_box(const ShapeSide&, double, const auto&) { return true; }
  static bool in_triangle(const ShapeSide&, double, const Vec3&, const Vec3&, const auto&) { return true; }
  static bool parallel(double) { return false; }
  /// The distance of the lines comes first: it rejects most pairs.
  bool crosses(const Line& a, const Line& b, const Vec3& product, double) {
    orientation_ = orientation_of(a.ends, b.ends);
    const double squared = product.squaredNorm();
    return orientation_ * orientation_ <= reach_ * reach_ * squared && squared > 0.0;
  }
  bool feet_on(const Crossing& x) {
    s_ = along_chain(x.a.ends[0], x.a.ends[1], x.b.ends);
    return s_ > 0.0 && along_chain(x.a.ends[1], x.a.ends[0], x.b.ends) > 0.0 &&
           along_chain(x.b.ends[0], x.b.ends[1], x.a.ends) > 0.0 &&
           along_chain(x.b.ends[1], x.b.ends[0], x.a.ends) > 0.0;
  }
  std::optional<Vec3> perpendicular(const Crossing& x) const { return sense_of_product() * x.product; }

  bool in_cone(const ShapeSide& side, const FeatureId&, const Vec3& u, const BetweenPoints& how) {
    return take(sign_of_corner(side, signs_of(side), feature_of(side).index, u, [&](std::int32_t o) {
      return beyond_corner(how.to, how.from, side.vertex(o)) > 0.0;
    }));
  }
  bool in_cone(const ShapeSide& side, const FeatureId& lead, const Vec3& u, const SquareToLine& how) {
    if (lead.kind == FeatureKind::VERTEX)
      return take(sign_of_corner(side, signs_of(side), lead.index, u, [&](std::int32_t o) {
        return along_chain(how.point, side.vertex(o), how.line.ends) > 0.0;
      }));
    return take_chain(side, u, [&](const SignedFeatures::ChainSide& of_chain) {
      return inside_chain(how.point, how.line.ends, normal_of(side, of_chain.region), of_chain.sense) > 0.0;
    });
  }
  bool in_cone(const ShapeSide& side, const FeatureId&, const Vec3& u, const AlongNormal& how) {
    return take(sign_of_corner(side, signs_of(side), feature_of(side).index, u, [&](std::int32_t o) {
      return (side.vertex(o) - how.point).dot(how.normal) < 0.0;
    }));
  }
  bool in_cone(const ShapeSide& side, const FeatureId&, const Vec3& u, const Crossing& x) {
    const Vec3& other = side.is_moving ? x.b.along : x.a.along;
    return take_chain(side, u, [&](const SignedFeatures::ChainSide& of_chain) {
      return -sense_of_product() * of_chain.sense * other.dot(normal_of(side, of_chain.region)) > 0.0;
    });
  }

  // Pairs that satisfy all.

  void share_points(const Vec3& p, const Vec3& q, const Vec3&) { add(p, q); }
  void share_foot(const ShapeSide& of_corner, const ShapeSide&, const Vec3& p, const Vec3&, const Line& line,
                  double) {
    const Vec3 q = line.at((p - line.ends[0]).dot(line.along) / line.along.squaredNorm());
    add(of_corner.is_moving ? p : q, of_corner.is_moving ? q : p);
  }
  void share_height(const ShapeSide& of_corner, const Vec3& p, const ShapeSide& of_region, const Plane& plane,
                    double height) {
    if (!holds_foot(of_region, signs_of(of_region), feature_of(of_region).index, plane.normal, p)) return;
    const Vec3 q = p - height * plane.normal;
    add(of_corner.is_moving ? p : q, of_corner.is_moving ? q : p);
  }
  void share_perpendicular(const Crossing& x) {
    const Vec3 p = x.a.at(s_ / x.squared_product);
    add(p, p + orientation_ / x.squared_product * x.product);
  }
  static void face_region(const auto&...) {}
  static void face_each_other(const auto&...) {}

 private:
  const SignedFeatures& signs_of(const ShapeSide& side) const {
    return (side.is_moving ? moving_ : fixed_).signs;
  }
  const FeatureId& feature_of(const ShapeSide& side) const { return side.is_moving ? f_ : g_; }
  double sense_of_product() const { return orientation_ > 0.0 ? 1.0 : -1.0; }
  bool take(const Sign& sign) {
    index_ *= sign.index;
    is_lowest_ = is_lowest_ && sign.is_lowest;
    return index_ != 0;
  }
  template <class Inside>
  bool take_chain(const ShapeSide& side, const Vec3& u, Inside&& inside) {
    const SignedFeatures::Chain& chain =
        signs_of(side).chains[static_cast<std::size_t>(feature_of(side).index)];
    return take(sign_of_chain(side, chain, u, {inside(chain.sides[0]), inside(chain.sides[1])}));
  }
  void add(const Vec3& p, const Vec3& q) {
    Contact& contact = found_.contacts.emplace_back();
    contact.moving = f_;
    contact.fixed = g_;
    contact.point_moving = p;
    contact.point_fixed = q;
    const Vec3 d = q - p;
    contact.distance = contact.least_gap = d.norm();
    contact.direction = d / contact.distance;
    contact.is_minimum = false;
    contact.index = index_;
    contact.is_basin = is_lowest_;
  }

  const SignedPair::Side &moving_, &fixed_;
  double reach_;
  const FeatureId f_, g_;  ///< Of the shapes.
  ContactSet& found_;
  int index_ = 1;
  bool is_lowest_ = true;
  double orientation_ = 0.0, s_ = 0.0;  ///< Of lines that cross.
};

}  // namespace

RigidTransform generic_pose(const RigidTransform& X_WM, double extent) {
  static const Mat3 turn =
      Eigen::AngleAxisd(GENERIC_TURN, Vec3(0.5377, 0.6180, -0.5736).normalized()).toRotationMatrix();
  RigidTransform turned = X_WM;
  turned.rotation = X_WM.rotation * turn;
  // About a point that is no vertex, as the origin often is.
  const Vec3 still = extent * Vec3(0.31, -0.47, 0.83);
  turned.translation += X_WM.rotation * (still - turn * still);
  return turned;
}

SignedPair::SignedPair(const ShapePair& pair, const SignedFeatures& moving, const SignedFeatures& fixed)
    : turned_(generic_pose(pair.moving.X_WS, pair.moving.shape.regions.extent)),
      moving_{{pair.moving.surface, pair.moving.shape, turned_, true}, moving},
      fixed_{pair.fixed, fixed},
      reach_(pair.tolerance.reach) {}

void SignedPair::append(const FeatureId& on_moving, const FeatureId& on_fixed, ContactSet& found) const {
  const auto feature_of = [](const Side& side, const FeatureId& lead) {
    const FeatureId feature = side.shape.feature_of_lead(lead);
    return feature.kind != FeatureKind::EDGE || feature.index < 0 ||
                   side.signs.chains[static_cast<std::size_t>(feature.index)].has_index
               ? feature
               : FeatureId{FeatureKind::EDGE, -1};
  };
  const FeatureId f = feature_of(moving_, on_moving), g = feature_of(fixed_, on_fixed);
  if (f.index < 0 || g.index < 0) return;
  SignReader reader(moving_, fixed_, reach_, f, g, found);
  PairConditions(reader).ask(moving_.shape, on_moving, fixed_.shape, on_fixed);
}

void decide_critical(const ShapePair& pair, const SignedPair& signs, const FeatureId& on_moving,
                     const FeatureId& on_fixed, ContactSet& found) {
  const std::size_t before = found.contacts.size();
  decide(pair, on_moving, on_fixed, found);
  const std::size_t between = found.contacts.size();
  signs.append(on_moving, on_fixed, found);
  if (found.contacts.size() == between || between != before + 1 || found.contacts[before].dimension != 0 ||
      !found.contacts.back().is_basin)
    return;
  found.contacts[before].index = found.contacts.back().index;
  found.contacts[before].is_basin = found.contacts.back().is_basin;
  found.contacts.pop_back();
}

}  // namespace lmdbench
