// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/feature.h>
#include <lmdbench/methods/improved/visibility.h>
#include <lmdbench/snch/hierarchy.h>
#include <lmdbench/snch/node_tests.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Intermediate results of the paper's two algorithms at one pose of a real scene: levels of the
/// hierarchy, node tests, neighbourhoods of local tracking, the visibility pre-test. For figures
/// and for curious people; every verdict is that of the methods' own code.
namespace lmdbench {

/// A node with the triangles below it.
struct NodePatch {
  std::int32_t node = 0;  ///< Index in `Hierarchy::nodes`.
  std::vector<std::int32_t> triangles;
};

/// Nodes at this depth (root: 0) and the leaves above it: together they hold every triangle once.
std::vector<NodePatch> hierarchy_level(const Hierarchy& hierarchy, int level);

/// The first test that rejects a node pair, in the order of the traversal.
enum class NodeVerdict : std::uint8_t { REJECTED_G1, REJECTED_G2, REJECTED_G3, ACCEPTED };
std::string_view to_string(NodeVerdict verdict);

/// G1, G2 and G3.a/b on one pair (paper, Fig. 4).
NodeVerdict node_verdict(const WorldNode& moving, const HierarchyNode& fixed, double cutoff);

/// A node pair with its verdict and the numbers that the tests compare; angles in radians.
struct NodeTestCase {
  NodeVerdict verdict = NodeVerdict::ACCEPTED;
  NodePatch moving, fixed;
  double centre_distance = 0.0;  ///< |S_B - S_A| [m]
  double cone_angle = 0.0;       ///< pi - angle(C_A, C_B): G2 rejects above phi_A + phi_B.
  std::optional<double> sigma;   ///< Unset where the spheres overlap.
  double angle_moving = 0.0;     ///< angle(S_B - S_A, C_A): G3.a rejects above sigma + phi_A.
  double angle_fixed = 0.0;      ///< angle(S_A - S_B, C_B): G3.b rejects above sigma + phi_B.
};

/// Of one level's node pairs without overlap of the spheres, the nearest by centres for each
/// verdict that occurs.
std::vector<NodeTestCase> node_test_cases(const Scene& scene, const Pose& X_WM, int level);

/// Neighbourhood T of a feature (L1; Fig. 5).
struct Neighbourhood {
  FeatureId feature;
  std::string reading;  ///< "incident", or "edge neighbours": the wider reading of Fig. 5 (a).
  std::vector<std::int32_t> triangles;
};

/// Of the triangle itself (both readings), its first side and its first corner.
std::vector<Neighbourhood> neighbourhoods(const Surface& surface, std::int32_t triangle);

/// A leaf pair and its result of the visibility pre-test (Fig. 6); world coordinates.
struct SightCase {
  bool sees = false;
  std::int32_t triangle_moving = -1, triangle_fixed = -1;
  double distance = 0.0;  ///< Exact distance of the triangles [m].
  ShadedTriangle moving, fixed;
  Sight moving_on_fixed, fixed_on_moving;
};

/// The nearest seen and the nearest culled leaf pair, if any, of the improved algorithm's search
/// within the cutoff, with the first fixed body.
std::vector<SightCase> sight_cases(const Scene& scene, const Pose& X_WM);

/// All of it as JSON: the moving mesh in its own frame, the rest in the world's; lengths in metres,
/// angles in radians (keys as the members above).
/// @param levels of the moving mesh's hierarchy; the last is tested against the fixed mesh
/// @throws UsageError where the meshes are too far apart for a leaf pair
std::string anatomy_json(const Scene& scene, const Pose& X_WM, double time, const std::vector<int>& levels);

}  // namespace lmdbench
