// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>

#include <cstddef>
#include <cstdint>

namespace lmdbench {

/// Decision E12, ours: triangles that touch have no direction between them, so an LMD at distance 0
/// keeps the last valid one: that of the same feature pair a frame ago, else that of the nearest
/// LMD of that frame on the same fixed mesh. The representative of a contact may lie far from the points that met first: two
/// faces at a small angle cross along a line as long as they are, so the frame before lends however far its LMD is.
/// An older frame, which need not know of this contact, lends within reach of the cutoff. Without either it
/// stays without direction and exerts no force.
class DirectionMemory {
 public:
  /// @param cutoff how far the LMD of an older frame may lie from the one that borrows its direction [m]
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
