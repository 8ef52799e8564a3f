// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/mesh_limits.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/lmdbench.h>
#include <lmdbench/mesh/placement.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/methods/query.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/shape/flatten.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

std::shared_ptr<const Body> prepare(TriangleMesh mesh, const std::string& planar_tolerance,
                                    const std::string& name, std::string& repairs) {
  const PlanarTolerance tolerance = parse_planar_tolerance(planar_tolerance, name, "planar_tolerance");
  repairs = repairs_text(flatten(mesh, tolerance));
  return std::make_shared<const Body>(name, build_surface(std::move(mesh)));
}

/// Vertices without triangles are not on the surface and must not count for its size, digits and
/// tolerance (import.h); they keep their numbers, so they are put onto one that is.
void hide_unused_vertices(TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size());
  for (const auto& corners : mesh.triangles)
    for (const std::int32_t corner : corners) used[static_cast<std::size_t>(corner)] = true;
  const Vec3 place = mesh.triangle(0).front();
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v]) mesh.vertices[v] = place;
}

/// The checks that reading a file makes, of all but unused vertices.
void check_mesh_in_memory(TriangleMesh& mesh, const std::string& name) {
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  if (mesh.triangles.empty())
    throw InputError(name, "", "holds no triangle", "give at least one row of three vertex numbers");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::int32_t corner : mesh.triangles[t]) {
      if (corner < 0 || corner >= count)
        throw InputError(name, fmt::format("triangle {}", t),
                         fmt::format("names vertex {} of {}", corner, count),
                         "vertices count from 0 in the order of the array");
      if (!mesh.vertices[static_cast<std::size_t>(corner)].allFinite())
        throw InputError(name, fmt::format("vertex {}", corner), "has a coordinate that is not finite",
                         "repair the mesh or leave the vertex out");
    }
  if (!(mesh.planar_tolerance >= 0.0 && mesh.planar_tolerance <= LARGEST_COORDINATE))
    throw InputError(name, "planar_tolerance", fmt::format("{} is no length", mesh.planar_tolerance),
                     "give 0, or metres");
  hide_unused_vertices(mesh);
  refuse_extreme_size(mesh, name);
  check_mesh_limits(mesh, name);
}

/// @return the pose, its quaternion brought to unit length where it is off by more than rounding
Pose rigid(Pose pose, const std::string& place) {
  const double length = pose.rotation.norm();
  const bool is_rigid = pose.translation.allFinite() &&
                        pose.translation.cwiseAbs().maxCoeff() <= LARGEST_COORDINATE &&
                        std::abs(length - 1.0) <= QUATERNION_LENGTH_TOLERANCE;  // false for NaN
  if (!is_rigid)
    throw UsageError(
        "", place, "is no rigid transform of finite size",
        fmt::format("give a unit quaternion and a translation up to {:g} m", LARGEST_COORDINATE));
  normalize_beyond_rounding(pose.rotation);
  return pose;
}

Scene scene_of(const PreparedMesh& moving, const std::vector<PreparedMesh>& fixed, double cutoff) {
  if (!(cutoff > 0.0 && cutoff <= LARGEST_COORDINATE))
    throw UsageError("", "cutoff",
                     fmt::format("{} is not a distance above 0 and at most {:g}", cutoff, LARGEST_COORDINATE),
                     "give metres, for example 0.005");
  if (fixed.empty()) throw UsageError("", "fixed", "names no mesh", "give at least one");
  Scene scene{moving.body(), {}, cutoff};
  for (const PreparedMesh& mesh : fixed) scene.fixed.push_back(mesh.body());
  return scene;
}

nlohmann::json options_of(const std::string& method, const std::string& text) {
  const MethodDescription& description = method_description(method);  // reports a misspelt name
  nlohmann::json options = parse_json(text, "options");
  if (!options.is_object())
    throw UsageError("", "options", fmt::format("'{}' is no JSON object", text),
                     R"(give one, for example {"visibility": "off"})");
  return complete_options(description, std::move(options), "options");
}

}  // namespace

PreparedMesh::PreparedMesh(const std::filesystem::path& file, const std::string& planar_tolerance)
    : body_(prepare(import_mesh(file), planar_tolerance, file.string(), repairs_)) {}

PreparedMesh::PreparedMesh(TriangleMesh mesh, const std::string& planar_tolerance, const std::string& name) {
  check_mesh_in_memory(mesh, name);
  body_ = prepare(std::move(mesh), planar_tolerance, name, repairs_);
}

const TriangleMesh& PreparedMesh::mesh() const {
  return body_->surface().mesh;
}

std::vector<std::array<std::int32_t, 2>> PreparedMesh::edges() const {
  return body_->surface().adjacency.edges;
}

std::vector<std::string> PreparedMesh::findings() const {
  std::vector<std::string> all = lmdbench::findings(check_mesh(body_->surface()));
  if (!repairs_.empty()) all.push_back(repairs_);
  return all;
}

struct LmdSearch::State {
  Scene scene;
  std::unique_ptr<Method> method;
};

LmdSearch::LmdSearch(const PreparedMesh& moving, const std::vector<PreparedMesh>& fixed, double cutoff,
                     const std::string& method, const std::string& options)
    : LmdSearch(moving, fixed, std::vector<Pose>(fixed.size()), cutoff, method, options) {}

LmdSearch::LmdSearch(const PreparedMesh& moving, const std::vector<PreparedMesh>& fixed,
                     const std::vector<Pose>& X_WF, double cutoff, const std::string& method,
                     const std::string& options) {
  const nlohmann::json chosen = options_of(method, options);
  Scene scene = scene_of(moving, fixed, cutoff);
  if (X_WF.size() != fixed.size())
    throw UsageError("", "X_WF", fmt::format("{} poses of {} fixed meshes", X_WF.size(), fixed.size()),
                     "give one a mesh");
  for (std::size_t i = 0; i < X_WF.size(); ++i) {
    scene.fixed[i].X_WF = rigid(X_WF[i], fmt::format("X_WF {}", i));
  }
  std::unique_ptr<Method> made = make_method(method, scene, chosen);
  state_ = std::make_unique<State>(State{std::move(scene), std::move(made)});
}

LmdSearch::LmdSearch(const PreparedMesh& moving, const PreparedMesh& fixed, double cutoff,
                     const std::string& method, const std::string& options)
    : LmdSearch(moving, std::vector<PreparedMesh>{fixed}, cutoff, method, options) {}

LmdSearch::~LmdSearch() = default;
LmdSearch::LmdSearch(LmdSearch&&) noexcept = default;
LmdSearch& LmdSearch::operator=(LmdSearch&&) noexcept = default;

LmdSet LmdSearch::at(const Pose& X_WM) {
  return query(*state_->method, rigid(X_WM, "pose"), state_->scene.cutoff).lmds;
}

double LmdSearch::cutoff() const {
  return state_->scene.cutoff;
}

std::string library_version() {
  return build_info().version;
}

}  // namespace lmdbench
