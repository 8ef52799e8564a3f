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

/// How a scene's mesh coordinates are made.
enum class Coordinates : std::uint8_t {
  EXACT,    ///< As the part is made: faces square to the axes are flat to the bit.
  TURNED,   ///< Each mesh is moved at random before it is stored in doubles.
  ROUNDED,  ///< TURNED, then rounded to floats and flattened like an import.
  RECUT     ///< EXACT in other triangles (recut.h).
};
inline constexpr Coordinates ALL_COORDINATES[] = {Coordinates::EXACT, Coordinates::TURNED,
                                                  Coordinates::ROUNDED, Coordinates::RECUT};
const char* name_of(Coordinates coordinates);

/// Which poses a scene has.
enum class PoseFamily : std::uint8_t {
  /// Tilts and yaws of 0 and 1e-13 to 1e-3, gaps from overlap to the cutoff, aligned borders.
  ANY,
  FLUSH  ///< No tilt, gaps above 0, translations by 2^-24: exact flat contact in EXACT and RECUT.
};

/// A part on or in another one.
struct PartsKind {
  const char* name;
  const char* moving;
  const char* fixed;
  bool nested = false;  ///< Into the fixed part, with CLEARANCE; else on it.
};

/// Sources of kinds.
enum class Generator : std::uint8_t {
  MACHINE_PARTS,  ///< Drawn parts (machine_parts.h); the last kind takes two by lot.
  CLEAR_SHAPES,   ///< Plates, boxes, holes, blocks; one clearly over another.
  RANDOM_SOLIDS,  ///< random_solids.h; any face on any face.
  FORMED_SHAPES   ///< formed_shapes.h, on each other, copies or mates.
};
std::span<const PartsKind> parts_kinds(Generator generator = Generator::MACHINE_PARTS);
/// Names on command lines of the generators with hard poses.
inline const std::map<std::string, Generator> HARD_GENERATORS = {{"parts", Generator::MACHINE_PARTS},
                                                                 {"solids", Generator::RANDOM_SOLIDS},
                                                                 {"shapes", Generator::FORMED_SHAPES}};
/// A kind of any generator.
/// @throws UsageError for an unknown name
const PartsKind& parts_kind(std::string_view name);

/// All that a scene depends on.
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
  std::vector<Pose> poses;  ///< World poses of the moving mesh.
};

/// Poses of one scene; half of the scenes have unrelated ones, half slow slides or turns.
inline constexpr std::size_t POSES_A_SCENE = 10;

/// One kind, seed and index have the same design and poses in all coordinates.
PartsScene make_parts_scene(const PartsChoice& choice);

/// Two meshes and relative poses, as designed.
struct PartsDesign {
  TriangleMesh moving, fixed;
  std::vector<Pose> poses;
};
PartsDesign make_parts_design(const PartsChoice& choice);

}  // namespace lmdbench::parts
