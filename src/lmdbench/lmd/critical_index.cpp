// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/critical_index.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace lmdbench {

namespace {

using CornerKind = SignedFeatures::CornerKind;

// The quantities whose signs neighbouring features share, each in one form: a foot that leaves a feature enters its neighbour
// when one of them changes its sign, in the same bits for both.

/// > 0: the point x lies beyond v on the way along the chain from v to o.
double beyond_corner(const Vec3& x, const Vec3& v, const Vec3& o) {
  return (x - v).dot(o - v);
}

using LongVec3 = Eigen::Matrix<long double, 3, 1>;

/// Of edges that are parallel but for GENERIC_TURN what is asked for is the turn times the gap: for a gap of some 1e-6 of the edges that is
/// the rounding of products of lengths. Where a product in double may have lost its sign it is made again with longer numbers.
constexpr double LOST_SIGN = 0x1p-44;

template <class Vector>
auto along_chain_of(const Vector& r, const Vector& a, const Vector& b) {
  return r.dot(a) * b.squaredNorm() - r.dot(b) * a.dot(b);
}

/// > 0: d, from v to its foot on a line of another mesh, has a component along the chain from v to o. Also the place of the
/// common perpendicular's foot beyond v on that chain.
double along_chain(const Vec3& v, const Vec3& o, const std::array<Vec3, 2>& line) {
  const Vec3 r = line[0] - v, a = o - v, b = line[1] - line[0];
  const double value = along_chain_of(r, a, b), size = LOST_SIGN * b.squaredNorm();
  if (value * value > size * size * r.squaredNorm() * a.squaredNorm()) return value;
  const LongVec3 from = v.cast<long double>(), start = line[0].cast<long double>();
  return static_cast<double>(along_chain_of<LongVec3>(start - from, o.cast<long double>() - from,
                                                      line[1].cast<long double>() - start));
}

/// Volume that two lines span, > 0 where the second one lies on the side of a x b; r leads from the first line to the second one.
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

/// Of a corner.
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
  // Signed triangles from `outward` to the polygon of normals that hold u.
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

/// Of a chain, for u square to it.
/// @param inside  whether u has a component into either region
Sign sign_of_chain(const ShapeSide& side, const SignedFeatures::Chain& chain, const Vec3& u_W,
                   const std::array<bool, 2>& inside) {
  const Vec3 outward = normal_of(side, chain.sides[0].region) + normal_of(side, chain.sides[1].region);
  if (!(u_W.dot(outward) > 0.0)) return {};
  return {1 - static_cast<int>(inside[0]) - static_cast<int>(inside[1]), !inside[0] && !inside[1]};
}

/// Whether a region holds the foot of x, by the sides of its chains: of a polygon by their crossings with a ray.
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

}  // namespace

RigidTransform generic_pose(const RigidTransform& X_WM) {
  static const Mat3 turn =
      Eigen::AngleAxisd(GENERIC_TURN, Vec3(0.5377, 0.6180, -0.5736).normalized()).toRotationMatrix();
  RigidTransform turned = X_WM;
  turned.rotation = X_WM.rotation * turn;
  return turned;
}

SignedPair::SignedPair(const ShapePair& pair, const SignedFeatures& moving, const SignedFeatures& fixed)
    : turned_(generic_pose(pair.moving.X_WS)),
      moving_{{pair.moving.surface, pair.moving.shape, turned_, true}, moving},
      fixed_{pair.fixed, fixed},
      reach_(pair.tolerance.reach) {}

void SignedPair::add(bool forward, const FeatureId& first, const FeatureId& second, const Vec3& p,
                     const Vec3& q, int index, bool is_basin, ContactSet& found) const {
  Contact& contact = found.contacts.emplace_back();
  contact.moving = forward ? first : second;
  contact.fixed = forward ? second : first;
  contact.point_moving = forward ? p : q;
  contact.point_fixed = forward ? q : p;
  const Vec3 d = contact.point_fixed - contact.point_moving;
  contact.distance = contact.least_gap = d.norm();
  contact.direction = d / contact.distance;
  contact.is_minimum = false;
  contact.index = index;
  contact.is_basin = is_basin;
}

