// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/crosscheck/fcl_crosscheck.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/lmd/body_distance.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/result_file/result_reader.h>

#include <judge/exact_distance.h>
#include <judge/feature_boxes.h>
#include <judge/ledger.h>
#include <triangles/brute_force_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lmdbench::exact {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();
/// Pairs farther than the nearest by more than this, relative to the distance, are sorted out in
/// extended precision, whose error is far smaller; exact arithmetic takes the rest.
constexpr double SORTING_MARGIN = 1e-6;

constexpr const char* FCL = "fcl";
constexpr const char* FCL_UNSCALED = "fcl-unscaled";

struct NearestExact {
  double distance = INFINITE;
  std::int32_t fixed_body = -1, moving = -1, fixed = -1;
};

/// The scene with what the arbitration needs.
class Court {
 public:
  explicit Court(const PreparedRun& run) : run_(run) {
    for (const auto& body : run.scene().fixed) {
      surfaces_.push_back(&body->surface());
      fixed_boxes_.push_back(
          testing::feature_boxes(body->surface(), body->surface().mesh.vertices, FeatureKind::FACE));
    }
    scaled_.emplace(moving(), surfaces_);
    unscaled_.emplace(moving(), surfaces_, FclScaling::NONE);
  }

  const Surface& moving() const { return run_.scene().moving->surface(); }
  const Surface& fixed(std::int32_t body) const { return *surfaces_[static_cast<std::size_t>(body)]; }
  double scale() const { return scaled_->scale(); }
  FclResult fcl(const Pose& X_WM) const { return scaled_->distance(X_WM); }
  FclResult fcl_unscaled(const Pose& X_WM) const { return unscaled_->distance(X_WM); }

  JudgedPair judged_pair(const std::string& why, const Pose& X_WM, std::int32_t body,
                         std::int32_t triangle_moving, std::int32_t triangle_fixed) const {
    JudgedPair pair;
    pair.why = why;
    pair.fixed_body = body;
    pair.triangle_moving = triangle_moving;
    pair.triangle_fixed = triangle_fixed;
    pair.moving_M = moving().mesh.triangle(triangle_moving);
    pair.fixed_W = fixed(body).mesh.triangle(triangle_fixed);
    pair.exact = testing::exact_distance(RigidTransform(X_WM).triangle(pair.moving_M), pair.fixed_W);
    pair.fcl = fcl_triangle_distance(pair.moving_M, pair.fixed_W, X_WM, scale()).distance;
    pair.fcl_unscaled = fcl_triangle_distance(pair.moving_M, pair.fixed_W, X_WM, 1.0).distance;
    return pair;
  }

  /// Minimum distance. The exact distance of some pair bounds it from above; all pairs whose boxes
  /// are nearer are computed in extended precision, and the nearest of them exactly.
  NearestExact truth(const Pose& X_WM) const {
    const RigidTransform transform(X_WM);
    NearestExact nearest = bound(X_WM);
    std::vector<Vec3> vertices_W;
    for (const Vec3& vertex : moving().mesh.vertices) vertices_W.push_back(transform.point(vertex));
    const auto boxes = testing::feature_boxes(moving(), vertices_W, FeatureKind::FACE);
    for (std::size_t body = 0; body < surfaces_.size() && nearest.distance > 0.0; ++body) {
      testing::for_each_near(boxes, fixed_boxes_[body], nearest.distance,
                             [&](std::int32_t i, std::int32_t j) {
                               if (nearest.distance == 0.0) return;
                               const Triangle a = transform.triangle(moving().mesh.triangle(i));
                               const Triangle b = surfaces_[body]->mesh.triangle(j);
                               const auto roughly = static_cast<double>(testing::brute_force_distance(a, b));
                               if (roughly > nearest.distance * (1.0 + SORTING_MARGIN)) return;
                               const double exactly = testing::exact_distance(a, b);
                               if (exactly < nearest.distance)
                                 nearest = {exactly, static_cast<std::int32_t>(body), i, j};
                             });
    }
    return nearest;
  }

 private:
  /// Any pair is a bound; the nearest pair of the program's own search is a tight one.
  NearestExact bound(const Pose& X_WM) const {
    const RigidTransform transform(X_WM);
    NearestExact best;
    for (std::size_t body = 0; body < surfaces_.size(); ++body) {
      const Body& fixed = *run_.scene().fixed[body];
      const NearestPair pair = nearest_pair(*run_.scene().moving, fixed, X_WM);
      const double distance =
          testing::exact_distance(transform.triangle(moving().mesh.triangle(pair.triangle_moving)),
                                  fixed.surface().mesh.triangle(pair.triangle_fixed));
      if (distance < best.distance)
        best = {distance, static_cast<std::int32_t>(body), pair.triangle_moving, pair.triangle_fixed};
    }
    return best;
  }

  const PreparedRun& run_;
  std::vector<const Surface*> surfaces_;
  std::vector<std::vector<testing::FeatureBox>> fixed_boxes_;
  std::optional<FclCrosscheck> scaled_, unscaled_;
};

