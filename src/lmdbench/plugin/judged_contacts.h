// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/body.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/work_counters.h>
#include <lmdbench/plugin/lmdbench_method.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace lmdbench {

/// Tolerance of a point on its triangle, in diagonals of its mesh: some single-precision roundings.
inline constexpr double POINT_TOLERANCE = 1e-6;

/// What is wrong with a plugin's answers, counted frame by frame beside the plugin's own counters.
enum class PluginMark : std::uint8_t {
  LOST,             ///< No answer: the frame has no contact.
  NOT_FINITE,       ///< Contacts with a coordinate that is no number: left out.
  OFF_MESH,         ///< Contacts with no such triangle, or a point off it: left out.
  OTHER_PART,       ///< Points off the named part: the host finds the part.
  DUPLICATES,       ///< Contacts of a feature pair that a nearer one has: left out.
  UNSORTED,         ///< Answers not sorted by distance.
  TOO_MANY,         ///< Answers with too many contacts: left out whole.
  FLOAT_MODE,       ///< Calls that changed the rounding mode or flush-to-zero.
  FORCE_WRONG,      ///< Forces of its own, not finite or missing: left out.
  FIRST_OF_ITS_OWN  ///< Index of the plugin's first counter.
};

/// The marks as counters of a method.
std::vector<CounterDescription> plugin_marks();

/// Makes LMDs of contacts of two bodies, all of which it checks: points must be finite and on the
/// mesh; part, distance and direction are computed here; faulty contacts are dropped and counted.
class ContactJudge {
 public:
  ContactJudge(std::shared_ptr<const Body> a, std::shared_ptr<const Body> b);

  /// @param X_BA     pose of A in B's frame
  /// @param lmds     receives them, nearest first
  /// @param counters are added to
  void judge(std::span<const lmdbench_contact> contacts, const RigidTransform& X_BA, LmdSet& lmds,
             WorkCounters& counters) const;

 private:
  std::shared_ptr<const Body> a_, b_;
  double tolerance_a_, tolerance_b_;  ///< [m]
};

}  // namespace lmdbench