void SignedPair::corner_corner(std::int32_t v_moving, std::int32_t v_fixed, ContactSet& found) const {
  const Vec3 p = moving_.shape.vertex(v_moving), q = fixed_.shape.vertex(v_fixed), d = q - p;
  if (!(d.squaredNorm() <= reach_ * reach_)) return;
  const Sign i = sign_of_corner(moving_.shape, moving_.signs, v_moving, d, [&](std::int32_t o) {
    return beyond_corner(q, p, moving_.shape.vertex(o)) > 0.0;
  });
  if (i.index == 0) return;
  const Sign j = sign_of_corner(fixed_.shape, fixed_.signs, v_fixed, -d, [&](std::int32_t o) {
    return beyond_corner(p, q, fixed_.shape.vertex(o)) > 0.0;
  });
  if (j.index != 0)
    add(true, {FeatureKind::VERTEX, v_moving}, {FeatureKind::VERTEX, v_fixed}, p, q, i.index * j.index,
        i.is_lowest && j.is_lowest, found);
}

void SignedPair::corner_chain(const Side& of_corner, std::int32_t vertex, const Side& of_chain,
                              std::int32_t index, ContactSet& found) const {
  const SignedFeatures::Chain& chain = of_chain.signs.chains[static_cast<std::size_t>(index)];
  if (!chain.has_index) return;
  const Vec3 p = of_corner.shape.vertex(vertex);
  const std::array<Vec3, 2> line = ends_of(of_chain.shape, index);
  if (!(beyond_corner(p, line[0], line[1]) > 0.0) || !(beyond_corner(p, line[1], line[0]) > 0.0)) return;
  const Vec3 along = line[1] - line[0];
  const Vec3 q = line[0] + (p - line[0]).dot(along) / along.squaredNorm() * along, d = q - p;
  if (!(d.squaredNorm() <= reach_ * reach_)) return;
  const auto inside = [&](std::size_t k) {
    return inside_chain(p, line, normal_of(of_chain.shape, chain.sides[k].region), chain.sides[k].sense) >
           0.0;
  };
  const Sign j = sign_of_chain(of_chain.shape, chain, -d, {inside(0), inside(1)});
  if (j.index == 0) return;
  const Sign i = sign_of_corner(of_corner.shape, of_corner.signs, vertex, d, [&](std::int32_t o) {
    return along_chain(p, of_corner.shape.vertex(o), line) > 0.0;
  });
  if (i.index != 0)
    add(of_corner.shape.is_moving, {FeatureKind::VERTEX, vertex}, {FeatureKind::EDGE, index}, p, q,
        i.index * j.index, i.is_lowest && j.is_lowest, found);
}

void SignedPair::corner_region(const Side& of_corner, std::int32_t vertex, const Side& of_region,
                               std::int32_t region, ContactSet& found) const {
  const Plane plane = of_region.shape.plane(region);
  const Vec3 p = of_corner.shape.vertex(vertex), normal = normal_of(of_region.shape, region);
  const double height = normal.dot(p - plane.point);
  if (!(height > 0.0 && height <= reach_) || !holds_foot(of_region.shape, of_region.signs, region, normal, p))
    return;
  const Sign i = sign_of_corner(of_corner.shape, of_corner.signs, vertex, -normal, [&](std::int32_t o) {
    return (of_corner.shape.vertex(o) - p).dot(normal) < 0.0;
  });
  if (i.index != 0)
    add(of_corner.shape.is_moving, {FeatureKind::VERTEX, vertex}, {FeatureKind::FACE, region}, p,
        p - height * normal, i.index, i.is_lowest, found);
}

