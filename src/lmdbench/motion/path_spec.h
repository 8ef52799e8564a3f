// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/motion/majorant.h>

#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

inline constexpr double DEGREE = std::numbers::pi / 180.0;  ///< radians

/// A mesh of a path's scene, placed as experiments place theirs.
struct PlacedMesh {
  std::string mesh;  ///< Name in the mesh manifest, or a mesh file.
  Placement placement;
};

/// Wanted gap between the meshes at a time. From point to point the gap's logarithm makes a
/// minimum-jerk step (Flash and Hogan 1985: what a hand does), so it changes smoothly over several
/// orders of magnitude, rests at each point and never leaves the two values.
struct GapPoint {
  double time = 0.0;  ///< seconds
  double gap = 0.0;   ///< Fraction of the moving mesh's diagonal, > 0.
};

/// Default limits of the radial motion, in diagonals of the moving mesh: those of the recorded
/// paths, where 0.15 m move with 0.15 m/s and 3 m/s^2.
inline constexpr double DEFAULT_RADIAL_SPEED = 1.0;          ///< 1/s
inline constexpr double DEFAULT_RADIAL_ACCELERATION = 20.0;  ///< 1/s^2

/// What a generated path shall be. The keys of its JSON form, their meanings and defaults are in
/// experiments/schema/path.schema.json; the smallest file names two meshes:
/// { "moving": { "mesh": "peg.stl" }, "fixed": { "mesh": "hole.stl" } }
struct PathSpec {
  PlacedMesh moving;
  PlacedMesh fixed;
  double frame_rate = 1000.0;   ///< Hz
  double stored_rate = 1000.0;  ///< Hz
  std::uint64_t seed = 0;
  Vec3 start_direction = Vec3::UnitX();       ///< unit
  double slide_rate = 0.0;                    ///< rad/s
  double turn_rate = 0.0;                     ///< rad/s
  std::optional<double> radial_speed;         ///< m/s
  std::optional<double> radial_acceleration;  ///< m/s^2
  double gap_floor = 0.0;
  std::vector<GapPoint> gaps;

  double duration() const { return gaps.back().time; }  ///< seconds
  /// @param moving_diagonal metres
  MotionLimits radial_limits(double moving_diagonal) const;
};

/// Reads a specification.
/// @throws UsageError naming the file, the JSON pointer and the remedy: not JSON, unknown or
///         missing key, wrong type, value out of range; InputError when the file cannot be read
PathSpec read_path_spec(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
PathSpec parse_path_spec(const std::string& text, const std::string& name);

/// JSON text of a specification, which reads back to it (angles to twelve digits).
std::string path_spec_text(const PathSpec& spec);

}  // namespace lmdbench
