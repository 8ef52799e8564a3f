// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/shape/plane_fit.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace lmdbench {

FittedPlane fit_plane(std::span<const Vec3> points, const Vec3& towards) {
  LMDBENCH_ALWAYS(!points.empty(), "a region without triangles");
  const double count = static_cast<double>(points.size());
  // From the first point: far coordinates cost no digits.
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p - points.front();
  FittedPlane fit;
  fit.plane.point = points.front() + sum / count;
  Mat3 products = Mat3::Zero();
  for (const Vec3& p : points) products += (p - fit.plane.point) * (p - fit.plane.point).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(products / count);
  const Vec3 wide = solver.eigenvectors().col(2);
  fit.plane.normal = wide.cross(solver.eigenvectors().col(1)).normalized();
  const Vec3 narrow = fit.plane.normal.cross(wide);
  double squared_wide = 0.0, squared_narrow = 0.0, rise_wide = 0.0, rise_narrow = 0.0;
  for (const Vec3& p : points) {
    const Vec3 x = p - fit.plane.point;
    const double s = wide.dot(x), t = narrow.dot(x), height = fit.plane.normal.dot(x);
    squared_wide += s * s;
    squared_narrow += t * t;
    rise_wide += s * height;
    rise_narrow += t * height;
  }
  if (squared_wide > 0.0) fit.plane.normal -= rise_wide / squared_wide * wide;
  if (squared_narrow > 0.0) fit.plane.normal -= rise_narrow / squared_narrow * narrow;
  fit.plane.normal.normalize();
  if (fit.plane.normal.dot(towards) < 0.0) fit.plane.normal = -fit.plane.normal;
  fit.breadth = std::sqrt(squared_narrow / count);
  LMDBENCH_ENSURES(is_unit(fit.plane.normal), "points whose spread under- or overflows");
  return fit;
}

}  // namespace lmdbench
