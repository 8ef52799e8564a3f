// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <study/recall/variant.h>

#include <numbers>

namespace lmdbench::recall_study {
namespace {

using Json = nlohmann::json;

/// From "only exact directions" to "any direction"; decision E5's sweep.
constexpr double G5_TOLERANCES_RAD[] = {
    0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, std::numbers::pi / 2.0, std::numbers::pi};

}  // namespace

std::vector<Variant> improved_variants() {
  const Json off = {{"visibility", "off"}};
  const Json vertex_normal = {{"visibility", "vertex-normal"}};
  std::vector<Variant> variants = {
      {"cones only (visibility off)", "improved", off, 0},
      {"visibility vertex-normal", "improved", vertex_normal, 0},
      {"visibility orthogonal", "improved", {{"visibility", "orthogonal"}}, 0},
      {"G3 as printed (E2), visibility off", "improved", {{"visibility", "off"}, {"literal_g3", true}}, 0},
  };
  for (const Json& visibility : {off, vertex_normal}) {
    const auto add_tracked = [&](const std::string& label, const Json& more) {
      Json options = visibility;
      options.update(more);
      variants.push_back(
          {fmt::format("visibility {}, {}", visibility["visibility"].get<std::string>(), label), "improved",
           options, 1});
    };
    add_tracked("published reduction", {{"reduction", "published"}});
    add_tracked("published reduction in triangle order",
                {{"reduction", "published"}, {"tracking_order", "triangle-index"}});
    add_tracked("loss-free reduction", {{"reduction", "loss-free"}});
  }
  return variants;
}

std::vector<Variant> original_variants() {
  std::vector<Variant> variants;
  for (const int trackings : {0, 1})
    for (const double tolerance : G5_TOLERANCES_RAD)
      variants.push_back(
          {fmt::format("G5 tolerance {:.2f} rad{}", tolerance, trackings == 0 ? "" : ", tracked"),
           "original",
           {{"g5_tolerance_deg", tolerance * 180.0 / std::numbers::pi}},
           trackings});
  return variants;
}

VariantResult judge(const Variant& variant, const Scene& scene, const std::vector<Pose>& poses,
                    const experiments::Truth& truth) {
  VariantResult result;
  result.variant = variant;
  const std::unique_ptr<Method> method = make_method(variant.method, scene, variant.options);
  LmdSet lmds;
  WorkCounters counters;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    method->search(poses[i], lmds, counters);
    for (int k = 0; k < variant.trackings; ++k) method->track(poses[i], lmds, counters);
    const LmdSet reported = distinct_pairs(within_cutoff(lmds, scene.cutoff));
    const auto missed_before = result.error.same.missed();
    result.error.add(Promise::APPROXIMATION, "", scene, truth[i], &reported, minimum_distance(reported));
    if (result.error.same.missed() > missed_before) ++result.poses_with_loss;
  }
  return result;
}

}  // namespace lmdbench::recall_study
