// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/body.h>
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/build/hierarchies_among.h>
#include <lmdbench/methods/certified/build/polar_cap.h>
#include <lmdbench/methods/certified/build/signed_hierarchy.h>
#include <lmdbench/shape/shape_complex.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lmdbench {

namespace {

/// Coordinates up to so many times the mesh's own leave the slack of caps enough for all wings.
constexpr double LARGEST_RATIO = 20.0;

double shortest_wing(const Surface& surface, const ShapeComplex& shape) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto take = [&](const Vec3& wing) {
    const double length = wing.norm();
    if (length > LEAST_WING * shape.regions.extent) shortest = std::min(shortest, length);
    return true;
  };
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(surface.mesh.vertices.size()); ++v)
    if (shape.is_corner(v)) shape.for_each_corner_wing(surface, v, take);
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(shape.regions.straight_edges.size()); ++c) {
    shape.for_each_chain_wing(surface, c, take);
    const Segment line = surface.mesh.segment(shape.ends_of_chain(c));
    take(line[1] - line[0]);
  }
  return shortest;
}

template <bool WithCritical>
const WideHierarchy& prepared_for_all(const Body& body) {
  if constexpr (WithCritical)
    return body.prepared<SignedHierarchy>().hierarchy;
  else
    return body.prepared<WideHierarchy>();
}

/// @param exponent  of the power of two that bounds the coordinates
template <bool WithCritical>
WideHierarchy build_among(const Body& body, int exponent) {
  ShapeComplex shape = body.prepared<ShapeComplex>();
  // What the least wing is measured by.
  shape.regions.extent = std::ldexp(1.0, exponent) / LARGEST_RATIO;
  return build_wide_hierarchy(body.surface(), &shape,
                              WithCritical ? &body.prepared<SignedFeatures>() : nullptr);
}

}  // namespace

template <bool WithCritical>
HierarchiesAmong<WithCritical> HierarchiesAmong<WithCritical>::of(const Body& body) {
  // It follows a deformation after what it builds on.
  prepared_for_all<WithCritical>(body);
  return {};
}

template <bool WithCritical>
void HierarchiesAmong<WithCritical>::follow(const Body& body, const SurfaceChange& change) {
  if (change.moved.empty()) return;
  shortest_wing_.reset();
  for (auto& [exponent, hierarchy] : made_) {
    const std::uint32_t now = hierarchy->changes.now + 1;
    *hierarchy = build_among<WithCritical>(body, exponent);
    hierarchy->changes.now = hierarchy->changes.frame = now;
  }
}

template <bool WithCritical>
const WideHierarchy& HierarchiesAmong<WithCritical>::at(const Body& body, double coordinates) const {
  const auto& shape = body.prepared<ShapeComplex>();
  const double least_wing = LEAST_WING / LARGEST_RATIO * coordinates;
  if (least_wing <= LEAST_WING * shape.regions.extent) return prepared_for_all<WithCritical>(body);
  const std::lock_guard lock(*mutex_);
  if (!shortest_wing_) shortest_wing_ = shortest_wing(body.surface(), shape);
  if (*shortest_wing_ > least_wing) return prepared_for_all<WithCritical>(body);
  const int exponent = static_cast<int>(std::ceil(std::log2(coordinates)));
  std::unique_ptr<WideHierarchy>& made = made_[exponent];
  if (!made) made = std::make_unique<WideHierarchy>(build_among<WithCritical>(body, exponent));
  return *made;
}

template class HierarchiesAmong<false>;
template class HierarchiesAmong<true>;

}  // namespace lmdbench
