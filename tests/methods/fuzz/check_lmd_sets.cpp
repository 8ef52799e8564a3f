// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "methods/fuzz/check_lmd_sets.h"

#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/methods/registry.h>

#include <support/lmd_text.h>

#include <algorithm>
#include <cmath>

namespace lmdbench::testing {
namespace {

/// Reads bytes one after the other; zeros after the end.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool empty() const { return at_ >= bytes_.size(); }
  int next() { return at_ < bytes_.size() ? bytes_[at_++] : 0; }
  /// -16 .. 15 sixteenths: a coarse lattice.
  double lattice() { return (next() % 32 - 16) / 16.0; }
  /// -1 .. 1 in steps of 2^-15.
  double fine() { return (256 * next() + next() - 32768) / 32768.0; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

TriangleMesh soup(Bytes& bytes, int triangles) {
  TriangleMesh mesh;
  const int vertices = 3 + bytes.next() % 10;
  for (int i = 0; i < vertices; ++i) {
    const double x = bytes.lattice(), y = bytes.lattice(), z = bytes.lattice();
    mesh.vertices.emplace_back(x, y, z);
  }
  for (int i = 0; i < triangles; ++i) {
    const int a = bytes.next() % vertices, b = bytes.next() % vertices, c = bytes.next() % vertices;
    mesh.triangles.push_back({a, b, c});
  }
  return mesh;
}

TriangleMesh mesh_from(Bytes& bytes) {
  const int kind = bytes.next() % 6, size = bytes.next();
  TriangleMesh mesh;
  switch (kind) {
    case 0:
      return soup(bytes, 1 + size % 16);
    case 1:
      mesh = make_box({1, 1, 1}, 1 + size % 2);
      break;
    case 2:
      mesh = make_sphere(0.6, size % 2);
      break;
    case 3:
      mesh = make_l_block(1.0);
      break;
    case 4:
      mesh = make_needles(0.4, 1.0, 3 + size % 8);
      break;
    default:
      mesh = make_patch(1.0, 1 + size % 3, 0.2);
      break;
  }
  for (int moves = bytes.next() % 4; moves > 0; --moves) {
    Vec3& vertex = mesh.vertices[static_cast<std::size_t>(bytes.next()) % mesh.vertices.size()];
    const double x = bytes.lattice(), y = bytes.lattice(), z = bytes.lattice();
    vertex = {x, y, z};
  }
  return mesh;
}

LmdSet search(const FuzzScene& fuzz, std::string_view name, const nlohmann::json& options = {}) {
  return lmds_at(*make_method(name, fuzz.scene, options), fuzz.X_WM);
}

}  // namespace

std::optional<FuzzScene> scene_from_bytes(std::span<const std::uint8_t> data) {
  Bytes bytes(data);
  TriangleMesh moving = mesh_from(bytes), fixed = mesh_from(bytes);
  if (bytes.empty()) return std::nullopt;
  FuzzScene fuzz;
  fuzz.scene = {std::make_shared<const Body>("moving", build_surface(std::move(moving))),
                {std::make_shared<const Body>("fixed", build_surface(std::move(fixed)))},
                (1 + bytes.next()) / 128.0};
  const bool turned = bytes.next() % 2 == 1;
  const double x = bytes.fine(), y = bytes.fine(), z = bytes.fine();
  fuzz.X_WM.translation = 3.0 * Vec3(x, y, z);
  if (turned) {
    const double qx = bytes.fine(), qy = bytes.fine(), qz = bytes.fine(), qw = bytes.fine();
    const Eigen::Quaterniond q(qw, qx, qy, qz);
    if (q.norm() > 0.0) fuzz.X_WM.rotation = q.normalized();
  }
  return fuzz;
}

std::string broken_promise(const FuzzScene& fuzz) {
  const LmdSet truth = search(fuzz, "exhaustive"), certified = search(fuzz, "certified");
  const auto complain = [&](const std::string& what) {
    return what + "\nexhaustive:\n" + text(truth) + "certified:\n" + text(certified);
  };
  for (const Lmd& lmd : truth) {
    const bool apart = !lmd.intersecting && lmd.distance > 0.0;
    if (!std::isfinite(lmd.distance) || !lmd.point_moving.allFinite() || !lmd.point_fixed.allFinite() ||
        (apart && !lmd.direction.allFinite()))
      return complain("a number of the truth is not finite");
    if (std::abs((lmd.point_fixed - lmd.point_moving).norm() - lmd.distance) > 1e-12)
      return complain("a distance is not that of its points");
    if (lmd.distance > fuzz.scene.cutoff + 1e-12) return complain("an LMD lies beyond the cutoff");
  }
  // Distances that differ by rounding only may be in either order.
  const bool same = std::is_permutation(
      truth.begin(), truth.end(), certified.begin(), certified.end(), [](const Lmd& a, const Lmd& b) {
        return same_feature_pair(a, b) && a.intersecting == b.intersecting &&
               std::abs(a.distance - b.distance) <= 1e-12;
      });
  if (!same) return complain("certified is not exhaustive");
  for (const LmdSet& lmds : {truth, certified})
    if (!std::is_sorted(lmds.begin(), lmds.end(), lmd_less)) return complain("a set is not in its order");
  // Normal cones do not cover boundary edges, nor triangles that intersect.
  const auto sound = [](const Body& body) {
    const ValidityReport report = check_mesh(body.surface());
    return report.closed && report.manifold && report.degenerate_triangles == 0;
  };
  if (truth.empty() || truth.front().distance == 0.0 || !sound(*fuzz.scene.moving) ||
      !sound(*fuzz.scene.fixed[0]))
    return {};
  const LmdSet candidates = search(fuzz, "improved", {{"visibility", "off"}});
  if (!(minimum_distance(candidates) <= minimum_distance(truth) + 1e-12))
    return complain("candidates without the nearest LMD:\n" + text(candidates));
  return {};
}

}  // namespace lmdbench::testing
