// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench::parts {

/// How the coordinates of a scene's meshes come about.
enum class Coordinates : std::uint8_t {
  EXACT,    ///< As the part is made: faces square to the axes are flat to the bit.
  TURNED,   ///< Each mesh moved at random before it is stored; the coordinates are doubles.
  ROUNDED,  ///< The same, rounded to single precision and flattened as an import does it.
  RECUT     ///< EXACT in other triangles (recut.h).
};
inline constexpr Coordinates ALL_COORDINATES[] = {Coordinates::EXACT, Coordinates::TURNED,
                                                  Coordinates::ROUNDED, Coordinates::RECUT};
const char* name_of(Coordinates coordinates);

/// Which poses a scene has.
enum class PoseFamily : std::uint8_t {
  ANY,  ///< Tilts and yaws of 0 and 1e-13 to 1e-3, gaps from overlap over 0 and 1e-9 to the cutoff, borders aligned.
  FLUSH  ///< No tilt, a gap above 0, translations that are multiples of 2^-24: flat contact is exact in EXACT and RECUT.
};

/// A part on or in another one.
struct PartsKind {
  const char* name;
  const char* moving;
  const char* fixed;
  bool nested =
      false;  ///< The moving part goes into the fixed one, with CLEARANCE; else a side of it lies on a side.
};

/// Where kinds come from.
enum class Generator : std::uint8_t {
  MACHINE_PARTS,  ///< Parts that are drawn (machine_parts.h), on and in each other; the last kind draws both by lot.
  CLEAR_SHAPES,  ///< Plates, boxes, holes, blocks; a side of one lies clearly over a side of the other, nothing to rounding.
  RANDOM_SOLIDS,  ///< Solids that nobody drew (random_solids.h); any face of one lies on any face of the other.
  FORMED_SHAPES  ///< Turned, swept, slit, scanned shapes (formed_shapes.h) on each other, their copies and their mates.
};
std::span<const PartsKind> parts_kinds(Generator generator = Generator::MACHINE_PARTS);
/// Names on command lines, of those whose poses are hard.
inline const std::map<std::string, Generator> HARD_GENERATORS = {{"parts", Generator::MACHINE_PARTS},
                                                                 {"solids", Generator::RANDOM_SOLIDS},
                                                                 {"shapes", Generator::FORMED_SHAPES}};
/// Of any generator.
/// @throws UsageError for an unknown name
const PartsKind& parts_kind(std::string_view name);

/// What a scene depends on: nothing else does.
struct PartsChoice {
  std::string_view kind;
  Coordinates coordinates = Coordinates::EXACT;
  std::uint64_t seed = 1;
  std::size_t index = 0;
  PoseFamily poses = PoseFamily::ANY;
};

struct PartsScene {
  Scene scene;              ///< With its cutoff.
  double diagonal = 0.0;    ///< Of the fixed mesh [m].
  std::vector<Pose> poses;  ///< World pose of the moving mesh.
};

/// Poses of one scene: half of the scenes have unrelated ones, half slide or turn slowly.
inline constexpr std::size_t POSES_A_SCENE = 10;

/// The scene of a choice. All coordinates of one kind, seed and index are the same design in the same poses.
PartsScene make_parts_scene(const PartsChoice& choice);

/// Two meshes and poses of one relative to the other, as designed.
struct PartsDesign {
  TriangleMesh moving, fixed;
  std::vector<Pose> poses;
};
PartsDesign make_parts_design(const PartsChoice& choice);

}  // namespace lmdbench::parts
