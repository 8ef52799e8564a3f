// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/run/lockstep.h>
#include <lmdbench/run/mover_play.h>
#include <lmdbench/run/truth_probe.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/// What is true of several movers, beside any method's opinion: contact, exhaustive sets, nearest pairs. All look at every pair of objects
/// whose spheres are near enough.
namespace lmdbench {

/// Exact distances of the nearest two objects.
class MoverDistances {
 public:
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  ///< [m]; 0 where meshes touch or intersect.
    ObjectPair objects;
    std::int32_t triangle_moving = -1;  ///< -1: no pair within the bound.
    std::int32_t triangle_fixed = -1;
  };

  /// @param play must outlive this
  explicit MoverDistances(const MoverPlay& play) : play_(play), scene_(play.scene(0.0)), near_(scene_) {}
  MoverDistances(const MoverDistances&) = delete;
  MoverDistances& operator=(const MoverDistances&) = delete;

  /// Of equal distances that of the pair whose spheres are nearer.
  /// @param bound distances above this are not looked for [m]
  Nearest at(std::size_t frame, double bound = std::numeric_limits<double>::infinity());
  /// Whether any two objects, of which one moves, are that near.
  bool any_within(std::size_t frame, double distance);

 private:
  const MoverPlay& play_;
  const MoverScene scene_;
  NearPairs near_;
};

/// "In contact" (contact.h): one a frame, whether any pair is within the cutoff.
std::vector<bool> frames_in_contact(const MoverPlay& play, double cutoff);

/// As of one mover (truth_probe.h). Sets are of all pairs; forces of TruthFrame are the moving mesh's, `movers` has those of all.
std::vector<TruthFrame> probe_mover_truth(const MoverPlay& play, const LockstepInput& input,
                                          const ForceProfile& profile,
                                          const std::vector<std::int64_t>& frames, const Progress& progress,
                                          const std::vector<bool>* in_contact);

/// Recall and precision over the LMDs of all pairs, the largest force error and angle of all movers; jumps are the moving mesh's.
std::vector<TruthComparison> compare_with_truth(const std::vector<TruthFrame>& truth,
                                                const MethodRecord& record, ForceLaw law,
                                                const MoverPlay& play);

}  // namespace lmdbench
