// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/lmd/body_distance.h>

#include <study/continuous_force/measures.h>
#include <support/closed_solids.h>
#include <support/random.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace lmdbench::continuous_force {

namespace {

std::shared_ptr<const Body> body_of(TriangleMesh mesh) {
  return std::make_shared<const Body>("mesh", build_surface(std::move(mesh)));
}

/// Cuts every triangle into four in its plane.
TriangleMesh cut_in_four(const TriangleMesh& mesh) {
  TriangleMesh cut;
  cut.vertices = mesh.vertices;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(cut.vertices.size()));
    if (is_new)
      cut.vertices.push_back(
          0.5 * (mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)]));
    return found->second;
  };
  for (const auto& t : mesh.triangles) {
    const std::int32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    cut.triangles.push_back({t[0], a, c});
    cut.triangles.push_back({a, t[1], b});
    cut.triangles.push_back({c, b, t[2]});
    cut.triangles.push_back({a, b, c});
  }
  return cut;
}

TriangleMesh rounded_to_floats(TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v = v.cast<float>().cast<double>();
  return mesh;
}

/// A block with a spherical cavity, whose wall is the surface to touch.
TriangleMesh spherical_cavity(double radius, int subdivisions) {
  TriangleMesh cavity = make_sphere(radius, subdivisions);
  for (auto& t : cavity.triangles) std::swap(t[1], t[2]);
  return merged(std::move(cavity), make_box(Vec3::Constant(4.0 * radius), 1));
}

double truth_at(const ForceProfile& profile, double gap) {
  return force_magnitude(profile, gap) / profile.maximum_force;
}

}  // namespace

std::vector<CutRow> measure_cuts(std::size_t poses, std::uint64_t seed) {
  const TriangleMesh blob = make_blob(1.0, 0.25, 2), torus = make_torus(1.0, 0.4, 16, 10);
  const double cutoff = 0.2;
  const auto scene_of = [&](TriangleMesh moving, TriangleMesh fixed) {
    return Scene{body_of(std::move(moving)), {body_of(std::move(fixed))}, cutoff};
  };
  const Scene plain = scene_of(blob, torus);
  const std::vector<std::pair<std::string, Scene>> changed{
      {"every triangle cut in four", scene_of(cut_in_four(blob), cut_in_four(torus))},
      {"vertices rounded to single precision", scene_of(rounded_to_floats(blob), rounded_to_floats(torus))}};
  experiments::Random random(seed);
  std::vector<Pose> chosen;
  while (chosen.size() < poses) {
    Pose pose;
    pose.rotation = random.rotation();
    const Vec3 outward = random.direction();
    const Body &moving = *plain.moving, &fixed = *plain.fixed[0];
    const double displacement =
        first_approach(moving, fixed, pose, outward, random.uniform(0.02, 0.15), 1e-6).displacement;
    if (!std::isfinite(displacement)) continue;
    pose.translation = displacement * outward;
    chosen.push_back(pose);
  }
  std::vector<CutRow> rows;
  for (const auto& [name, scene] : changed) {
    CutRow row{name, poses, {}};
    Renderer before(plain, profile_of(cutoff), LayeredChoice()),
        after(scene, profile_of(cutoff), LayeredChoice());
    for (const Pose& pose : chosen) {
      const Forces a = before.at(pose).force, b = after.at(pose).force;
      for (std::size_t law = 0; law < LAWS; ++law)
        row.largest[law] = std::max(row.largest[law], (b[law] - a[law]).norm());
    }
    rows.push_back(row);
  }
  return rows;
}

std::array<double, LAWS> measure_decimation(const PathScene& fine, const PathScene& coarse,
                                            std::optional<LayeredChoice> layered) {
  Renderer a(fine.scene, fine.profile, layered), b(coarse.scene, coarse.profile, layered);
  std::array<double, LAWS> apart{}, whole{}, result{};
  for (const Pose& pose : fine.poses) {
    const Forces x = a.at(pose).force, y = b.at(pose).force;
    for (std::size_t law = 0; law < LAWS; ++law) {
      apart[law] += (y[law] - x[law]).squaredNorm();
      whole[law] += x[law].squaredNorm();
    }
  }
  for (std::size_t law = 0; law < LAWS; ++law) result[law] = std::sqrt(apart[law] / whole[law]);
  return result;
}

