// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/completeness/study.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench::completeness {

/// `certified` on two plates whose coordinates were rounded to single precision, each turned and
/// moved on its own. By design they have one contact of known place and direction.
struct RoundedPlates {
  std::size_t triangles = 0;  ///< Of each plate.
  std::size_t poses = 0;
  std::size_t one_lmd = 0;       ///< Poses with exactly one LMD.
  double worst_point = 0.0;      ///< From the designed overlap's centroid, over its diameter.
  double worst_direction = 0.0;  ///< Angle from the designed normal [rad].
  std::vector<double> seconds;   ///< Processor time of each search from scratch.
};

/// Judges unrelated poses of plates of `cells` by `cells` squares.
RoundedPlates judge_rounded_plates(int cells, std::uint64_t seed, std::size_t poses,
                                   const Complain& complain);

/// Squares along a side of the judged plates, which have 96 to 16,896 triangles.
inline constexpr int ROUNDED_PLATE_CELLS[] = {4, 16, 32, 64};
/// Largest allowed errors of the point and the direction.
inline constexpr double ROUNDED_POINT_SHARE = 0.01, ROUNDED_DIRECTION_RAD = 1e-6;

}  // namespace lmdbench::completeness
