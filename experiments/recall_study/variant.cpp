// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <recall_study/variant.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace lmdbench::recall_study {
namespace {

/// Relative to the true minimum distance.
constexpr double MINIMUM_TOLERANCE = 1e-6;

/// From "only exact directions" to "any direction"; decision E5's sweep.
constexpr double G5_TOLERANCES_RAD[] = {
    0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, std::numbers::pi / 2.0, std::numbers::pi};

bool misses_minimum(const LmdSet& truth, const LmdSet& reported) {
  if (truth.empty()) return false;
  const double true_minimum = minimum_distance(truth);
  // Written so that NaN (nothing reported) counts as missed.
  return !(std::abs(minimum_distance(reported) - true_minimum) <= MINIMUM_TOLERANCE * true_minimum);
}

}  // namespace

std::vector<Variant> improved_variants() {
  MethodOptions off;
  off.visibility = Visibility::OFF;
  MethodOptions vertex_normal;
  vertex_normal.visibility = Visibility::VERTEX_NORMAL;
  MethodOptions orthogonal;
  orthogonal.visibility = Visibility::ORTHOGONAL;
  MethodOptions literal_g3 = off;
  literal_g3.literal_g3 = true;
  std::vector<Variant> variants = {
      {"cones only (visibility off)", "improved", off, 0},
      {"visibility vertex-normal", "improved", vertex_normal, 0},
      {"visibility orthogonal", "improved", orthogonal, 0},
      {"G3 as printed (E2), visibility off", "improved", literal_g3, 0},
  };
  const auto add_tracked = [&variants](const std::string& label, MethodOptions options, Reduction reduction,
                                       TrackingOrder order) {
    options.reduction = reduction;
    options.tracking_order = order;
    variants.push_back({label, "improved", options, 1});
  };
  for (const auto& [name, options] : {std::pair("off", off), std::pair("vertex-normal", vertex_normal)}) {
    const std::string visibility = fmt::format("visibility {}, ", name);
    add_tracked(visibility + "published reduction", options, Reduction::PUBLISHED,
                TrackingOrder::NEAREST_FIRST);
    add_tracked(visibility + "published reduction in triangle order", options, Reduction::PUBLISHED,
                TrackingOrder::TRIANGLE_INDEX);
    add_tracked(visibility + "loss-free reduction", options, Reduction::LOSS_FREE,
                TrackingOrder::NEAREST_FIRST);
  }
  return variants;
}

std::vector<Variant> original_variants() {
  std::vector<Variant> variants;
  for (const int trackings : {0, 1})
    for (const double tolerance : G5_TOLERANCES_RAD) {
      MethodOptions options;
      options.g5_tolerance_rad = tolerance;
      variants.push_back(
          {fmt::format("G5 tolerance {:.2f} rad{}", tolerance, trackings == 0 ? "" : ", tracked"), "original",
           options, trackings});
    }
  return variants;
}

VariantResult judge(const Variant& variant, const Scene& scene, const std::vector<Pose>& poses,
                    const std::vector<LmdSet>& truth) {
  VariantResult result;
  result.variant = variant;
  const std::unique_ptr<Method> method = make_method(variant.method, scene, variant.options);
  LmdSet lmds;
  WorkCounters counters;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    method->search(poses[i], lmds, counters);
    for (int k = 0; k < variant.trackings; ++k) method->track(poses[i], lmds, counters);
    const LmdSet reported = distinct_pairs(within_cutoff(lmds, scene.cutoff));
    const Agreement same = agreement(truth[i], reported, Match::SAME_FEATURES, scene);
    result.same += same;
    result.neighbours += agreement(truth[i], reported, Match::NEIGHBOURING_FEATURES, scene);
    if (same.missed() > 0) ++result.poses_with_loss;
    if (misses_minimum(truth[i], reported)) ++result.minimum_missed;
  }
  return result;
}

}  // namespace lmdbench::recall_study
