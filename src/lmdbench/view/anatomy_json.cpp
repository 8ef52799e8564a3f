// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/view/anatomy.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>

namespace lmdbench {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson vector_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

template <class Vectors>
OrderedJson vectors_json(const Vectors& vectors) {
  OrderedJson list = OrderedJson::array();
  for (const Vec3& v : vectors) list.push_back(vector_json(v));
  return list;
}

OrderedJson mesh_json(const Body& body) {
  const Surface& surface = body.surface();
  return {{"mesh", body.name()},
          {"vertices", vectors_json(surface.mesh.vertices)},
          {"triangles", surface.mesh.triangles},
          {"face_normals", vectors_json(surface.face_normals)}};
}

/// A node with the values that its tests use.
template <class Node>
OrderedJson node_json(const Node& node, const NodePatch& patch) {
  return {{"node", patch.node},
          {"centre", vector_json(node.centre)},
          {"radius", node.radius},
          {"cone_axis", vector_json(node.cone_axis)},
          {"cone_half_angle", std::atan2(node.cone_sine, node.cone_cosine)},
          {"triangles", patch.triangles}};
}

OrderedJson levels_json(const Hierarchy& hierarchy, const std::vector<int>& levels) {
  OrderedJson list = OrderedJson::array();
  for (const int level : levels) {
    OrderedJson nodes = OrderedJson::array();
    for (const NodePatch& patch : hierarchy_level(hierarchy, level))
      nodes.push_back(node_json(hierarchy.nodes[static_cast<std::size_t>(patch.node)], patch));
    list.push_back({{"level", level}, {"nodes", nodes}});
  }
  return list;
}

OrderedJson tests_json(const Scene& scene, const Pose& X_WM, int level) {
  const Hierarchy& moving = scene.moving->prepared<Hierarchy>();
  const Hierarchy& fixed = scene.fixed.front()->prepared<Hierarchy>();
  OrderedJson list = OrderedJson::array();
  for (const NodeTestCase& test : node_test_cases(scene, X_WM, level)) {
    const WorldNode world(moving.nodes[static_cast<std::size_t>(test.moving.node)], RigidTransform(X_WM));
    list.push_back({{"verdict", to_string(test.verdict)},
                    {"moving", node_json(world, test.moving)},
                    {"fixed", node_json(fixed.nodes[static_cast<std::size_t>(test.fixed.node)], test.fixed)},
                    {"centre_distance", test.centre_distance},
                    {"cone_angle", test.cone_angle},
                    {"sigma", test.sigma ? OrderedJson(*test.sigma) : OrderedJson()},
                    {"angle_moving", test.angle_moving},
                    {"angle_fixed", test.angle_fixed}});
  }
  return list;
}

OrderedJson shaded_json(const ShadedTriangle& triangle) {
  return {{"corners", vectors_json(triangle.corners)},
          {"vertex_normals", vectors_json(triangle.vertex_normals)},
          {"face_normal", vector_json(triangle.face_normal)}};
}

OrderedJson sight_json(const Sight& sight) {
  return {{"shadow", sight.shadow ? vectors_json(*sight.shadow) : OrderedJson()},
          {"overlaps", sight.overlaps}};
}

OrderedJson sights_json(const std::vector<SightCase>& cases) {
  OrderedJson list = OrderedJson::array();
  for (const SightCase& found : cases)
    list.push_back({{"sees", found.sees},
                    {"triangle_moving", found.triangle_moving},
                    {"triangle_fixed", found.triangle_fixed},
                    {"distance", found.distance},
                    {"moving", shaded_json(found.moving)},
                    {"fixed", shaded_json(found.fixed)},
                    {"moving_on_fixed", sight_json(found.moving_on_fixed)},
                    {"fixed_on_moving", sight_json(found.fixed_on_moving)}});
  return list;
}

}  // namespace

std::string anatomy_json(const Scene& scene, const Pose& X_WM, double time, const std::vector<int>& levels) {
  const std::vector<SightCase> sights = sight_cases(scene, X_WM);
  if (sights.empty())
    throw UsageError(
        "", "", "at this time of the path the node tests leave no pair of triangles within the cutoff",
        "give a --time at which the meshes are within the cutoff, or a larger cutoff; `lmdbench plan` "
        "says how near the path comes");
  OrderedJson around = OrderedJson::array();
  for (const Neighbourhood& found : neighbourhoods(scene.moving->surface(), sights.front().triangle_moving))
    around.push_back({{"kind", to_string(found.feature.kind)},
                      {"index", found.feature.index},
                      {"reading", found.reading},
                      {"triangles", found.triangles}});
  const Eigen::Quaterniond& q = X_WM.rotation;
  return json_line({{"time", time},
                    {"cutoff", scene.cutoff},
                    {"position", vector_json(X_WM.translation)},
                    {"orientation", {q.x(), q.y(), q.z(), q.w()}},
                    {"moving", mesh_json(*scene.moving)},
                    {"fixed", mesh_json(*scene.fixed.front())},
                    {"hierarchy", levels_json(scene.moving->prepared<Hierarchy>(), levels)},
                    {"node_tests", tests_json(scene, X_WM, levels.back())},
                    {"neighbourhoods", around},
                    {"visibility", sights_json(sights)}});
}

}  // namespace lmdbench
