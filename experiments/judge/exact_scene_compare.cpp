// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/shape/shape_complex.h>

#include <judge/exact_scene.h>
#include <judge/exact_scene_body.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace lmdbench::exact {
namespace {

bool same_features(const Lmd& found, const ExactLmd& exact) {
  return found.fixed_body == exact.fixed_body && found.feature_moving == exact.feature_moving &&
         found.feature_fixed == exact.feature_fixed;
}

/// Whether the exact LMD is a part of the plateau for which an LMD stands: distance vectors and
/// planes of contact are equal up to what the definition grants to one LMD: the tolerance, and once
/// more for each contact that is extended.
bool same_contact(const Lmd& found, const ExactLmd& exact, const ContactTolerance& tolerance) {
  if (found.fixed_body != exact.fixed_body) return false;
  const Vec3 apart = found.point_moving - exact.point_moving;
  const double coordinates =
      std::max(exact.point_moving.cwiseAbs().maxCoeff(), exact.point_fixed.cwiseAbs().maxCoeff());
  const double rounding = ROUNDINGS * std::numeric_limits<double>::epsilon() * coordinates;
  const Vec3 d = exact.point_fixed - exact.point_moving;
  const Vec3 difference = found.point_fixed - found.point_moving - d;
  const double allowed = 3.0 * tolerance.known + tolerance.largest_tilt * exact.distance + rounding;
  const double tilt = allowed / exact.distance;  // of the two planes of contact
  return difference.norm() <= allowed &&
         std::abs(apart.dot(d)) <= exact.distance * (allowed + tilt * apart.norm());
}

}  // namespace

ExactAgreement compare_with_exact(const Scene& scene, const LmdSet& found,
                                  const std::vector<ExactLmd>& exact) {
  const Body& moving = *scene.moving;
  std::vector<ContactTolerance> tolerances;  // their lengths do not depend on the pose
  for (const FixedBody& fixed : scene.fixed)
    tolerances.push_back(ContactTolerance::of(moving, *fixed, RigidTransform(), 0.0));
  const auto is_part_of = [&](const ExactLmd& truth, const Lmd& lmd) {
    return same_contact(lmd, truth, tolerances[static_cast<std::size_t>(truth.fixed_body)]);
  };
  ExactAgreement agreement;
  for (const ExactLmd& truth : exact) {
    ++agreement.exact;
    if (std::any_of(found.begin(), found.end(), [&](const Lmd& lmd) { return same_features(lmd, truth); })) {
      ++agreement.same_features;
    } else if (std::any_of(found.begin(), found.end(),
                           [&](const Lmd& lmd) { return is_part_of(truth, lmd); })) {
      ++agreement.same_contact;
    } else if (!truth.certain) {
      ++agreement.uncertain;
    } else {
      agreement.missed.push_back(truth);
    }
  }
  std::vector<bool> taken(exact.size(), false);
  for (const Lmd& lmd : found) {
    if (lmd.intersecting || lmd.distance == 0.0) continue;
    ++agreement.found;
    bool matches = false, shares = false;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      if (!same_features(lmd, exact[i]) && !is_part_of(exact[i], lmd)) continue;
      matches = true;
      shares = shares || taken[i];
      taken[i] = true;
    }
    agreement.sharing += shares;
    if (!matches) agreement.untrue.push_back(lmd);
  }
  return agreement;
}

bool within_tolerance(const Scene& scene, const Pose& X_WM, const Lmd& lmd) {
  constexpr double SINE = 1e-9;
  const auto admits = [](const WorldBody& body, const FeatureId& feature, const Vec3& p_W, const Vec3& d_W) {
    const double rounding =
        ROUNDINGS * std::numeric_limits<double>::epsilon() * (p_W.cwiseAbs().maxCoeff() + d_W.norm());
    for (const std::int32_t triangle : body.surface().incident_triangles(feature)) {
      for (const std::int32_t corner : body.corners(triangle)) {
        const Vec3 to_corner = body.vertex(corner) - p_W;
        if (!(d_W.dot(to_corner) <= (SINE * d_W.norm() + rounding) * to_corner.norm())) return false;
      }
    }
    return true;
  };
  const WorldBody moving(scene.moving->surface(), RigidTransform(X_WM));
  const WorldBody fixed(scene.fixed[static_cast<std::size_t>(lmd.fixed_body)]->surface(), RigidTransform());
  const Vec3 d_W = lmd.point_fixed - lmd.point_moving;
  return admits(moving, lmd.feature_moving, lmd.point_moving, d_W) &&
         admits(fixed, lmd.feature_fixed, lmd.point_fixed, -d_W);
}

std::string describe(const ExactLmd& lmd) {
  std::ostringstream text;
  text.precision(17);
  text << to_string(lmd.feature_moving.kind) << " " << lmd.feature_moving.index << " of the moving mesh, "
       << to_string(lmd.feature_fixed.kind) << " " << lmd.feature_fixed.index << " of fixed mesh "
       << lmd.fixed_body << ", distance " << lmd.distance << ", at " << lmd.point_moving.transpose()
       << " and " << lmd.point_fixed.transpose();
  return text.str();
}

}  // namespace lmdbench::exact
