// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>

#include <support/parts/rest_fits.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Truth for parts at rest (support/parts/rest_fits.h) from proved bounds of triangle distances,
/// places known by construction, and each LMD's own numbers. Of the methods' code it uses meshes,
/// their features and RigidTransform, no test or rule of an LMD.
///
/// Not asked: LMDs of places that are not demanded (rounding decides whether they are minima) or
/// whose gap is within the tolerance of floats; where on an edge the point of such an LMD lies, and
/// any of floats that is not between two faces; how many pairs intersect.
namespace lmdbench::exact {

/// Kinds of wrong answers.
enum class RestFault : std::uint8_t {
  NEAREST,     ///< The least distance of the set is not that of the meshes.
  MISSING,     ///< A place has no LMD.
  DOUBLED,     ///< A place has several LMDs.
  UNEXPECTED,  ///< An LMD where no place is, or at another distance or in another direction.
  UNTRUE,      ///< Points off the named features, or a distance or direction that is not theirs.
  MISPLACED    ///< Not at the centroid of the area or segment where both parts face each other.
};
inline constexpr std::array REST_FAULT_NAMES = {"nearest",    "missing", "doubled",
                                                "unexpected", "untrue",  "misplaced"};

struct RestVerdict {
  std::array<std::size_t, REST_FAULT_NAMES.size()> faults{};
  std::size_t places = 0;    ///< Known by construction.
  std::size_t demanded = 0;  ///< Of these, those that must have an LMD.
  std::size_t located = 0;   ///< LMDs whose point was asked for.
  std::string objections;    ///< One per line.

  bool is_faulty() const { return !objections.empty(); }
};

struct WorldTriangle;

/// The truth of one scene.
class RestTruth {
 public:
  explicit RestTruth(const parts::RestScene& scene);

  /// Some triangles share a point, by exact predicates.
  bool intersecting() const { return intersecting_; }
  /// Accepted error of numbers in a double answer [m]: 128 epsilon of the largest coordinate; for
  /// float meshes also the tolerance of their planes.
  double tolerance() const { return tolerance_; }

  RestVerdict judge(const LmdSet& lmds) const;

 private:
  void find_nearest(const std::vector<WorldTriangle>& moving, const std::vector<WorldTriangle>& fixed);
  void find_areas(const std::vector<WorldTriangle>& moving, const std::vector<WorldTriangle>& fixed);
  bool is_true(const Lmd& lmd, std::string& why) const;
  bool is_at(const parts::RestPlace& place, const Lmd& lmd) const;
  bool intersects(const Lmd& lmd) const;
  /// Centroid of the place and how far the LMD's point may be from it; none if not known.
  std::optional<std::pair<Vec3, double>> centroid_of(std::size_t place, const Lmd& lmd) const;

  struct Area {
    double size = 0.0;           ///< [m^2]
    Vec3 moment = Vec3::Zero();  ///< Of the moving mesh's side, world frame.
  };

  const parts::RestScene& scene_;
  std::vector<Area> areas_;  ///< Of places of faces, where both meshes face each other.
  RigidTransform X_WM_, X_DW_;
  double rounding_, tolerance_, tilt_;
  double nearest_low_ = 0.0, nearest_high_ = 0.0;
  bool intersecting_ = false;
};

}  // namespace lmdbench::exact
