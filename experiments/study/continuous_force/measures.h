// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/continuous_force/rendering.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::continuous_force {

/// Sums of indices over random poses of closed solids.
struct SumRow {
  std::string moving, fixed, method;
  int expected = 0;
  std::size_t poses = 0, wrong_sums = 0, other_minima = 0, most_pairs = 0;
};
std::vector<SumRow> measure_sums(std::size_t poses, std::uint64_t seed, bool exhaustive_too);

/// A critical pair's share of a step of the force.
struct PairChange {
  int index = 0;
  double before = 0.0, after = 0.0;  ///< Distance over the cutoff; NaN where the pair is not there.
  double turn = 0.0;                 ///< Angle between both directions [rad]; NaN likewise.
  double change = 0.0;               ///< Change of index f(d) u, in F_max.
};

/// Steps of the force along a path, in units of one LMD's largest force.
struct PathRow {
  std::string scene;
  std::size_t frames = 0, in_contact = 0, separated = 0;
  double minima = 0.0, pairs = 0.0, merges = 0.0;  ///< Means over the poses in contact.
  struct Law {
    std::vector<double> largest;       ///< At the frames, then with worst steps divided by 10.
    std::vector<PairChange> steepest;  ///< Pairs in the largest step of a thousandth of a frame.
    std::size_t above_quarter = 0;     ///< Steps of more than 0.25.
    double separated_difference = 0.0, rms_from_sum = 0.0;
    std::size_t outside_cone = 0;  ///< Forces that are no sum of pushes along LMDs.
    std::size_t against_all = 0;   ///< Forces that pull against every LMD.
  };
  std::array<Law, LAWS> laws;
  bool is_measured(std::size_t law) const { return !std::isnan(laws[law].largest.front()); }
  std::vector<Forces> forces;  ///< Of every frame.
};
/// @param refined  number of each law's largest steps that are divided
PathRow measure_path(const PathScene& scene, std::size_t refined, std::optional<LayeredChoice> layered);

/// Bisects jumps of the plain sum down to `shortest` of a frame; tells each law's change there.
struct EventRow {
  std::string scene;
  std::size_t events = 0;
  std::array<double, LAWS> largest{};  ///< Largest change of the force.
};
EventRow measure_events(const PathScene& scene, std::size_t most, double shortest,
                        std::optional<LayeredChoice> layered);

/// Work of closed loops of translation, in units of the largest force times the cutoff.
struct LoopRow {
  std::string scene;
  std::size_t loops = 0, steps = 0;
  std::array<double, LAWS> largest{}, mean{};
};
LoopRow measure_loops(const PathScene& scene, std::size_t loops, std::size_t steps, std::uint64_t seed,
                      std::optional<LayeredChoice> layered);

/// Largest change of the force when all triangles are cut in four, or vertices rounded to floats.
struct CutRow {
  std::string change;
  std::size_t poses = 0;
  std::array<double, LAWS> largest{};
};
std::vector<CutRow> measure_cuts(std::size_t poses, std::uint64_t seed);

/// RMS difference of the forces with decimated and fine meshes, over the RMS of the latter.
std::array<double, LAWS> measure_decimation(const PathScene& fine, const PathScene& coarse,
                                            std::optional<LayeredChoice> layered);

/// A sphere in a spherical cup: mean force over places, in units of that with a smooth cup.
struct CupRow {
  double cup_radius = 0.0;  ///< Over the sphere's radius.
  std::size_t triangles = 0;
  std::array<double, LAWS> mean{};
};
std::vector<CupRow> measure_cups(std::uint64_t seed);

/// The tip of a spindle in a notch.
struct NotchRow {
  double half_angle_degrees = 0.0;
  std::array<double, LAWS> outwards{};
};
std::vector<NotchRow> measure_notches();

/// A rod beside the axis of a bore: a conforming contact, whose force should not depend on facets.
struct BoreRow {
  int rod = 0, bore = 0;                         ///< Facets around each.
  std::array<double, LAWS> mean{}, deviation{};  ///< Of |force| over rolls and places, in F_max.
  std::array<double, LAWS> slope{};              ///< Steepest across the axis, in F_max a cutoff.
};
std::vector<BoreRow> measure_bores(std::size_t rolls, std::size_t slope_steps, const LayeredChoice& layered);

/// A device in a hand, pressed on a mesh and dragged along it, in a closed loop; means over spots.
struct DragRow {
  double stiffness_n_per_m = 0.0;  ///< Linear stiffness of one contact.
  std::size_t spots = 0;
  std::size_t through = 0;  ///< Spots without results, because the meshes touched under some law.
  std::array<double, LAWS> above_30_hz{}, largest_jump{};  ///< Over the mean force.
};
/// @param file  experiment with the scene, path, device and hand; the cutoff is its last profile's
std::vector<DragRow> measure_drag(const std::filesystem::path& file, std::size_t spots, std::uint64_t seed,
                                  bool layered);

/// Processor time of a pose [s].
struct CostRow {
  std::string scene, way;
  std::size_t poses = 0;
  double certified = 0.0, critical = 0.0, with_merges = 0.0;  ///< Medians.
};
std::vector<CostRow> measure_cost(const PathScene& scene, std::size_t poses, std::size_t repetitions);

}  // namespace lmdbench::continuous_force
