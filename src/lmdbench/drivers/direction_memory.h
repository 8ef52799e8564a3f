// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>

#include <cstddef>
#include <cstdint>

namespace lmdbench {

/// Decision E12, ours: triangles that intersect have no direction. Their LMD keeps the
/// last valid one: of the same feature pair a frame ago, else of the nearest LMD of that frame on
/// the same fixed mesh, however far it is: faces at a small angle cross along a long line, and the
/// contact's representative may be far from the first points. An older frame lends within the
/// cutoff. Without either the LMD has no direction and exerts no force.
class DirectionMemory {
 public:
  /// @param cutoff how far an older frame's LMD may be from one that borrows its direction [m]
  explicit DirectionMemory(double cutoff) : cutoff_(cutoff) {}

  /// Sets of up to so many LMDs need no memory from then on.
  void reserve(std::size_t lmds) {
    last_.reserve(lmds);
    known_.reserve(lmds);
  }

  /// Gives the frame's LMDs directions and remembers them for the next frame.
  /// @return how many LMDs had none of their own
  std::int64_t complete(LmdSet& lmds);

 private:
  double cutoff_;
  LmdSet last_;            ///< LMDs with a direction of the last frame that had any.
  LmdSet known_;           ///< Those of the frame under way; kept for its memory.
  bool is_older_ = false;  ///< That frame is not the one before.
};

}  // namespace lmdbench
