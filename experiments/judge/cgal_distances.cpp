// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>
#include <judge/distance_kernels.h>

#include <cmath>

namespace lmdbench::testing {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

Kernel::Triangle_3 converted(const Triangle& t) {
  const auto point = [](const Vec3& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  return {point(t[0]), point(t[1]), point(t[2])};
}

}  // namespace

void cgal_distances(std::span<const Triangle> a, std::span<const Triangle> b,
                    std::span<DistanceAnswer> answers) {
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const double distance = std::sqrt(CGAL::squared_distance(converted(a[i]), converted(b[i])));
    answers[i] = {distance, distance == 0.0, std::nullopt};
  }
}

}  // namespace lmdbench::testing