std::vector<CupRow> measure_cups(std::uint64_t seed) {
  constexpr double SPHERE = 0.01, CUTOFF = 0.001, GAP = 0.3 * CUTOFF;
  constexpr int PLACES = 12;
  const ForceProfile profile = {
      .law = ForceLaw::LINEAR, .cutoff = CUTOFF, .saturation_distance = 0.0, .maximum_force = 1.0};
  std::vector<CupRow> rows;
  for (const double ratio : {1.2, 2.0})
    for (const int subdivisions : {2, 3, 4}) {
      const Scene scene{body_of(make_sphere(SPHERE, subdivisions)),
                        {body_of(spherical_cavity(ratio * SPHERE, subdivisions))},
                        CUTOFF};
      CupRow row{ratio, scene.moving->surface().mesh.triangles.size(), {}};
      Renderer renderer(scene, profile, LayeredChoice());
      experiments::Random random(seed);
      for (int place = 0; place < PLACES; ++place) {
        const Pose pose{((ratio - 1.0) * SPHERE - GAP) * random.direction(), random.rotation()};
        const Forces force = renderer.at(pose).force;
        for (std::size_t law = 0; law < LAWS; ++law)
          row.mean[law] += force[law].norm() / truth_at(profile, GAP) / PLACES;
      }
      rows.push_back(row);
    }
  return rows;
}

std::vector<NotchRow> measure_notches() {
  // A V between two thick wings, open upwards, and a slender spindle that points down into it.
  constexpr double CUTOFF = 0.1, APART = 0.02 * CUTOFF;
  const ForceProfile profile = {
      .law = ForceLaw::LINEAR, .cutoff = CUTOFF, .saturation_distance = 0.0, .maximum_force = 1.0};
  std::vector<NotchRow> rows;
  for (const double degrees : {5.0, 10.0, 20.0, 30.0, 45.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    // In xz: the groove's apex is the origin, extruded along y.
    const double x = std::sin(angle), z = std::cos(angle);
    const std::vector<Vec2> profile_xz{{-3.0, -1.0}, {3.0, -1.0}, {3.0, z}, {x, z},
                                       {0.0, 0.0},   {-x, z},     {-3.0, z}};
    TriangleMesh block;
    const auto n = static_cast<std::int32_t>(profile_xz.size());
    for (const double y : {-1.0, 1.0})
      for (const Vec2& p : profile_xz) block.vertices.emplace_back(p.x(), y, p.y());
    for (std::int32_t k = 0; k < n; ++k) {
      const std::int32_t next = (k + 1) % n;
      block.triangles.push_back({k, n + k, next});
      block.triangles.push_back({next, n + k, n + next});
    }
    // Ends: the wings and the base, each convex; seen against y the profile is counter-clockwise.
    for (const auto& t : {std::array<std::int32_t, 3>{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 6}, {4, 5, 6}}) {
      block.triangles.push_back({t[0], t[1], t[2]});
      block.triangles.push_back({n + t[0], n + t[2], n + t[1]});
    }
    const TriangleMesh spindle = [&] {
      TriangleMesh mesh = make_needles(0.02 * std::sin(angle), 1.0, 8, 0.0);
      double lowest = 0.0;
      for (const Vec3& v : mesh.vertices) lowest = std::min(lowest, v.z());
      return translated(std::move(mesh), {0.0, 0.0, -lowest});
    }();
    const Scene scene{body_of(spindle), {body_of(block)}, CUTOFF};
    Renderer renderer(scene, profile, LayeredChoice());
    const Pose pose{Vec3(1e-5, 0.013, APART / std::sin(angle))};
    const Forces force = renderer.at(pose).force;
    NotchRow row{degrees, {}};
    for (std::size_t law = 0; law < LAWS; ++law) row.outwards[law] = force[law].z();
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lmdbench::continuous_force
