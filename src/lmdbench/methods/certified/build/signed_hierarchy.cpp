// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/cone.h>
#include <lmdbench/lmd/body.h>
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/build/signed_hierarchy.h>

#include <cmath>
#include <vector>

namespace lmdbench {

namespace {

/// A cap wider than a cone by a slack, far more than the turn of indices (GENERIC_TURN).
PolarCap signed_cap_of(const Cone& cone, double slack) {
  const double cosine = cone.cosine - slack * cone.sine - slack * slack;
  if (!(cosine > 0.0)) return {};
  return {cone.axis, cosine, std::sqrt(1.0 - cosine * cosine)};
}

}  // namespace

std::optional<PolarCap> signed_cap(const SignedFeatures& signs, const ShapeComplex& shape,
                                   const FeatureId& lead) {
  const auto normal_of = [&](std::int32_t region) -> const Vec3& {
    return shape.regions.planes[static_cast<std::size_t>(region)].normal;
  };
  std::vector<Vec3> normals;
  if (lead.kind == FeatureKind::FACE) {
    if (shape.region_of(lead.index) < 0) return std::nullopt;
    normals = {normal_of(shape.region_of(lead.index))};
  } else if (lead.kind == FeatureKind::EDGE) {
    const SignedFeatures::Chain& chain = signs.chains[static_cast<std::size_t>(shape.chain_of(lead.index))];
    if (!chain.has_index) return std::nullopt;
    normals = {normal_of(chain.sides[0].region), normal_of(chain.sides[1].region)};
  } else {
    const SignedFeatures::Corner& corner = signs.corners[static_cast<std::size_t>(lead.index)];
    if (corner.kind == SignedFeatures::CornerKind::NONE) return std::nullopt;
    if (corner.kind == SignedFeatures::CornerKind::FOLDED) return PolarCap{};
    for (std::uint32_t k = 0; k < corner.count; ++k)
      normals.push_back(normal_of(signs.regions[corner.first + k]));
  }
  const Cone cone = convex_cone_of_directions(normals);
  if (!(cone.cosine > 0.0)) return PolarCap{};
  return signed_cap_of(cone, lead.kind == FeatureKind::VERTEX ? POLAR_SLACK : PARALLEL_SLACK);
}

PolarCap merged_caps(const PolarCap& a, const PolarCap& b) {
  if (a.is_all_directions() || b.is_all_directions()) return {};
  const Cone both = merge_cones({a.axis, a.cosine, a.sine}, {b.axis, b.cosine, b.sine});
  return both.cosine > 0.0 ? PolarCap{both.axis, both.cosine, both.sine} : PolarCap{};
}

void SignedHierarchy::follow(const Body& body, const SurfaceChange& change) {
  if (change.moved.empty()) return;
  const std::uint32_t now = hierarchy.changes.now + 1;
  *this = of(body);
  hierarchy.changes.now = hierarchy.changes.frame = now;
}

SignedHierarchy SignedHierarchy::of(const Body& body) {
  return {
      build_wide_hierarchy(body.surface(), &body.prepared<ShapeComplex>(), &body.prepared<SignedFeatures>())};
}

}  // namespace lmdbench
