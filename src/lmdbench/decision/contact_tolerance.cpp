// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/contact_tolerance.h>

#include <numbers>

namespace lmdbench {

ContactTolerance ContactTolerance::of(const Surface& moving, const ShapeComplex& moving_shape,
                                      const Surface& fixed, const ShapeComplex& fixed_shape,
                                      const RigidTransform& X_WM, double cutoff) {
  const auto known_to = [](const Surface& surface, const ShapeComplex& shape) {
    return std::max(surface.mesh.planar_tolerance, LEAST_TOLERANCE * shape.regions.extent);
  };
  ContactTolerance tolerance;
  LMDBENCH_EXPECTS(cutoff >= 0.0, "a cutoff that is negative or not a number");
  const double extents = moving_shape.regions.extent + fixed_shape.regions.extent;
  tolerance.known = known_to(moving, moving_shape) + known_to(fixed, fixed_shape);
  tolerance.coordinates =
      std::max(X_WM.translation.cwiseAbs().maxCoeff() + std::numbers::sqrt3 * moving_shape.regions.extent,
               fixed_shape.regions.extent);
  tolerance.rounding = CONTACT_ROUNDING * tolerance.coordinates;
  tolerance.largest_tilt = std::min(LARGEST_PARALLEL_TILT, TILT_PER_TOLERANCE * tolerance.known / extents);
  tolerance.cutoff = cutoff;
  tolerance.reach = cutoff + 2.0 * tolerance.known;
  return tolerance;
}

}  // namespace lmdbench
