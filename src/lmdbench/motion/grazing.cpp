// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/significant_digits.h>
#include <lmdbench/motion/grazing.h>
#include <lmdbench/motion/interpolate.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace lmdbench {
namespace {

/// A path counts as grazing when it comes this near, in cutoffs.
constexpr double NEAR_ENOUGH = 0.5;

/// Of lengths and speeds, so that a specification can be read.
constexpr int DIGITS = 4;

}  // namespace

PathSpec grazing_spec(const PathScene& scene, double cutoff) {
  PathSpec spec;
  spec.frame_rate = spec.stored_rate = GRAZING_RATE;
  spec.seed = 1;
  spec.turn_rate = 35.0 * DEGREE;
  // A small mesh must not have to run around a large one faster than it can follow its surface.
  const double orbit = scene.moving_radius + scene.fixed_radius;
  spec.slide_rate = to_significant_digits(30.0 * std::min(1.0, scene.diagonal / orbit), DIGITS) * DEGREE;
  const double share = cutoff / scene.diagonal;
  spec.gap_floor = to_significant_digits(GRAZING_FLOOR_IN_CUTOFFS * share, DIGITS);
  for (const GapPoint& point : GRAZING_GAPS_IN_CUTOFFS)
    spec.gaps.push_back({.time = point.time, .gap = to_significant_digits(point.gap * share, DIGITS)});
  return spec;
}

GrazingPath grazing_path(const PathScene& scene, double cutoff, double haptic_rate,
                         const ProgressFunction& progress) {
  GrazingPath result{.spec = grazing_spec(scene, cutoff), .path = {}};
  double smallest = 0.0;
  for (std::uint64_t seed = 1; seed <= GRAZING_SEEDS; ++seed) {
    for (const double rate : {std::min(GRAZING_RATE, haptic_rate), haptic_rate}) {
      result.spec.seed = seed;
      result.spec.frame_rate = result.spec.stored_rate = rate;
      result.path = generate_path(result.spec, scene, progress);
      const GapMeasure gaps =
          measure_gaps(resample(PathInterpolator(result.path), haptic_rate), scene.distance, progress);
      result.smallest_gap = smallest = gaps.smallest();
      if (smallest < GRAZING_FLOOR_IN_CUTOFFS * cutoff) continue;  // between the poses: at every frame, then
      if (smallest <= NEAR_ENOUGH * cutoff) return result;
      break;  // it misses at any rate
    }
  }
  throw InputError("", "",
                   fmt::format("no path grazes: the last of {} came to {:.3g} m, the cutoff is {:.3g} m",
                               GRAZING_SEEDS, smallest, cutoff),
                   "the meshes may be nested or far too unequal: give a path, or check scale and diagonal_m");
}

}  // namespace lmdbench
