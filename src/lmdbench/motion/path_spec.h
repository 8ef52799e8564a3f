// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/motion/majorant.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// A mesh of a path's scene: centred on its bounding box and scaled until the box's
/// diagonal has the given length.
struct PlacedMesh {
  std::string mesh;       ///< Name in the mesh manifest, or a mesh file.
  double diagonal = 0.0;  ///< metres
};

/// Wanted gap between the meshes at a time. From point to point the gap's logarithm makes a minimum-jerk step
/// (Flash and Hogan 1985: what a hand does), so that it falls and rises smoothly over several orders of
/// magnitude, rests at each point and never leaves the two values.
struct GapPoint {
  double time = 0.0;  ///< seconds
  double gap = 0.0;   ///< Fraction of the moving mesh's diagonal, > 0.
};

/// What a generated path shall be. JSON form, each key required unless a default is given:
/// {
///   "moving": { "mesh": "bunny-16k", "diagonal_m": 0.15 },
///   "fixed": { "mesh": "bunny-16k", "diagonal_m": 0.15 },
///   "frame_rate_hz": 1000,              gaps are computed and checked at this rate; default 1000
///   "stored_rate_hz": 250,              rate of the poses in the file, divides the frame rate;
///                                       default the frame rate
///   "seed": 1,
///   "start_direction": [1, 0, 0],       from the fixed mesh's centre to the moving one's; default [1, 0, 0]
///   "slide_rate_deg_per_s": 20,         root mean square, of that direction
///   "turn_rate_deg_per_s": 30,          root mean square, of the moving mesh about its centre
///   "radial_speed_m_per_s": 0.15,       limits of the motion towards and away from the fixed mesh
///   "radial_acceleration_m_per_s2": 2,
///   "gap_floor": 0.0002,                fraction of the diagonal that no haptic frame may fall below
///   "gaps": [                           at least two; times increase from 0, gaps are above the floor
///     { "time_s": 0, "gap": 0.1 }, { "time_s": 1.5, "gap": 0.001 }
///   ]
/// }
struct PathSpec {
  PlacedMesh moving;
  PlacedMesh fixed;
  double frame_rate = 1000.0;   ///< Hz
  double stored_rate = 1000.0;  ///< Hz
  std::uint64_t seed = 0;
  Vec3 start_direction = Vec3::UnitX();  ///< unit
  double slide_rate = 0.0;               ///< rad/s
  double turn_rate = 0.0;                ///< rad/s
  MotionLimits radial_limits;
  double gap_floor = 0.0;
  std::vector<GapPoint> gaps;

  double duration() const { return gaps.back().time; }  ///< seconds
};

/// Reads a specification.
/// @throws UsageError naming the file, the JSON pointer and the remedy: not JSON, unknown or missing
///         key, wrong type, value out of range; InputError when the file cannot be read
PathSpec read_path_spec(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
PathSpec parse_path_spec(const std::string& text, const std::string& name);

}  // namespace lmdbench
