// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/continuous_force/rendering.h>

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

/// Steps of the force along a path, in units of one LMD's largest force.
struct PathRow {
  std::string scene;
  std::size_t frames = 0, in_contact = 0, separated = 0;
  double minima = 0.0, pairs = 0.0, merges = 0.0;  ///< Mean a pose in contact.
  struct Law {
    std::vector<double>
        largest;  ///< At the frames, and with the worst steps divided by 10, 100, 1000, 10000.
    std::size_t above_quarter = 0;  ///< Steps of more than 0.25.
    double separated_difference = 0.0, rms_from_sum = 0.0;
    std::size_t outside_cone = 0;  ///< Forces that are no sum of pushes along LMDs.
    std::size_t against_all = 0;   ///< Forces that pull against every LMD.
  };
  std::array<Law, LAWS> laws;
  std::vector<Forces> forces;  ///< Of every frame.
};
/// @param refined  steps that are divided, the largest of each law
PathRow measure_path(const PathScene& scene, std::size_t refined);

/// Bisects steps of the plain sum in which it jumps, down to `shortest` of a frame, and tells the force's change over what is left.
struct EventRow {
  std::string scene;
  std::size_t events = 0;
  Forces largest;  ///< x: largest change of each law; y, z unused.
};
EventRow measure_events(const PathScene& scene, std::size_t most, double shortest);

/// Work of closed loops of translation, in units of the largest force times the cutoff.
struct LoopRow {
  std::string scene;
  std::size_t loops = 0, steps = 0;
  std::array<double, LAWS> largest{}, mean{};
};
LoopRow measure_loops(const PathScene& scene, std::size_t loops, std::size_t steps, std::uint64_t seed);

/// Largest change of the force where each triangle of both meshes is cut in four, and where vertices are rounded to single precision.
struct CutRow {
  std::string change;
  std::size_t poses = 0;
  std::array<double, LAWS> largest{};
};
std::vector<CutRow> measure_cuts(std::size_t poses, std::uint64_t seed);

/// RMS difference of the force with decimated meshes, over that of the finer ones.
std::array<double, LAWS> measure_decimation(const PathScene& fine, const PathScene& coarse);

/// A sphere in a spherical cup, mean force over places in units of the force of a smooth one.
struct CupRow {
  double cup_radius = 0.0;  ///< Of the cup, over the sphere's.
  std::size_t triangles = 0;
  std::array<double, LAWS> mean{};
};
std::vector<CupRow> measure_cups(std::uint64_t seed);

/// A tip in a notch.
struct NotchRow {
  double half_angle_degrees = 0.0;
  std::array<double, LAWS> outwards{};
};
std::vector<NotchRow> measure_notches();

/// Processor time a pose [s].
struct CostRow {
  std::string scene, way;
  std::size_t poses = 0;
  double certified = 0.0, critical = 0.0, with_merges = 0.0;  ///< Medians.
};
std::vector<CostRow> measure_cost(const PathScene& scene, std::size_t poses, std::size_t repetitions);

}  // namespace lmdbench::continuous_force
