// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>

#include <support/parts/rest_fits.h>

#include <array>
#include <cstddef>
#include <string>

/// Truth for parts at rest (support/parts/rest_fits.h) from proved bounds of triangle distances,
/// places known by construction, and each LMD's own numbers. Shares no code with src/lmdbench/lmd.
namespace lmdbench::exact {

/// Kinds of wrong answers.
enum class RestFault : std::uint8_t {
  NEAREST,     ///< The least distance of the set is not that of the meshes.
  MISSING,     ///< A place has no LMD.
  DOUBLED,     ///< A place has several LMDs.
  UNEXPECTED,  ///< An LMD where no place is, or at another distance or in another direction.
  UNTRUE       ///< Points off the named features, or a distance or direction that is not theirs.
};
inline constexpr std::array REST_FAULT_NAMES = {"nearest", "missing", "doubled", "unexpected", "untrue"};

struct RestVerdict {
  std::array<std::size_t, REST_FAULT_NAMES.size()> faults{};
  std::string objections;  ///< One per line.

  bool is_faulty() const { return !objections.empty(); }
};

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
  void find_nearest();
  bool is_true(const Lmd& lmd, std::string& why) const;
  bool is_at(const parts::RestPlace& place, const Lmd& lmd) const;

  const parts::RestScene& scene_;
  RigidTransform X_WM_, X_DW_;
  double rounding_, tolerance_, tilt_;
  double nearest_low_ = 0.0, nearest_high_ = 0.0;
  bool intersecting_ = false;
};

}  // namespace lmdbench::exact
