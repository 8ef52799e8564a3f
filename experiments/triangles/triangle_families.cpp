// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <triangles/random_triangles.h>
#include <triangles/triangle_families.h>

#include <array>
#include <cmath>
#include <utility>

namespace lmdbench::testing {
namespace {

TrianglePair any_order(Random& random, const TrianglePair& pair) {
  return reordered(pair, random_index(random, 72));
}

TrianglePair uniform_pair(Random& random) {
  const Triangle a = random_triangle(random);
  return {a, random_triangle(random)};
}

TrianglePair separated_pair(Random& random) {
  TrianglePair pair = uniform_pair(random);
  const Vec3 offset = 6.0 * random_unit_vector(random);
  for (Vec3& corner : pair.b) corner += offset;
  return pair;
}

TrianglePair shared_features(Random& random) {
  TrianglePair pair = uniform_pair(random);
  const int shared = 1 + random_index(random, 3);
  for (int i = 0; i < shared; ++i) pair.b[i] = pair.a[i];
  return any_order(random, pair);
}

TrianglePair parallel_planes(Random& random) {
  TrianglePair pair;
  const double gap = log_uniform(random, 1e-6, 1.0);
  pair.a = random_triangle(random);
  pair.b = random_triangle(random);
  for (int i = 0; i < 3; ++i) {
    pair.a[i][2] = 0.0;
    pair.b[i][2] = gap;
  }
  const Vec3 sideways = (coin(random) ? 2.0 : 0.5) * random_point(random);
  for (Vec3& corner : pair.b) corner += Vec3(sideways[0], sideways[1], 0.0);
  return coin(random) ? transformed(pair, 1.0, random_rotation_matrix(random), Vec3::Zero()) : pair;
}

TrianglePair coplanar(Random& random) {
  const bool on_lattice = coin(random);
  TrianglePair pair;
  pair.a = on_lattice ? lattice_triangle(random, 5) : random_triangle(random);
  pair.b = on_lattice ? lattice_triangle(random, 5) : random_triangle(random);
  for (int i = 0; i < 3; ++i) pair.a[i][2] = pair.b[i][2] = 0.0;
  if (random_index(random, 3) == 0) {
    for (Vec3& corner : pair.b) corner = 0.3 * corner + 0.3 * (pair.a[0] + pair.a[1]);  // contained
  }
  return pair;
}

TrianglePair parallel_edges(Random& random) {
  TrianglePair pair = uniform_pair(random);
  pair.b[1] = pair.b[0] + 2.0 * uniform_coordinate(random) * (pair.a[1] - pair.a[0]);
  constexpr std::array<int, 4> STEPS{0, 1, 10, 100};
  pair.b[1] = nudged(random, pair.b[1], STEPS[random_index(random, 4)]);
  return pair;
}

TrianglePair edge_parallel_to_face(Random& random) {
  TrianglePair pair = uniform_pair(random);
  const Vec3 along = uniform_coordinate(random) * (pair.a[1] - pair.a[0]) +
                     uniform_coordinate(random) * (pair.a[2] - pair.a[0]);
  pair.b[0] = point_in(random, pair.a) + log_uniform(random, 1e-6, 1.0) * unit_normal(pair.a);
  pair.b[1] = pair.b[0] + along;
  pair.b[2] = pair.b[0] + unit_normal(pair.a) + 0.5 * random_point(random);
  return pair;
}

TrianglePair corner_over_feature(Random& random) {
  TrianglePair pair;
  pair.a = random_triangle(random);
  const Vec3 normal = unit_normal(pair.a);
  const double gap = log_uniform(random, 1e-12, 1.0);
  Vec3 foot = point_in(random, pair.a);
  const int part = random_index(random, 3);
  if (part == 1) foot = pair.a[0] + 0.5 * (uniform_coordinate(random) + 1.0) * (pair.a[1] - pair.a[0]);
  if (part == 2) foot = pair.a[0];
  pair.b[0] = foot + gap * normal;
  for (int i = 1; i < 3; ++i) {
    Vec3 way = random_point(random);
    if (way.dot(normal) < 0.0) way = -way;
    pair.b[i] = pair.b[0] + way;
  }
  return any_order(random, pair);
}

TrianglePair crossing_edges(Random& random) {
  const double tangent_of_half = 0.5 * log_uniform(random, 1e-8, 1.8);
  const double gap = log_uniform(random, 1e-12, 1.0);
  const double s = 0.4 * uniform_coordinate(random), t = 0.4 * uniform_coordinate(random);
  const double norm = 1.0 + tangent_of_half * tangent_of_half;
  const Vec3 along((1.0 - tangent_of_half * tangent_of_half) / norm, 2.0 * tangent_of_half / norm, 0.0);
  TrianglePair pair;
  pair.a = {Vec3(-1.0 - s, 0.0, 0.0), Vec3(1.0 - s, 0.0, 0.0),
            Vec3(uniform_coordinate(random), uniform_coordinate(random), -1.0)};
  pair.b[0] = -(1.0 + t) * along + Vec3(0, 0, gap);
  pair.b[1] = (1.0 - t) * along + Vec3(0, 0, gap);
  pair.b[2] = Vec3(uniform_coordinate(random), uniform_coordinate(random), 1.0 + gap);
  return transformed(pair, 1.0, random_rotation_matrix(random), random_point(random));
}

TrianglePair touching_and_piercing(Random& random) {
  TrianglePair pair;
  switch (random_index(random, 3)) {
    case 0:  // an edge through the face
      pair.a = random_triangle(random);
      pair.b[0] = point_in(random, pair.a) + unit_normal(pair.a) * log_uniform(random, 1e-9, 1.0);
      pair.b[1] = point_in(random, pair.a) - unit_normal(pair.a) * log_uniform(random, 1e-9, 1.0);
      pair.b[2] = random_point(random);
      break;
    case 1:  // a corner in the face, exact
      pair.a = {Vec3(0, 0, 0), Vec3(8, 0, 0), Vec3(0, 8, 0)};
      pair.b = lattice_triangle(random, 4);
      pair.b[0][2] = 0.0;
      break;
    default:  // an edge through an edge, exact
      pair.a = {Vec3(-4, 0, 0), Vec3(4, 0, 0), lattice_point(random, 4)};
      pair.b[0] = lattice_point(random, 3) + Vec3(0, 1, 0);
      pair.b[1] = -pair.b[0];
      pair.b[2] = lattice_point(random, 4);
  }
  return any_order(random, pair);
}

TrianglePair needles_and_caps(Random& random) {
  TrianglePair pair = uniform_pair(random);
  for (Triangle* t : {&pair.a, &pair.b}) {
    const double thickness = log_uniform(random, 1e-8, 1e-2);
    const double along = coin(random) ? 0.5 * (uniform_coordinate(random) + 1.0) : 0.0;  // needle
    (*t)[2] = (*t)[0] + along * ((*t)[1] - (*t)[0]) + thickness * random_point(random);
    if (coin(random)) break;
  }
  if (coin(random)) {
    // Near contact, where the shape matters most.
    const Vec3 move = point_in(random, pair.a) - point_in(random, pair.b) +
                      log_uniform(random, 1e-9, 0.1) * random_unit_vector(random);
    for (Vec3& corner : pair.b) corner += move;
  }
  return any_order(random, pair);
}

TrianglePair zero_area(Random& random) {
  TrianglePair pair = coin(random) ? uniform_pair(random)
                                   : TrianglePair{lattice_triangle(random, 4), lattice_triangle(random, 4)};
  const auto flatten = [&](Triangle& t) {
    switch (random_index(random, 4)) {
      case 0:
        t[2] = t[0] + 0.5 * (t[1] - t[0]);
        break;
      case 1:
        t[2] = t[1];
        break;
      case 2:
        t[1] = t[2] = t[0];
        break;
      default:
        t[2] = t[0] + 2.0 * (t[1] - t[0]);
    }
  };
  flatten(pair.a);
  if (coin(random)) flatten(pair.b);
  return any_order(random, pair);
}

TrianglePair any_scale(Random& random) {
  const TrianglePair pair = coin(random) ? uniform_pair(random) : crossing_edges(random);
  return transformed(pair, log_uniform(random, 1e-6, 1e6), Mat3::Identity(), Vec3::Zero());
}

TrianglePair far_from_origin(Random& random) {
  TrianglePair pair = coin(random) ? uniform_pair(random) : corner_over_feature(random);
  return transformed(pair, 1.0, Mat3::Identity(), log_uniform(random, 1e3, 1e6) * random_unit_vector(random));
}

TrianglePair unequal_sizes(Random& random) {
  TrianglePair pair = uniform_pair(random);
  const double ratio = log_uniform(random, 1e-4, 1.0);
  const Vec3 place = coin(random) ? point_in(random, pair.a) : random_point(random);
  for (Vec3& corner : pair.b) corner = place + ratio * corner;
  return any_order(random, pair);
}

TrianglePair integer_grid(Random& random) {
  const int extent = 2 + random_index(random, 4);
  const Triangle a = lattice_triangle(random, extent);
  return {a, lattice_triangle(random, extent)};
}

/// Faces of two aligned boxes, each face halved by a diagonal.
TrianglePair box_faces(Random& random) {
  const auto half_face = [&random](const Vec3& low, const Vec3& size) {
    const int axis = random_index(random, 3);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 corner = low;
    if (coin(random)) corner[axis] += size[axis];
    Triangle t{corner, corner, corner};
    t[1][u] += size[u];
    t[2][u] += size[u];
    t[2][v] += size[v];
    if (coin(random)) {
      t[1] = corner;
      t[1][v] += size[v];
    }
    return t;
  };
  TrianglePair pair;
  pair.a = half_face(Vec3::Zero(), Vec3::Ones());
  const Vec3 low = coin(random) ? Vec3(0.25 * lattice_point(random, 12)) : Vec3(2.0 * random_point(random));
  pair.b = half_face(low, coin(random) ? Vec3::Ones().eval() : Vec3(0.5, 1.0, 2.0));
  return coin(random) ? transformed(pair, 1.0, random_rotation_matrix(random), random_point(random)) : pair;
}

TrianglePair copies_of_one_triangle(Random& random) {
  TrianglePair pair;
  pair.a = random_triangle(random);
  const Vec3 offset = log_uniform(random, 1e-3, 3.0) * random_point(random);
  const bool turned = coin(random);  // half a turn about the z axis
  for (int i = 0; i < 3; ++i) {
    const Vec3& p = pair.a[i];
    pair.b[i] = (turned ? Vec3(-p[0], -p[1], p[2]) : p) + offset;
  }
  return any_order(random, pair);
}

/// Finite numbers at the ends of the range of doubles.
TrianglePair extreme_magnitudes(Random& random) {
  const TrianglePair pair = coin(random) ? uniform_pair(random) : corner_over_feature(random);
  const int exponent = coin(random) ? 150 + random_index(random, 250) : -150 - random_index(random, 250);
  return transformed(pair, std::ldexp(1.0, exponent), Mat3::Identity(), Vec3::Zero());
}

/// Coordinates from issue trackers of other projects, moved by a few units in the last place.
TrianglePair published_failures(Random& random) {
  // PQP issue 4; parry issue 76; a forum thread on nearly parallel segments that D. Eberly answered
  // (a third corner each); ConvexBodyProximityQueries issue 17.
  static const std::array<TrianglePair, 4> PUBLISHED{{
      {{Vec3(8000.0000000000036, 6817.7672478170962, 571.00166381103077),
        Vec3(7500.0000000000009, 6817.7672478170962, 571.00166381103077),
        Vec3(7500.0000000000009, 6327.6345143037688, 571.00166381103077)},
       {Vec3(8000.0000000000009, 6327.6345143037670, 88.336618780016408),
        Vec3(7500.0, 6327.6345143037670, 88.336618780016408),
        Vec3(7500.0, 6327.6345143037670, 1015.9309593449836)}},
      {{Vec3(1.10000002, -7.9000001, 16.5879993), Vec3(1.10000002, -7.9000001, 16.5879993),
        Vec3(1.10000002, -7.9000001, 16.5879993)},
       {Vec3(2.27699995, -7.9000001, 16.3180008), Vec3(-0.569999993, -8.10000038, 16.6070004),
        Vec3(-0.569999993, -8.10000038, 16.6070004)}},
      {{Vec3(0.012711, -0.000688, -0.001097), Vec3(0.012895, -0.000686, -0.001133),
        Vec3(0.0128, -0.0007, -0.002)},
       {Vec3(0.012676, -0.000689, -0.000999), Vec3(0.012859, -0.000687, -0.001034),
        Vec3(0.0128, -0.0007, 0.0)}},
      {{Vec3(-0.37579435, 0.014414025, 0.3265663), Vec3(-0.37263185, 0.0108978925, 0.36118037),
        Vec3(-0.35647663, 0.03625821, 0.34328437)},
       {Vec3(0.23884095, -1.6477574, 0.116889484), Vec3(0.26891768, -1.6353351, 0.10821109),
        Vec3(0.26338503, -1.6657706, 0.10510237)}},
  }};
  TrianglePair pair = PUBLISHED[random_index(random, 4)];
  if (coin(random)) {
    for (Triangle* t : {&pair.a, &pair.b}) {
      for (Vec3& corner : *t) corner = nudged(random, corner, 3);
    }
  }
  return any_order(random, pair);
}

/// One step of a motion: the second triangle of some other family, moved by 1e-16 to 1e-6.
TrianglePair small_motions(Random& random) {
  TrianglePair pair = coin(random) ? parallel_edges(random) : box_faces(random);
  const Vec3 move = log_uniform(random, 1e-16, 1e-6) * random_unit_vector(random);
  for (Vec3& corner : pair.b) corner += move;
  return pair;
}

/// A structured pair under a rigid motion, which turns exact ties into rounding.
TrianglePair rigid_motions(Random& random) {
  const TrianglePair pair = coin(random) ? integer_grid(random) : coplanar(random);
  return transformed(pair, 1.0, random_rotation_matrix(random), 10.0 * random_point(random));
}

/// Triangles that face each other across a gap of two meshes: well shaped, nearly parallel.
TrianglePair facing_mesh_triangles(Random& random) {
  const Triangle regular{Vec3(1, 0, 0), Vec3(-0.5, std::sqrt(0.75), 0), Vec3(-0.5, -std::sqrt(0.75), 0)};
  const auto piece = [&](double height) {
    const Eigen::Quaterniond about_z(uniform_coordinate(random), 0.0, 0.0, uniform_coordinate(random));
    const Vec3 tilt = 0.15 * uniform_coordinate(random) * random_unit_vector(random);
    const Mat3 turn = (about_z.normalized() * Eigen::Quaterniond(1.0, tilt[0], tilt[1], tilt[2]).normalized())
                          .toRotationMatrix();
    const Vec3 place(1.5 * uniform_coordinate(random), 1.5 * uniform_coordinate(random), height);
    Triangle t;
    for (int i = 0; i < 3; ++i) t[i] = turn * (regular[i] + 0.2 * random_point(random)) + place;
    return t;
  };
  const Triangle a = piece(0.0);
  return {a, piece(0.9)};
}

constexpr std::array<TriangleFamily, 23> FAMILIES{{
    {"random", uniform_pair},
    {"random, far apart", separated_pair},
    {"facing mesh triangles", facing_mesh_triangles},
    {"shared corner, edge or triangle", shared_features},
    {"parallel planes", parallel_planes},
    {"coplanar", coplanar},
    {"parallel edges, +-100 ulp", parallel_edges},
    {"edge parallel to face", edge_parallel_to_face},
    {"corner over face, edge, corner; gap 1e-12..1", corner_over_feature},
    {"crossing edges; gap 1e-12..1, angle 1e-8..1.5", crossing_edges},
    {"touching and piercing", touching_and_piercing},
    {"needles and caps to 1e8", needles_and_caps},
    {"zero area", zero_area},
    {"scales 1e-6..1e6", any_scale},
    {"offsets 1e3..1e6", far_from_origin},
    {"size ratio to 1e4", unequal_sizes},
    {"integer grid", integer_grid},
    {"aligned boxes, rotated or not", box_faces},
    {"copies of one triangle", copies_of_one_triangle},
    {"magnitudes 2^-400..2^400", extreme_magnitudes},
    {"published failures, +-3 ulp", published_failures},
    {"steps of small motions", small_motions},
    {"structured pairs under rigid motion", rigid_motions},
}};

}  // namespace

std::span<const TriangleFamily> triangle_families() {
  return FAMILIES;
}

}  // namespace lmdbench::testing
