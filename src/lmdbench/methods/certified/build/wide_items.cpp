// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/parallel.h>
#include <lmdbench/methods/certified/build/signed_hierarchy.h>
#include <lmdbench/methods/certified/build/wide_items.h>
#include <lmdbench/shape/shape_complex.h>

#include <algorithm>
#include <optional>

namespace lmdbench {

namespace {

/// Features of a task. Blocks are joined in order, so that threads do not matter.
constexpr std::size_t BLOCK = 2048;

}  // namespace

std::optional<WideItem> make_wide_item(const Surface& surface, const ShapeComplex* shape,
                                       const SignedFeatures* signs, const FeatureId& feature,
                                       WingSet* bounding) {
  std::optional<PolarCap> cap = polar_cap(surface, feature, shape, bounding);
  if (signs != nullptr)
    if (const auto signed_one = signed_cap(*signs, *shape, feature))
      cap = cap ? merged_caps(*cap, *signed_one) : *signed_one;
  if (!cap && feature.kind != FeatureKind::FACE) return std::nullopt;
  WideItem item;
  item.ref = WideRef::feature(feature);
  item.carries_lmd = cap.has_value();
  if (cap) item.cap = *cap;
  return item;
}

std::vector<WideItem> collect_wide_items(const Surface& surface, const ShapeComplex* shape,
                                         const SignedFeatures* signs) {
  const std::size_t vertices = surface.mesh.vertices.size();
  const std::size_t before_faces = vertices + surface.adjacency.edges.size();
  const std::size_t features = before_faces + surface.mesh.triangles.size();
  const auto feature_at = [&](std::size_t i) -> FeatureId {
    if (i < vertices) return {FeatureKind::VERTEX, static_cast<std::int32_t>(i)};
    if (i < before_faces) return {FeatureKind::EDGE, static_cast<std::int32_t>(i - vertices)};
    return {FeatureKind::FACE, static_cast<std::int32_t>(i - before_faces)};
  };
  std::vector<std::vector<WideItem>> blocks((features + BLOCK - 1) / BLOCK);
  parallel_for(blocks.size(), [&](std::size_t block) {
    blocks[block].reserve(BLOCK);
    const std::size_t end = std::min(features, (block + 1) * BLOCK);
    for (std::size_t i = block * BLOCK; i < end; ++i)
      if (shape == nullptr || shape->is_lead(feature_at(i)))
        if (const auto item = make_wide_item(surface, shape, signs, feature_at(i)))
          blocks[block].push_back(*item);
  });

  std::vector<std::size_t> starts{0};
  for (const auto& block : blocks) starts.push_back(starts.back() + block.size());
  std::vector<WideItem> items(starts.back());
  parallel_for(blocks.size(), [&](std::size_t block) {
    std::copy(blocks[block].begin(), blocks[block].end(),
              items.begin() + static_cast<std::ptrdiff_t>(starts[block]));
  });
  return items;
}

}  // namespace lmdbench
