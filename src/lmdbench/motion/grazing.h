// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/motion/generate.h>
#include <lmdbench/motion/path_spec.h>

#include <array>
#include <cstdint>
#include <functional>

/// The path of a scene that has none: the moving mesh comes in, slides and turns well within the cutoff, and
/// leaves again. `lmdbench init` writes its specification for editing.
namespace lmdbench {

/// The gaps, in cutoffs: out of contact at both ends, three quarters of the time in contact, down to a
/// twentieth of the cutoff.
inline constexpr std::array<GapPoint, 5> GRAZING_GAPS_IN_CUTOFFS{
    {{0.0, 1.5}, {0.4, 0.5}, {1.0, 0.05}, {1.5, 0.25}, {2.0, 1.5}}};

/// No frame may come nearer than this part of the cutoff.
inline constexpr double GRAZING_FLOOR_IN_CUTOFFS = 0.02;

/// Gaps are computed at this rate first; where the interpolated frames fall below the floor at every frame.
inline constexpr double GRAZING_RATE = 250.0;  ///< Hz

/// Seeds that are tried, in ascending order from 1, until a path grazes.
inline constexpr std::uint64_t GRAZING_SEEDS = 8;

/// The specification for a scene; its meshes are left to the caller.
/// @param cutoff     metres, > 0
PathSpec grazing_spec(const PathScene& scene, double cutoff);

struct GrazingPath {
  PathSpec spec;  ///< With the seed and the rate that were used: `generate_path` makes the path again.
  Path path;      ///< At the rate of the specification.
  double smallest_gap = 0.0;  ///< Over the haptic frames [m].
};

/// A path every haptic frame of which keeps the floor, and that comes within half the cutoff.
/// @param haptic_rate frames a second that the path will be interpolated to [Hz]
/// @throws InputError where no seed gives one: the meshes cannot be brought together from outside
GrazingPath grazing_path(const PathScene& scene, double cutoff, double haptic_rate,
                         const ProgressFunction& progress = {});

// Among paths that graze, one that shows what this program is about: several contacts at once.

/// Paths that are looked at, in the order of their seeds.
inline constexpr std::uint64_t RICH_SEEDS = 4;
/// Contacts that are enough.
inline constexpr double RICH_CONTACTS = 2.0;

/// The first path of `grazing_path`'s seeds that has RICH_CONTACTS; of RICH_SEEDS that have fewer the one with the most.
/// @param contacts  how many a path has, by the caller's measure; called once a path that grazes
/// @param progress  over all RICH_SEEDS, never going back; it ends early where fewer are enough
/// @throws InputError as `grazing_path`
GrazingPath rich_grazing_path(const PathScene& scene, double cutoff, double haptic_rate,
                              const std::function<double(const Path&)>& contacts,
                              const ProgressFunction& progress = {});

}  // namespace lmdbench
