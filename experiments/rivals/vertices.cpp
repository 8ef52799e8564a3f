// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Each vertex to the other surface, both ways, as in cloth and many engines. Our decisions: the
// partner is the nearest point within the cutoff, on any side; vertices with one partner count
// each; edge-edge is missed. Candidates by Embree's point queries (float, with margin).
#include "near_pairs.h"
#include "plugin.hpp"

#include <memory>

namespace {

using namespace rivals;

/// A mesh that can be queried for its nearest point.
class Tree {
 public:
  explicit Tree(const Mesh& mesh) : mesh_(mesh), margin_(1e-6 * mesh.diagonal) {
    scene_ = rtcNewScene(device_.device);
    RTCGeometry geometry = rtcNewGeometry(device_.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) vertices[3 * i + k] = static_cast<float>(mesh.vertices[i][k]);
    auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) triangles[3 * i + k] = static_cast<unsigned>(mesh.triangles[i][k]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
  ~Tree() { rtcReleaseScene(scene_); }

  struct Nearest {
    double distance;
    Point point{};
    std::int32_t triangle = -1;
  };
  Nearest nearest(const Point& p, double cutoff) const {
    Ask ask{*this, p, {cutoff, {}, -1}};
    RTCPointQuery query{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), 0.0F,
                        radius(cutoff)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &query, &context, &Tree::look, &ask);
    return ask.best;
  }

 private:
  struct Ask {
    const Tree& tree;
    const Point& p;
    Nearest best;
  };
  float radius(double distance) const { return static_cast<float>(1.000001 * distance + margin_); }

  static bool look(RTCPointQueryFunctionArguments* arguments) {
    auto& ask = *static_cast<Ask*>(arguments->userPtr);
    const std::size_t t = arguments->primID;
    const Mesh& mesh = ask.tree.mesh_;
    const Point q = closest_on_triangle(ask.p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
    const double d = distance(ask.p, q);
    // Of triangles that share the nearest point the first one, whatever the order of visits.
    const bool nearer = d < ask.best.distance ||
                        (d == ask.best.distance &&
                         (ask.best.triangle < 0 || static_cast<std::int32_t>(t) < ask.best.triangle));
    if (!nearer) return false;
    ask.best = {d, q, static_cast<std::int32_t>(t)};
    arguments->query->radius = ask.tree.radius(d);
    return true;
  }

  const Mesh& mesh_;
  double margin_;
  Device device_;
  RTCScene scene_ = nullptr;
};

class Vertices {
 public:
  Vertices(const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff, const std::string& /*options*/)
      : kept_(std::make_unique<Kept>(a, b)), cutoff_(cutoff) {}

  void search(const double* X_BA, std::vector<lmdbench_contact>& contacts) {
    const Transform X{X_BA};
    const auto& [a, b, tree_a, tree_b] = *kept_;
    std::vector<Found> all;
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
      if (a.triangle_of[v] < 0) continue;
      const Point p = X(a.vertices[v]);
      const Tree::Nearest on_b = tree_b.nearest(p, cutoff_);
      if (on_b.triangle >= 0)
        all.push_back(
            found(p, on_b.point, a.triangle_of[v], a.corner_of[v], on_b.triangle, LMDBENCH_PART_UNKNOWN));
    }
    for (std::size_t v = 0; v < b.vertices.size(); ++v) {
      if (b.triangle_of[v] < 0) continue;
      const Tree::Nearest on_a = tree_a.nearest(X.inverse(b.vertices[v]), cutoff_);
      if (on_a.triangle >= 0)
        all.push_back(found(X(on_a.point), b.vertices[v], on_a.triangle, LMDBENCH_PART_UNKNOWN,
                            b.triangle_of[v], b.corner_of[v]));
    }
    hand_over(all, contacts);
  }

 private:
  struct Kept {
    Mesh a, b;
    Tree tree_a{a}, tree_b{b};
    Kept(const lmdbench_mesh& of_a, const lmdbench_mesh& of_b) : a(of_a), b(of_b) {}
  };
  std::unique_ptr<Kept> kept_;
  double cutoff_;
};

constexpr lmdbench_method METHOD = plugin::Functions<Vertices>::described(
    "vertices", "1", "each vertex within the cutoff with the nearest point of the other surface, both ways",
    LMDBENCH_PROMISE_APPROXIMATION);

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = plugin::entry_of<METHOD>();
