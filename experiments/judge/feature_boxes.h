// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/feature.h>
#include <lmdbench/mesh/surface.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

/// Features that are near each other, by bounding boxes and one sorted axis. All exact judges rely
/// on it, so it shares nothing with the judged searches.
namespace lmdbench::testing {

struct FeatureBox {
  Eigen::AlignedBox3d box;
  std::int32_t index = -1;
};

/// Boxes of all features of a kind.
inline std::vector<FeatureBox> feature_boxes(const Surface& surface, const std::vector<Vec3>& vertices_W,
                                             FeatureKind kind) {
  std::vector<FeatureBox> boxes;
  const auto add = [&](const auto& corners) {
    FeatureBox entry{{}, static_cast<std::int32_t>(boxes.size())};
    for (const std::int32_t corner : corners) entry.box.extend(vertices_W[static_cast<std::size_t>(corner)]);
    boxes.push_back(entry);
  };
  switch (kind) {
    case FeatureKind::VERTEX:
      for (std::size_t i = 0; i < vertices_W.size(); ++i) add(std::array{static_cast<std::int32_t>(i)});
      break;
    case FeatureKind::EDGE:
      for (const auto& edge : surface.adjacency.edges) add(edge);
      break;
    case FeatureKind::FACE:
      for (const auto& triangle : surface.mesh.triangles) add(triangle);
      break;
  }
  return boxes;
}

/// Calls visit(index of a, index of b) for all pairs of boxes within `reach`, and maybe for some
/// beyond it.
template <typename Visit>
void for_each_near(const std::vector<FeatureBox>& a, std::vector<FeatureBox> b, double reach, Visit visit) {
  // Box distances carry a few roundings; a larger reach only costs extra visits.
  constexpr double SLACK = 1e-12;
  double widest = 0.0, coordinates = 0.0;
  for (const FeatureBox& entry : b) {
    widest = std::max(widest, entry.box.sizes().x());
    coordinates =
        std::max({coordinates, entry.box.min().cwiseAbs().maxCoeff(), entry.box.max().cwiseAbs().maxCoeff()});
  }
  reach += SLACK * (reach + coordinates);
  std::sort(b.begin(), b.end(), [](const FeatureBox& left, const FeatureBox& right) {
    return left.box.min().x() < right.box.min().x();
  });
  for (const FeatureBox& one : a) {
    auto other = std::lower_bound(b.begin(), b.end(), one.box.min().x() - reach - widest,
                                  [](const FeatureBox& entry, double x) { return entry.box.min().x() < x; });
    for (; other != b.end() && other->box.min().x() <= one.box.max().x() + reach; ++other)
      if (one.box.squaredExteriorDistance(other->box) <= reach * reach) visit(one.index, other->index);
  }
}

}  // namespace lmdbench::testing
