// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <judge/basins.h>
#include <judge/contact_area.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

/// Flat contact judged in exact arithmetic, from triangles and their world vertices alone: no plane
/// of several triangles, no rule of the methods. It tests "no small step brings the points nearer".
/// One LMD is each basin of the distance that takes more than the tolerance to leave and whose
/// points see each other's outer sides. Each LMD is at the bottom of such a basin, or at a local
/// minimum with a way down that does not climb (a level recess), which may lack an LMD.
namespace lmdbench::exact {

/// Sums over scenes.
struct FlatCounts {
  std::size_t poses = 0;
  std::size_t touching_poses = 0;   ///< Not judged, because some triangles share a point.
  std::size_t tolerance_poses = 0;  ///< Some decision is left to tolerance.
  std::size_t faulty_poses = 0;
  std::size_t basins = 0;         ///< Those that must have an LMD.
  std::size_t areas = 0;          ///< Of these, plateaus, judged by their centroids.
  std::size_t right = 0;          ///< Basins with exactly one LMD, at the right place.
  std::size_t with_way_down = 0;  ///< LMDs at other local minima than of these basins.
  std::size_t tolerated = 0;      ///< Basins and LMDs left to tolerance.
  std::size_t missed = 0, doubled = 0, untrue = 0, misplaced = 0;

  FlatCounts& operator+=(const FlatCounts& other);
  std::size_t faults() const { return missed + doubled + untrue + misplaced; }
};

/// One body pair in one pose.
class FlatTruth {
 public:
  /// @param cutoff of the LMDs [m]
  FlatTruth(const Surface& moving, const Surface& fixed, const Pose& X_WM, double cutoff);

  /// Some triangles share a point: there the distance is 0 and has no direction.
  bool touching() const { return touching_; }
  std::size_t demanded() const;

  /// Judges the LMDs of the pair.
  /// @param objections receives the errors, one a line
  FlatCounts judge(const LmdSet& lmds, std::string& objections) const;

 private:
  enum class Claim { NONE, OPEN, DEMANDED };
  struct Place {
    Basin basin;
    ContactArea area;
    Claim claim = Claim::NONE;
  };
  Claim claim_of(const Basin& basin) const;
  bool is_one_minimum(const Basin& basin) const;
  bool holds(const std::vector<std::size_t>& pairs, const Lmd& lmd) const;
  bool at_centroid(const ContactArea& area, const Lmd& lmd) const;
  bool is_local_minimum(const Lmd& lmd) const;
  bool is_level_place(const Lmd& lmd) const;

  Cells moving_, fixed_;
  double size_, tolerance_, cutoff_;
  std::unique_ptr<CellPairs> pairs_;
  bool touching_ = false;
  std::vector<Basin> small_climbs_;  ///< Climbs below the tolerance, above rounding.
  std::vector<Place> places_;
};

}  // namespace lmdbench::exact
