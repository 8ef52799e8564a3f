// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/prepare/mover_play.h>
#include <lmdbench/prepare/scene_deformation.h>
#include <lmdbench/shape/flatten.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// The mesh of an object, with facts for readers of a result.
struct MeshNote {
  std::string role;                           ///< Of the object, ...
  std::string object;                         ///< ... its name, ...
  MotionKind motion = MotionKind::STANDS;     ///< ... and how it moves.
  std::string name;                           ///< Of the mesh.
  std::optional<std::filesystem::path> file;  ///< File read; unset for a generated shape.
  std::int64_t size = 0;                      ///< Bytes of that file
  std::string sha256;                         ///< Of that file, or of a generated shape's file.
  ValidityReport report;
  FlatteningReport flattening;  ///< In metres of the scene.
  OrientationReport orientation;
  std::shared_ptr<const FrameVertices> vertices;  ///< Of a deforming mesh, frame by frame.
  std::shared_ptr<const Body> body;               ///< At rest.
  std::vector<Pose> instances;                    ///< X_WF of each; empty: in the world frame.
  std::int64_t first_fixed_body = 0;              ///< `Lmd::fixed_body` of a standing one's first.
  std::int64_t first_mover = 0;                   ///< Number of a moving one's first mover; ...
  std::int64_t movers = 0;                        ///< ... how many; 0: held or standing.
};

/// The objects of an experiment, loaded. Equal meshes are read and prepared once.
struct LoadedScene {
  /// The held and the standing objects, without a cutoff; MoverPlay adds the moving ones.
  Scene scene;
  std::vector<MeshNote> notes;  ///< One an object.
  std::vector<Mover> movers;    ///< In file order, the held one first; empty where only that moves.

  /// Standing and moving objects as one scene, for callers that need sizes alone.
  Scene all_meshes() const;
};

/// @throws InputError naming the object with an unusable mesh
/// @throws UsageError for so many movers that their pairs have no number
LoadedScene load_scene(const Experiment& experiment);

/// How the bodies of a loaded scene deform over the frames; null if none does.
std::shared_ptr<const SceneDeformation> deformation_of(const std::vector<MeshNote>& notes,
                                                       std::int64_t frames);

/// A fixed mesh with its vertices in the world frame.
TriangleMesh placed_mesh(const FixedBody& fixed);

}  // namespace lmdbench
