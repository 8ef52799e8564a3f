// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/motion/generate.h>
#include <lmdbench/motion/path_spec.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>

/// The path of a scene that has none: the moving mesh comes in, slides and turns well within the
/// cutoff, and leaves again. `lmdbench init` writes its specification for editing.
namespace lmdbench {

/// The gaps in cutoffs: out of contact at both ends, in contact for three quarters of the time,
/// down to a twentieth of the cutoff.
inline constexpr std::array<GapPoint, 5> GRAZING_GAPS_IN_CUTOFFS{
    {{0.0, 1.5}, {0.4, 0.5}, {1.0, 0.05}, {1.5, 0.25}, {2.0, 1.5}}};

/// No frame may come nearer than this part of the cutoff.
inline constexpr double GRAZING_FLOOR_IN_CUTOFFS = 0.02;

/// First rate at which gaps are computed; if interpolated frames fall below the floor, all.
inline constexpr double GRAZING_RATE = 250.0;  ///< Hz

/// Seeds that are tried, in ascending order from 1, until a path grazes.
inline constexpr std::uint64_t GRAZING_SEEDS = 8;

/// The specification for a scene; its meshes are left to the caller.
/// @param cutoff     metres, > 0
PathSpec grazing_spec(const PathScene& scene, double cutoff);

struct GrazingPath {
  PathSpec spec;              ///< With its seed and rate: `generate_path` repeats the path.
  Path path;                  ///< At the rate of the specification.
  double smallest_gap = 0.0;  ///< Over the haptic frames [m].
};

/// A path whose haptic frames all keep the floor, and which comes within half the cutoff.
/// @param haptic_rate frames a second that the path will be interpolated to [Hz]
/// @throws InputError where no seed gives one: the meshes cannot be brought together from outside
GrazingPath grazing_path(const PathScene& scene, double cutoff, double haptic_rate,
                         const ProgressFunction& progress = {});

// Among the paths that graze: one with several contacts at once.

/// How many paths are compared, in the order of their seeds.
inline constexpr std::uint64_t RICH_SEEDS = 4;
/// With so many contacts a path is taken at once.
inline constexpr double RICH_CONTACTS = 2.0;

/// The first grazing path with RICH_CONTACTS; if none, the one with the most of RICH_SEEDS.
/// @param contacts  counts a path's contacts; called once for every path that grazes
/// @param progress  over all GRAZING_SEEDS, never going back; it ends early where fewer are enough
/// @param file      that wants it, for messages
/// @throws InputError as `grazing_path`
GrazingPath rich_grazing_path(const PathScene& scene, double cutoff, double haptic_rate,
                              const std::function<double(const Path&)>& contacts,
                              const ProgressFunction& progress = {}, const std::string& file = "");

}  // namespace lmdbench
