// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/force/wrench_sum.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>

namespace lmdbench {

namespace {

/// Of forces that cancel, in their lengths.
constexpr double ROUNDING = 1e-12;

}  // namespace

Wrench WrenchSum::wrench() const {
  Wrench sum{force_, torque_, 0.0};
  const double length = sum.force.stableNorm();
  if (length > ROUNDING * lengths_) {
    const Vec3 away_W = sum.force / length;
    sum.stiffness = away_W.dot(stiffness_W_ * away_W);
  } else if (length >= 0.0) {
    // Balanced forces leave no direction to translate along: the stiffest one is reported.
    sum.force.setZero();
    sum.stiffness =
        Eigen::SelfAdjointEigenSolver<Mat3>(stiffness_W_, Eigen::EigenvaluesOnly).eigenvalues()[2];
  } else {
    sum.stiffness = length;  // NaN in, NaN out: a broken LMD stays visible.
  }
  return sum;
}

Wrench sum_forces(const LmdSet& lmds, const ForceProfile& profile, const Vec3& reference_W) {
  LMDBENCH_EXPECTS(profile.maximum_force > 0.0 && profile.cutoff > 0.0,
                   "a profile that was not validated (validate_force_profile)");
  WrenchSum sum(reference_W);
  for (const Lmd& lmd : lmds) {
    if (!WrenchSum::acts(lmd, profile)) continue;
    sum.push(lmd, force_magnitude(profile, lmd.distance));
    sum.stiffen(lmd.direction, lmd.direction, force_stiffness(profile, lmd.distance));
  }
  return sum.wrench();
}

const std::vector<Aggregation>& aggregations() {
  static const std::vector<Aggregation> all{sum_law(), signed_law(), shared_law(), layered_law()};
  return all;
}

std::vector<std::string> aggregation_names() {
  std::vector<std::string> names;
  for (const Aggregation& law : aggregations()) names.emplace_back(law.name);
  return names;
}

const Aggregation& aggregation_named(std::string_view name, const std::string& file,
                                     const std::string& place) {
  const auto found = std::ranges::find(aggregations(), name, &Aggregation::name);
  if (found != aggregations().end()) return *found;
  throw UsageError(file, place, fmt::format("unknown aggregation \"{}\"", name),
                   fmt::format("known ones: {}", fmt::join(aggregation_names(), ", ")));
}

}  // namespace lmdbench
