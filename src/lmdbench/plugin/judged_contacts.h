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

/// How far from its triangle a contact's point may be, in diagonals of its mesh: a few roundings of single precision.
inline constexpr double POINT_TOLERANCE = 1e-6;

/// What is wrong with a plugin's answers, counted frame by frame beside its own counters.
enum class PluginMark : std::uint8_t {
  LOST,             ///< No answer: the frame has no contact.
  NOT_FINITE,       ///< Contacts with a coordinate that is no number: left out.
  OFF_MESH,         ///< Contacts with a triangle that is none, or a point that is not on it: left out.
  OTHER_PART,       ///< Points that are not on the named part of their triangle: the part is looked up.
  DUPLICATES,       ///< Contacts of a feature pair that a nearer one has: left out.
  UNSORTED,         ///< Answers that were not nearest first.
  TOO_MANY,         ///< Answers of more contacts than anybody can want: left out whole.
  FLOAT_MODE,       ///< Calls that left another rounding mode or flush-to-zero.
  FORCE_WRONG,      ///< Forces of its own that are no number or did not come: left out.
  FIRST_OF_ITS_OWN  ///< Index of the plugin's first counter.
};

/// As counters of a method.
std::vector<CounterDescription> plugin_marks();

/// Makes LMDs of contacts of two bodies, of which nothing is believed: points must be finite and on the mesh; the part of the triangle,
/// the distance and the direction are this program's; what is wrong is left out and counted.
class ContactJudge {
 public:
  ContactJudge(std::shared_ptr<const Body> a, std::shared_ptr<const Body> b);

  /// @param X_BA     pose of A in B's frame
  /// @param lmds     receives them, nearest first
  /// @param counters is added to
  void judge(std::span<const lmdbench_contact> contacts, const RigidTransform& X_BA, LmdSet& lmds,
             WorkCounters& counters) const;

 private:
  std::shared_ptr<const Body> a_, b_;
  double tolerance_a_, tolerance_b_;  ///< [m]
};

}  // namespace lmdbench
