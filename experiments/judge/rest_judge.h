// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>

#include <support/parts/rest_fits.h>

#include <array>
#include <cstddef>
#include <string>

/// Truth where parts rest (support/parts/rest_fits.h). Judged by proved bounds of the distance of every two triangles at the pose as it is,
/// by what is near each other by construction, and by what an LMD says of itself. Shares no code with src/lmdbench/lmd.
namespace lmdbench::exact {

/// What may be wrong with an answer.
enum class RestFault : std::uint8_t {
  NEAREST,     ///< The least distance of the set is not that of the meshes.
  MISSING,     ///< A place has no LMD.
  DOUBLED,     ///< A place has several.
  UNEXPECTED,  ///< An LMD where nothing is near, at a distance or in a direction of nothing there.
  UNTRUE       ///< Points off the features named, a distance or direction that is not theirs.
};
inline constexpr std::array REST_FAULT_NAMES = {"nearest", "missing", "doubled", "unexpected", "untrue"};

struct RestVerdict {
  std::array<std::size_t, REST_FAULT_NAMES.size()> faults{};
  std::string objections;  ///< A line each.

  bool is_faulty() const { return !objections.empty(); }
};

/// One scene.
class RestTruth {
 public:
  explicit RestTruth(const parts::RestScene& scene);

  /// Some triangles share a point, by exact predicates.
  bool intersecting() const { return intersecting_; }
  /// Width within which numbers of a double answer are accepted: 128 epsilon of the largest coordinate, and for meshes in single
  /// precision what both are known to.
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
