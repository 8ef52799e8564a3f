// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/work_counters.h>

namespace lmdbench {

struct MethodDescription;

/// A way to find the LMD set of two bodies; scene/scene_search.h takes it to scenes. A method owns
/// its scratch memory and is used by one thread at a time; its bodies are shared, and immutable
/// unless they deform.
class Method {
 public:
  virtual ~Method() = default;

  /// What is known of the method without an instance; the same object for all of them.
  virtual const MethodDescription& description() const = 0;

  /// Finds an LMD set from scratch.
  /// @param X_WM     pose of the moving mesh
  /// @param lmds  the set, sorted by `lmd_less`; the paper's algorithms give candidates before
  /// reduction
  /// @param counters is added to
  virtual void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) = 0;

  /// Brings a set to a new pose (L1..L4) and drops duplicates by the method's rule. Tracked pairs
  /// beyond the cutoff stay in the set, but exert no force and are not reported (`within_cutoff`).
  virtual void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) = 0;

  /// Finds all critical pairs (critical_pair.h); costs more than `search`. Only for methods whose
  /// description has `finds_critical_pairs`.
  /// @throws std::logic_error for others
  virtual void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters);
};

/// What `search` and `find_critical` find, where nobody asks for their work.
LmdSet lmds_at(Method& method, const Pose& X_WM);
CriticalSet critical_at(Method& method, const Pose& X_WM);

/// The pairs of a tracked set that count as LMDs: those within the cutoff.
LmdSet within_cutoff(const LmdSet& lmds, double cutoff);

}  // namespace lmdbench