/// Whether answers differ by more than the tolerance, or just one of them is contact.
bool differ(double a, double b, double tolerance) {
  if ((a == 0.0) != (b == 0.0)) return true;
  if (a == b) return false;
  return !(std::abs(a - b) <= tolerance * std::min(a, b));
}

LedgerRow judge(const Court& court, const Pose& X_WM, std::vector<Opinion> opinions,
                const FclResult& unscaled, double tolerance) {
  const NearestExact truth = court.truth(X_WM);
  LedgerRow row;
  row.pose = X_WM;
  row.truth = truth.distance;
  row.pairs.push_back(court.judged_pair("nearest", X_WM, truth.fixed_body, truth.moving, truth.fixed));
  for (Opinion& opinion : opinions) {
    opinion.wrong = differ(opinion.distance, truth.distance, tolerance);
    const double difference = std::abs(opinion.distance - truth.distance);
    opinion.relative_error = difference == 0.0      ? 0.0
                             : truth.distance > 0.0 ? difference / truth.distance
                                                    : INFINITE;
    if (!opinion.wrong || (opinion.who != FCL && opinion.who != FCL_UNSCALED)) continue;
    const FclResult named = opinion.who == FCL ? court.fcl(X_WM) : unscaled;
    row.pairs.push_back(
        court.judged_pair(opinion.who, X_WM, named.fixed_body, named.triangle_moving, named.triangle_fixed));
  }
  row.opinions = std::move(opinions);
  return row;
}

}  // namespace

std::filesystem::path experiment_file_of(const std::filesystem::path& result) {
  for (const std::string& argument : ResultReader(result).texts("/provenance/argv"))
    if (argument.ends_with(".json")) return argument;
  return {};
}

Ledger arbitrate(const std::filesystem::path& result, const std::filesystem::path& experiment_file) {
  const ResultReader file(result);
  if (!file.has("/crosscheck") || !file.has("/crosscheck/fcl"))
    throw InputError(result.string(), "/crosscheck/fcl", "the run was not cross-checked",
                     "run it with --set /probes/fcl/stride_frames=20");
  const Experiment experiment =
      parse_experiment(file.texts("/provenance/experiment").front(), experiment_file);
  const PreparedRun run = prepare(experiment);
  const std::vector<double> positions = file.reals("/path/position");
  const std::vector<Pose>& poses = run.input.poses;
  bool same = positions.size() == 3 * poses.size();
  for (std::size_t i = 0; same && i < poses.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      same = same && positions[3 * i + static_cast<std::size_t>(axis)] == poses[i].translation[axis];
  if (!same)
    throw InputError(result.string(), "/path/position", "the path found is not the one of the run",
                     "run the experiment again, or name its file with --experiment");

  const Court court(run);
  Ledger ledger;
  ledger.experiment = experiment.name;
  ledger.scale = court.scale();
  const std::optional<double> tolerance = file.real_attribute("/crosscheck/fcl", "tolerance_relative");
  if (!tolerance)
    throw InputError(result.string(), "/crosscheck/fcl", "attribute tolerance_relative is missing",
                     "run the experiment again");
  ledger.tolerance = *tolerance;
  const std::vector<std::int64_t> frames = file.integers("/crosscheck/fcl/frame");
  const std::vector<double> fcl = file.reals("/crosscheck/fcl/distance");
  const std::vector<double> own = file.reals("/crosscheck/fcl/lmdbench_distance");
  std::vector<std::vector<double>> differences;
  for (const MethodChoice& method : experiment.methods)
    differences.push_back(
        file.reals("/methods/" + method.label + "/fcl/minimum_distance_difference_relative"));
  ledger.frames = static_cast<std::int64_t>(frames.size());

  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Pose& pose = poses[static_cast<std::size_t>(frames[i])];
    std::vector<Opinion> opinions{{FCL, fcl[i]}, {"lmdbench", own[i]}};
    for (std::size_t m = 0; m < differences.size(); ++m) {
      const double difference = differences[m][i];  // NaN where the method was not asked
      if (!std::isnan(difference))
        opinions.push_back({experiment.methods[m].label, fcl[i] * (1.0 + difference)});
    }
    const auto any_differs = [&] {
      return std::any_of(opinions.begin(), opinions.end(), [&](const Opinion& opinion) {
        return differ(opinion.distance, opinions[1].distance, ledger.tolerance);
      });
    };
    if (any_differs()) ++ledger.disagreements;
    const FclResult unscaled = court.fcl_unscaled(pose);
    opinions.push_back({FCL_UNSCALED, unscaled.separated ? unscaled.distance : 0.0});
    if (!any_differs()) continue;
    LedgerRow row = judge(court, pose, std::move(opinions), unscaled, ledger.tolerance);
    row.frame = frames[i];
    ledger.rows.push_back(std::move(row));
  }
  return ledger;
}

}  // namespace lmdbench::exact
