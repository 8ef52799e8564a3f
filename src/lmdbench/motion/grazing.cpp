// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/motion/grazing.h>
#include <lmdbench/motion/interpolate.h>
#include <lmdbench/scene/broad_phase.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace lmdbench {
namespace {

/// A path counts as grazing when it comes this near, in cutoffs.
constexpr double NEAR_ENOUGH = 0.5;

/// Digits of lengths and speeds, so that people can read a specification.
constexpr int DIGITS = 4;

/// Stages of a seed: poses and gaps at the first rate, and again at all frames if too near.
constexpr std::size_t USUAL_STAGES = 2;
constexpr std::size_t STAGE_SHARES = 1000;

/// One progress over all seeds, which never goes back: every stage of every seed is an equal part.
class SeedProgress {
 public:
  SeedProgress(const ProgressFunction& progress, std::uint64_t seeds) : progress_(progress), seeds_(seeds) {}

  void begin_seed(std::uint64_t seed) { first_ = (seed - 1) * USUAL_STAGES * STAGE_SHARES; }

  /// For `generate_path` and `measure_gaps`; stages beyond USUAL_STAGES stay at the seed's end.
  ProgressFunction of_stage(std::size_t stage) {
    if (!progress_) return {};
    return [this, stage](std::size_t done, std::size_t all) {
      const std::size_t within = std::min(stage * STAGE_SHARES + (all > 0 ? done * STAGE_SHARES / all : 0),
                                          USUAL_STAGES * STAGE_SHARES);
      shown_ = std::max(shown_, first_ + within);
      progress_(shown_, static_cast<std::size_t>(seeds_) * USUAL_STAGES * STAGE_SHARES);
    };
  }

 private:
  ProgressFunction progress_;
  std::uint64_t seeds_;
  std::size_t first_ = 0;
  std::size_t shown_ = 0;
};

/// The smallest distance of the frames [m]. A frame is measured only if, by how far a point can
/// have moved since the last measured one, it may be below the least so far.
double smallest_gap(const Path& frames, const PathScene& scene, const ProgressFunction& progress) {
  const MeshBounds bounds{.centre = scene.moving_centre_M, .radius = scene.moving_radius};
  double least = std::numeric_limits<double>::infinity(), last = 0.0;
  const Pose* looked_at = nullptr;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Pose& pose = frames[i].pose;
    if (looked_at == nullptr || last - farthest_motion(bounds, *looked_at, pose) < least) {
      last = scene.distance(pose);
      least = std::min(least, last);
      looked_at = &pose;
    }
    if (progress) progress(i + 1, frames.size());
  }
  return least;
}

/// @param smallest receives the smallest gap over the haptic frames [m]
/// @return nothing where the seed's path misses, or comes too near at any rate
std::optional<GrazingPath> path_of_seed(const PathScene& scene, double cutoff, double haptic_rate,
                                        std::uint64_t seed, SeedProgress& progress, double& smallest) {
  GrazingPath result{.spec = grazing_spec(scene, cutoff), .path = {}};
  std::size_t stage = 0;
  progress.begin_seed(seed);
  for (const double rate : {std::min(GRAZING_RATE, haptic_rate), haptic_rate}) {
    result.spec.seed = seed;
    result.spec.frame_rate = result.spec.stored_rate = rate;
    result.path = generate_path(result.spec, scene, progress.of_stage(stage++));
    result.smallest_gap = smallest =
        smallest_gap(resample(PathInterpolator(result.path), haptic_rate), scene, progress.of_stage(stage++));
    if (smallest < GRAZING_FLOOR_IN_CUTOFFS * cutoff) continue;  // then all frames
    if (smallest <= NEAR_ENOUGH * cutoff) return result;
    break;  // it misses at any rate
  }
  return std::nullopt;
}

}  // namespace

PathSpec grazing_spec(const PathScene& scene, double cutoff) {
  LMDBENCH_EXPECTS(cutoff > 0.0 && scene.diagonal > 0.0, "a scene whose cutoff or mesh was not checked");
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
  // Any number of contacts is enough: the first path.
  return rich_grazing_path(
      scene, cutoff, haptic_rate, [](const Path&) { return RICH_CONTACTS; }, progress);
}

GrazingPath rich_grazing_path(const PathScene& scene, double cutoff, double haptic_rate,
                              const std::function<double(const Path&)>& contacts,
                              const ProgressFunction& progress, const std::string& file) {
  double smallest = 0.0;
  std::optional<GrazingPath> best;
  double most = 0.0;
  SeedProgress seeds(progress, GRAZING_SEEDS);
  for (std::uint64_t seed = 1; seed <= (best ? RICH_SEEDS : GRAZING_SEEDS); ++seed) {
    std::optional<GrazingPath> made = path_of_seed(scene, cutoff, haptic_rate, seed, seeds, smallest);
    if (!made) continue;
    const double count = contacts(made->path);
    if (count >= RICH_CONTACTS) return std::move(*made);
    if (!best || count > most) {
      best = std::move(made);
      most = count;
    }
  }
  if (best) return std::move(*best);
  throw InputError(file, "",
                   fmt::format("no path grazes: the last of {} came to {:.3g} m, the cutoff is {:.3g} m",
                               GRAZING_SEEDS, smallest, cutoff),
                   "the meshes may be nested or far too unequal: give a path, or check scale and diagonal_m");
}

}  // namespace lmdbench
