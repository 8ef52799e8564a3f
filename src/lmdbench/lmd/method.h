// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/work_counters.h>

namespace lmdbench {

struct MethodDescription;

/// One way to find the LMD set of two bodies; scene/scene_search.h makes of it one over a scene. A method
/// owns its scratch memory and is used by one thread at a time; the bodies that it reads are shared, and
/// immutable but where they deform.
class Method {
 public:
  virtual ~Method() = default;

  /// What is known of the method without an instance; the same object for all of them.
  virtual const MethodDescription& description() const = 0;

  /// Finds an LMD set from scratch.
  /// @param X_WM     pose of the moving mesh
  /// @param lmds     receives the set, sorted by `lmd_less`; for the paper's algorithms these are the
  ///                 candidates before reduction
  /// @param counters is added to
  virtual void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) = 0;

  /// Brings a set to a new pose (L1..L4) and drops duplicates by the method's rule. Tracked pairs may lie
  /// beyond the cutoff: they stay in the set, exert no force and are not reported (see `within_cutoff`).
  virtual void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) = 0;

  /// Finds all critical pairs (critical_pair.h). Only for methods whose description says that they do
  /// (`finds_critical_pairs`); costs more than `search`.
  /// @throws std::logic_error for others
  virtual void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters);
};

/// The pairs of a tracked set that count as LMDs: those within the cutoff.
LmdSet within_cutoff(const LmdSet& lmds, double cutoff);

}  // namespace lmdbench
