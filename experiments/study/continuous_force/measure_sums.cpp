// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/methods/registry.h>

#include <study/continuous_force/measures.h>
#include <support/closed_solids.h>
#include <support/random.h>

#include <algorithm>
#include <cmath>

namespace lmdbench::continuous_force {

namespace {

struct EulerSolid {
  std::string name;
  std::shared_ptr<const Body> body;
  int euler;  ///< Euler number: components less tunnels.
};

EulerSolid euler_solid(std::string name, TriangleMesh mesh, int euler) {
  auto body = std::make_shared<const Body>(name, build_surface(std::move(mesh)));
  return {std::move(name), std::move(body), euler};
}

std::vector<EulerSolid> euler_solids() {
  std::vector<EulerSolid> all;
  all.push_back(euler_solid("blob", make_blob(1.0, 0.25, 2), 1));
  all.push_back(euler_solid("torus", make_torus(1.0, 0.4, 16, 10), 0));
  all.push_back(euler_solid("L block", make_l_block(1.0), 1));
  all.push_back(euler_solid("plate with two holes", scaled(testing::make_plate_with_holes(2), 0.3), -1));
  all.push_back(euler_solid("two blobs",
                            merged(translated(make_blob(0.6, 0.15, 1), {1.0, 0.0, 0.0}),
                                   translated(make_blob(0.6, 0.2, 1), {-0.9, 0.2, 0.1})),
                            2));
  all.push_back(
      euler_solid("torus and box", merged(make_torus(1.0, 0.3, 12, 8), make_box({0.3, 0.4, 0.5}, 2)), 1));
  return all;
}

bool same_minima(const CriticalSet& critical, const LmdSet& lmds) {
  const LmdSet minima = minima_of(critical);
  return std::equal(minima.begin(), minima.end(), lmds.begin(), lmds.end(), [](const Lmd& a, const Lmd& b) {
    return a.distance == b.distance && same_feature_pair(a, b) && a.point_moving == b.point_moving &&
           a.point_fixed == b.point_fixed;
  });
}

}  // namespace

std::vector<SumRow> measure_sums(std::size_t poses, std::uint64_t seed, bool exhaustive_too) {
  const std::vector<EulerSolid> solids = euler_solids();
  std::vector<std::string> methods{"certified"};
  if (exhaustive_too) methods.emplace_back("exhaustive");
  std::vector<SumRow> rows;
  // Each solid with the next one.
  for (std::size_t a = 0; a < solids.size(); ++a)
    for (const std::size_t b : {(a + 1) % solids.size()})
      for (const std::string& method_name : methods) {
        const Scene scene{solids[a].body, {solids[b].body}, 1e3};
        SumRow row{solids[a].name, solids[b].name, method_name, solids[a].euler * solids[b].euler};
        const auto method = make_method(method_name, scene);
        experiments::Random random(seed);
        CriticalSet critical;
        LmdSet lmds;
        WorkCounters ignored;
        while (row.poses < poses) {
          Pose pose;
          pose.rotation = random.rotation();
          const Vec3 outward = random.direction();
          const double gap = std::pow(10.0, random.uniform(-4.0, 0.3));
          const Body &moving = *scene.moving, &fixed = *scene.fixed[0];
          const double displacement = first_approach(moving, fixed, pose, outward, gap, 1e-6).displacement;
          if (!std::isfinite(displacement)) continue;
          pose.translation = displacement * outward;
          ++row.poses;
          method->find_critical(pose, critical, ignored);
          row.wrong_sums += sum_of_indices(critical) != row.expected;
          row.most_pairs = std::max(row.most_pairs, critical.size());
          method->search(pose, lmds, ignored);
          row.other_minima += !same_minima(critical, lmds);
        }
        rows.push_back(row);
      }
  return rows;
}

}  // namespace lmdbench::continuous_force
