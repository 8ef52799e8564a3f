// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/crosscheck/fcl_crosscheck.h>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <array>
#include <string>

namespace lmdbench {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

/// A seed must stay an upper bound: FCL takes only pairs strictly below it, and computes the seed's
/// pair again in another frame, with other roundings. Relative to the distance.
constexpr double SEED_MARGIN = 1e-9;

double unit_of_finest(const Surface& moving, const std::vector<const Surface*>& fixed) {
  double finest = mean_edge_length(moving.mesh);
  for (const Surface* surface : fixed) finest = std::min(finest, mean_edge_length(surface->mesh));
  // Meshes of coincident points have no size.
  return finest > 0.0 ? 1.0 / finest : 1.0;
}

std::shared_ptr<const Model> build_model(const TriangleMesh& mesh, double scale, const std::string& which) {
  if (mesh.triangles.empty())
    throw InputError("", which, "the mesh has no triangles, so there is no distance to cross-check",
                     "leave the cross-check out or give a mesh with triangles");
  std::vector<Vec3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) points.push_back(scale * p);
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles)
    triangles.emplace_back(static_cast<std::size_t>(corners[0]), static_cast<std::size_t>(corners[1]),
                           static_cast<std::size_t>(corners[2]));
  auto model = std::make_shared<Model>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(points.size()));
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

std::array<Vec3, 3> corners_of(const Model& model, std::int32_t triangle) {
  const fcl::Triangle& corners = model.tri_indices[triangle];
  return {model.vertices[corners[0]], model.vertices[corners[1]], model.vertices[corners[2]]};
}

/// Triangles that were nearest in the last warm query of one fixed mesh.
struct LastPair {
  std::int32_t fixed = -1;
  std::int32_t moving = -1;
};

}  // namespace

class FclCrosscheck::Implementation {
 public:
  Implementation(const Surface& moving, const std::vector<const Surface*>& fixed, FclScaling scaling)
      : scale_(scaling == FclScaling::NONE ? 1.0 : unit_of_finest(moving, fixed)),
        moving_(build_model(moving.mesh, scale_, "moving mesh")),
        last_(fixed.size()) {
    for (std::size_t i = 0; i < fixed.size(); ++i)
      fixed_.push_back(fixed[i] == &moving
                           ? moving_
                           : build_model(fixed[i]->mesh, scale_, "fixed mesh " + std::to_string(i)));
  }

  double scale() const { return scale_; }
  void forget() { std::fill(last_.begin(), last_.end(), LastPair{}); }

  FclResult cold(const Pose& X_WM) const {
    const fcl::Transform3d X = scaled(X_WM);
    FclResult best;
    for (std::size_t i = 0; i < fixed_.size(); ++i) {
      fcl::DistanceResultd found;
      query(i, X, found);
      keep_nearer(best, i, found);
    }
    return best;
  }

  FclResult warm(const Pose& X_WM) {
    const fcl::Transform3d X = scaled(X_WM);
    FclResult best;
    for (std::size_t i = 0; i < fixed_.size(); ++i) {
      fcl::DistanceResultd seeded = last_[i].fixed < 0 ? fcl::DistanceResultd() : distance_of_last(i, X);
      fcl::DistanceResultd found = seeded;
      if (last_[i].fixed >= 0) found.min_distance *= 1.0 + SEED_MARGIN;
      query(i, X, found);
      // Nothing is below the seed: the last pair is still the nearest one.
      if (found.b1 < 0 || found.min_distance > seeded.min_distance) found = seeded;
      last_[i] = {static_cast<std::int32_t>(found.b1), static_cast<std::int32_t>(found.b2)};
      keep_nearer(best, i, found);
    }
    return best;
  }

 private:
  fcl::Transform3d scaled(const Pose& X_WM) const {
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() = X_WM.rotation.toRotationMatrix();
    X.translation() = scale_ * X_WM.translation;
    return X;
  }

  /// The fixed mesh goes first: FCL's points are then in the world frame without further rounding.
  void query(std::size_t i, const fcl::Transform3d& X, fcl::DistanceResultd& result) const {
    const fcl::DistanceRequestd request(/*nearest points*/ true, /*signed distance*/ false, /*rel_err*/ 0.0,
                                        /*abs_err*/ 0.0);
    fcl::distance(fixed_[i].get(), fcl::Transform3d(fcl::Transform3d::Identity()), moving_.get(), X, request,
                  result);
  }

  fcl::DistanceResultd distance_of_last(std::size_t i, const fcl::Transform3d& X) const {
    const std::array<Vec3, 3> fixed = corners_of(*fixed_[i], last_[i].fixed);
    const std::array<Vec3, 3> moving = corners_of(*moving_, last_[i].moving);
    fcl::DistanceResultd result;
    result.min_distance = fcl::detail::TriangleDistanced::triDistance(
        fixed.data(), moving.data(), X, result.nearest_points[0], result.nearest_points[1]);
    result.b1 = last_[i].fixed;
    result.b2 = last_[i].moving;
    return result;
  }

  void keep_nearer(FclResult& best, std::size_t i, const fcl::DistanceResultd& found) const {
    const double distance = found.min_distance / scale_;
    if (best.fixed_body >= 0 && !(distance < best.distance)) return;
    best = FclResult{};
    best.separated = found.min_distance > 0.0;
    best.distance = best.separated ? distance : 0.0;
    best.fixed_body = static_cast<std::int32_t>(i);
    best.triangle_fixed = static_cast<std::int32_t>(found.b1);
    best.triangle_moving = static_cast<std::int32_t>(found.b2);
    if (!best.separated) return;
    best.point_fixed = found.nearest_points[0] / scale_;
    best.point_moving = found.nearest_points[1] / scale_;
  }

  double scale_;
  std::shared_ptr<const Model> moving_;
  std::vector<std::shared_ptr<const Model>> fixed_;
  std::vector<LastPair> last_;
};

FclCrosscheck::FclCrosscheck(const Surface& moving, const std::vector<const Surface*>& fixed,
                             FclScaling scaling)
    : implementation_(std::make_unique<Implementation>(moving, fixed, scaling)) {}
FclCrosscheck::~FclCrosscheck() = default;

bool FclCrosscheck::is_built_in() {
  return true;
}

FclCrosscheck::FclCrosscheck(FclCrosscheck&& other) noexcept = default;
FclCrosscheck& FclCrosscheck::operator=(FclCrosscheck&& other) noexcept = default;

FclResult FclCrosscheck::distance(const Pose& X_WM) const {
  return implementation_->cold(X_WM);
}
FclResult FclCrosscheck::distance_warm(const Pose& X_WM) {
  return implementation_->warm(X_WM);
}
void FclCrosscheck::forget() {
  implementation_->forget();
}
double FclCrosscheck::scale() const {
  return implementation_->scale();
}

}  // namespace lmdbench
