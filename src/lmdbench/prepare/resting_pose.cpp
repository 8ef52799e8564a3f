// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/resting_pose.h>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>

namespace lmdbench {
namespace {

/// The approach ends within this part of the gap.
constexpr double GAP_TOLERANCE = 1e-6;
/// Half of a difference's step, as a part of the gap.
constexpr double DIFFERENCE_SHARE = 1e-4;

/// Direction i of n on a Fibonacci lattice.
Vec3 lattice_direction(int i, int n) {
  const double z = 1.0 - (2.0 * i + 1.0) / n;
  const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Sequence of orientations: the file's, then uniform random ones (Shoemake 1992), always the same.
Eigen::Quaterniond orientation(int i) {
  if (i == 0) return Eigen::Quaterniond::Identity();
  std::mt19937_64 random(static_cast<std::uint64_t>(i));
  const double u = uniform_number(random);
  const double a = 2.0 * std::numbers::pi * uniform_number(random);
  const double b = 2.0 * std::numbers::pi * uniform_number(random);
  return {std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a), std::sqrt(1.0 - u) * std::cos(a),
          std::sqrt(u) * std::sin(b)};
}

/// Computes the exact set's force.
class RestingWrenches {
 public:
  RestingWrenches(const Scene& scene, const ForceProfile& profile)
      : profile_(profile), method_(make_method("certified", scene)) {}

  Wrench at(const Pose& X_WM) {
    lmds_.clear();
    WorkCounters ignored;
    method_->search(X_WM, lmds_, ignored);
    std::sort(lmds_.begin(), lmds_.end(), lmd_less);
    return sum_forces(lmds_, profile_, X_WM.translation);
  }
  const LmdSet& lmds() const { return lmds_; }

 private:
  ForceProfile profile_;
  std::unique_ptr<Method> method_;
  LmdSet lmds_;
};

/// Pose at which the mesh, coming in along the direction, first has the gap to a fixed one.
std::optional<Pose> approach(const Scene& scene, const Eigen::Quaterniond& R_WM, const Vec3& from_W,
                             double gap) {
  Pose pose;
  pose.rotation = R_WM;
  // The boxes' centres on one line, if possible: meshes need not be about their origins.
  const Vec3 centre_M = bounding_box_centre(scene.moving->surface().mesh);
  pose.translation = bounding_box_centre(scene.fixed.front()->surface().mesh) - R_WM * centre_M;
  double displacement = -std::numeric_limits<double>::infinity();
  for (const auto& fixed : scene.fixed)
    displacement = std::max(
        displacement, first_approach(*scene.moving, *fixed, pose, from_W, gap, GAP_TOLERANCE).displacement);
  if (!std::isfinite(displacement)) return std::nullopt;
  pose.translation += displacement * from_W;
  return pose;
}

/// Judges a pose as a place to rest. None without a force, or with too few contacts to beat `best`,
/// whatever its six neighbours show: on flat parts each costs as much as the pose.
std::optional<RestingPose> look_at_pose(RestingWrenches& wrenches, const Pose& X_WM, double gap,
                                        const std::optional<RestingPose>& best) {
  const Wrench wrench = wrenches.at(X_WM);
  RestingPose rest;
  rest.pose = X_WM;
  rest.contacts = wrenches.lmds().size();
  if (rest.contacts == 0 || !(wrench.stiffness > 0.0) || !(wrench.force.norm() > 0.0)) return std::nullopt;
  if (best && !best->slides() && rest.contacts < best->contacts) return std::nullopt;
  rest.gap = minimum_distance(wrenches.lmds());
  rest.force_W = wrench.force;
  rest.stiffness_n_per_m = wrench.stiffness;
  const double step = DIFFERENCE_SHARE * gap;
  Mat3 stiffness_W;
  for (int axis = 0; axis < 3; ++axis) {
    Pose before = X_WM;
    Pose after = X_WM;
    before.translation[axis] -= step;
    after.translation[axis] += step;
    stiffness_W.col(axis) = (wrenches.at(before).force - wrenches.at(after).force) / (2.0 * step);
  }
  const Mat3 symmetric_W = 0.5 * (stiffness_W + stiffness_W.transpose());
  rest.least_stiffness_share =
      Eigen::SelfAdjointEigenSolver<Mat3>(symmetric_W, Eigen::EigenvaluesOnly).eigenvalues()[0] /
      rest.stiffness_n_per_m;
  return rest;
}

bool better(const RestingPose& a, const RestingPose& b) {
  if (a.slides() != b.slides()) return b.slides();
  if (!a.slides() && a.contacts != b.contacts) return a.contacts > b.contacts;
  return a.least_stiffness_share > b.least_stiffness_share;
}

}  // namespace

RestingPose find_resting_pose(const Scene& scene, const ForceProfile& profile, const Progress& progress) {
  const double gap =
      profile.saturation_distance + REST_SHARE * (profile.cutoff - profile.saturation_distance);
  RestingWrenches wrenches(scene, profile);
  std::optional<RestingPose> best;
  int tried = 0;
  for (int turn = 0; turn < REST_ORIENTATIONS && (!best || best->slides()); ++turn) {
    for (int i = 0; i < REST_DIRECTIONS; ++i) {
      if (progress && !progress(tried, REST_DIRECTIONS * REST_ORIENTATIONS)) throw Interrupted();
      ++tried;
      const std::optional<Pose> pose =
          approach(scene, orientation(turn), lattice_direction(i, REST_DIRECTIONS), gap);
      if (!pose) continue;
      const std::optional<RestingPose> rest = look_at_pose(wrenches, *pose, gap, best);
      if (rest && (!best || better(*rest, *best))) best = rest;
    }
  }
  if (!best)
    throw InputError(
        "", "",
        fmt::format("none of {} poses {:.3g} m from each other has a contact with a force", tried, gap),
        "check scale, cutoff and that the meshes are not inside out (`lmdbench mesh info`, --orient "
        "outward), or give "
        "a path that begins in contact");
  best->tried = tried;
  return *best;
}

}  // namespace lmdbench