void SignedPair::chain_chain(std::int32_t c_moving, std::int32_t c_fixed, ContactSet& found) const {
  const SignedFeatures::Chain &f = moving_.signs.chains[static_cast<std::size_t>(c_moving)],
                              &g = fixed_.signs.chains[static_cast<std::size_t>(c_fixed)];
  if (!f.has_index || !g.has_index) return;
  const std::array<Vec3, 2> on_moving = ends_of(moving_.shape, c_moving),
                            on_fixed = ends_of(fixed_.shape, c_fixed);
  const Vec3 a = on_moving[1] - on_moving[0], b = on_fixed[1] - on_fixed[0], product = a.cross(b);
  const double orientation = orientation_of(on_moving, on_fixed), squared = product.squaredNorm();
  // First what rejects most: the distance of the lines.
  if (!(orientation * orientation <= reach_ * reach_ * squared) || !(squared > 0.0)) return;
  const double s = along_chain(on_moving[0], on_moving[1], on_fixed),
               t = along_chain(on_fixed[0], on_fixed[1], on_moving);
  if (!(s > 0.0) || !(along_chain(on_moving[1], on_moving[0], on_fixed) > 0.0) || !(t > 0.0) ||
      !(along_chain(on_fixed[1], on_fixed[0], on_moving) > 0.0))
    return;
  const double side = orientation > 0.0 ? 1.0 : -1.0;
  const Vec3 u = side * product;
  const auto inside_moving = [&](std::size_t k) {
    return -side * f.sides[k].sense * b.dot(normal_of(moving_.shape, f.sides[k].region)) > 0.0;
  };
  const auto inside_fixed = [&](std::size_t k) {
    return -side * g.sides[k].sense * a.dot(normal_of(fixed_.shape, g.sides[k].region)) > 0.0;
  };
  const Sign i = sign_of_chain(moving_.shape, f, u, {inside_moving(0), inside_moving(1)});
  if (i.index == 0) return;
  const Sign j = sign_of_chain(fixed_.shape, g, -u, {inside_fixed(0), inside_fixed(1)});
  if (j.index == 0) return;
  const Vec3 p = on_moving[0] + s / squared * a;
  add(true, {FeatureKind::EDGE, c_moving}, {FeatureKind::EDGE, c_fixed}, p,
      p + orientation / squared * product, i.index * j.index, i.is_lowest && j.is_lowest, found);
}

void SignedPair::append(const FeatureId& on_moving, const FeatureId& on_fixed, ContactSet& found) const {
  using enum FeatureKind;
  const auto chain_of = [](const Side& side, const FeatureId& lead) {
    return side.shape.shape.chain_of(lead.index);
  };
  const auto region_of = [](const Side& side, const FeatureId& lead) {
    return side.shape.shape.region_of(lead.index);
  };
  if (on_moving.kind == VERTEX && on_fixed.kind == VERTEX)
    return corner_corner(on_moving.index, on_fixed.index, found);
  if (on_moving.kind == VERTEX && on_fixed.kind == EDGE)
    return corner_chain(moving_, on_moving.index, fixed_, chain_of(fixed_, on_fixed), found);
  if (on_moving.kind == EDGE && on_fixed.kind == VERTEX)
    return corner_chain(fixed_, on_fixed.index, moving_, chain_of(moving_, on_moving), found);
  if (on_moving.kind == EDGE && on_fixed.kind == EDGE)
    return chain_chain(chain_of(moving_, on_moving), chain_of(fixed_, on_fixed), found);
  if (on_moving.kind == VERTEX && region_of(fixed_, on_fixed) >= 0)
    return corner_region(moving_, on_moving.index, fixed_, region_of(fixed_, on_fixed), found);
  if (on_fixed.kind == VERTEX && region_of(moving_, on_moving) >= 0)
    return corner_region(fixed_, on_fixed.index, moving_, region_of(moving_, on_moving), found);
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
