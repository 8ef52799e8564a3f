// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/prepare/load_body.h>

#include <utility>

namespace lmdbench {

std::shared_ptr<const Body> load_body(const MeshChoice& choice, const std::string& role,
                                      const Experiment& experiment, const std::optional<Pose>& X_WF,
                                      std::vector<MeshNote>& notes) {
  const ResolvedMesh resolved =
      is_mesh_name(choice.mesh)
          ? resolve_mesh(choice.mesh, experiment.mesh_folder)
          : resolve_mesh((experiment.file.parent_path() / choice.mesh).lexically_normal().string());
  TriangleMesh mesh = resolved.mesh;  // `resolved` keeps what vertex files are held against
  // In the file's coordinates, which tell how they were rounded; scaling hides that.
  const double scale = choice.placement.factor(mesh);
  PlanarTolerance tolerance = choice.planar_tolerance;
  if (tolerance.kind == PlanarTolerance::Kind::LENGTH) tolerance.value /= scale;
  OrientationReport orientation;
  if (choice.orientation == OrientationChoice::OUTWARD) orientation = orient_outward(mesh);
  FlatteningReport flattening = flatten(mesh, tolerance);
  flattening.tolerance *= scale;
  flattening.largest_move *= scale;
  mesh = placed(std::move(mesh), choice.placement);
  std::shared_ptr<const FrameVertices> vertices;
  if (choice.deformation)
    vertices = std::make_shared<const FrameVertices>(
        *choice.deformation, DeformingMesh{resolved.mesh, choice.placement, mesh, X_WF},
        experiment.frame_rate_hz);
  if (X_WF)
    for (Vec3& vertex : mesh.vertices) vertex = RigidTransform(*X_WF).point(vertex);
  refuse_extreme_size(mesh, choice.mesh);
  auto body = std::make_shared<const Body>(choice.mesh, build_surface(std::move(mesh)));
  notes.push_back({role,
                   choice.mesh,
                   resolved.file,
                   resolved.size,
                   resolved.sha256,
                   check_mesh(body->surface()),
                   flattening,
                   orientation,
                   {},
                   0,
                   std::move(vertices)});
  notes.back().body = body;
  return body;
}

TriangleMesh placed_mesh(const FixedBody& fixed) {
  TriangleMesh mesh = fixed->surface().mesh;
  if (!fixed.is_placed()) return mesh;
  const RigidTransform X_WF(fixed.X_WF);
  for (Vec3& vertex : mesh.vertices) vertex = X_WF.point(vertex);
  return mesh;
}

}  // namespace lmdbench
