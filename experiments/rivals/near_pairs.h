// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closest.h"
#include <embree3/rtcore.h>

#include <stdexcept>
#include <utility>

/// First step of `barrier`, `gcp` and `proxy`: pairs of features whose boxes are within the cutoff.
namespace rivals {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

inline Pairs& once(Pairs& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Edges of a mesh, each with a triangle and its number there, and the neighbours of features.
struct Edges {
  struct Edge {
    std::int32_t from, to, triangle, part;
    std::vector<std::int32_t> triangles;
  };
  std::vector<Edge> all;
  std::vector<std::array<std::int32_t, 3>> of_triangle;
  std::vector<std::vector<std::int32_t>> of_vertex, triangles_of_vertex;

  explicit Edges(const Mesh& mesh)
      : of_triangle(mesh.triangles.size()),
        of_vertex(mesh.vertices.size()),
        triangles_of_vertex(mesh.vertices.size()) {
    std::vector<std::array<std::int32_t, 4>> sides;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::int32_t k = 0; k < 3; ++k) {
        const auto u = mesh.triangles[t][static_cast<std::size_t>(k)],
                   v = mesh.triangles[t][static_cast<std::size_t>((k + 1) % 3)];
        sides.push_back({std::min(u, v), std::max(u, v), static_cast<std::int32_t>(t), k});
        triangles_of_vertex[static_cast<std::size_t>(u)].push_back(static_cast<std::int32_t>(t));
      }
    std::sort(sides.begin(), sides.end());
    for (const auto& [u, v, t, k] : sides) {
      if (all.empty() || all.back().from != u || all.back().to != v) {
        for (const std::int32_t end : {u, v})
          of_vertex[static_cast<std::size_t>(end)].push_back(static_cast<std::int32_t>(all.size()));
        all.push_back({u, v, t, LMDBENCH_EDGE_0 + k, {}});
      }
      all.back().triangles.push_back(t);
      of_triangle[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)] =
          static_cast<std::int32_t>(all.size() - 1);
    }
  }

  double mean_length(const Mesh& mesh) const {
    double sum = 0.0;
    for (const Edge& edge : all)
      sum += distance(mesh.vertices[static_cast<std::size_t>(edge.from)],
                      mesh.vertices[static_cast<std::size_t>(edge.to)]);
    return sum / static_cast<double>(all.size());
  }
};

/// Boxes of triangles, grown by a margin, in a tree of Embree's.
class Boxes {
 public:
  Boxes(RTCDevice device, const Mesh& mesh, const std::vector<Point>& vertices, double margin)
      : mesh_(mesh), vertices_(vertices), margin_(margin), scene_(rtcNewScene(device)) {
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    geometry_ = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(mesh.triangles.size()));
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(geometry_, &Boxes::bounds, nullptr);
    rtcAttachGeometry(scene_, geometry_);
    rtcReleaseGeometry(geometry_);
    update();
  }
  Boxes(const Boxes&) = delete;
  Boxes& operator=(const Boxes&) = delete;
  ~Boxes() { rtcReleaseScene(scene_); }
  void update() {
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }
  RTCScene scene() const { return scene_; }

 private:
  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const Boxes*>(arguments->geometryUserPtr);
    float* low = &arguments->bounds_o->lower_x;
    float* high = &arguments->bounds_o->upper_x;
    for (std::size_t k = 0; k < 3; ++k) {
      double least = 0.0, most = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double x =
            self.vertices_[static_cast<std::size_t>(self.mesh_.triangles[arguments->primID][c])][k];
        least = c == 0 ? x : std::min(least, x);
        most = c == 0 ? x : std::max(most, x);
      }
      low[k] = std::nextafter(static_cast<float>(least - self.margin_), -INFINITY);
      high[k] = std::nextafter(static_cast<float>(most + self.margin_), INFINITY);
    }
  }

  const Mesh& mesh_;
  const std::vector<Point>& vertices_;
  double margin_;
  RTCScene scene_;
  RTCGeometry geometry_ = nullptr;
};

struct Device {
  RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  Device() {
    if (device == nullptr) throw std::runtime_error("Embree cannot be started");
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  ~Device() { rtcReleaseDevice(device); }
};

/// Two meshes at a pose and their near pairs of features, each once, in the order of their numbers.
/// The broad phase (rtcCollide) is rebuilt for each pose from boxes inflated by the cutoff.
class NearPairs {
 public:
  Mesh a, b;
  Edges edges_a{a}, edges_b{b};
  std::vector<Point> placed;  ///< Vertices of A in B's frame.
  Pairs corner_face, face_corner, edge_edge;
  Pairs corner_edge, edge_corner, corner_corner;  ///< Of `find` with all kinds.

  NearPairs(const lmdbench_mesh& of_a, const lmdbench_mesh& of_b, double cutoff)
      : a(of_a),
        b(of_b),
        placed(a.vertices),
        boxes_a_(device_.device, a, placed, cutoff + 1e-6 * (a.diagonal + b.diagonal)),
        boxes_b_(device_.device, b, b.vertices, 0.0) {}

  void find(const Transform& X, bool all_kinds) {
    for (std::size_t v = 0; v < placed.size(); ++v) placed[v] = X(a.vertices[v]);
    boxes_a_.update();
    Pairs near;
    rtcCollide(boxes_a_.scene(), boxes_b_.scene(), &NearPairs::collect, &near);
    for (Pairs* pairs : {&corner_face, &face_corner, &edge_edge, &corner_edge, &edge_corner, &corner_corner})
      pairs->clear();
    for (const auto& [ta, tb] : near) {
      const auto &in_a = a.triangles[static_cast<std::size_t>(ta)],
                 &in_b = b.triangles[static_cast<std::size_t>(tb)];
      const auto &sides_a = edges_a.of_triangle[static_cast<std::size_t>(ta)],
                 &sides_b = edges_b.of_triangle[static_cast<std::size_t>(tb)];
      for (std::size_t i = 0; i < 3; ++i) {
        corner_face.emplace_back(in_a[i], tb);
        face_corner.emplace_back(ta, in_b[i]);
        for (std::size_t j = 0; j < 3; ++j) {
          edge_edge.emplace_back(sides_a[i], sides_b[j]);
          if (!all_kinds) continue;
          corner_edge.emplace_back(in_a[i], sides_b[j]);
          edge_corner.emplace_back(sides_a[i], in_b[j]);
          corner_corner.emplace_back(in_a[i], in_b[j]);
        }
      }
    }
    for (Pairs* pairs : {&corner_face, &face_corner, &edge_edge, &corner_edge, &edge_corner, &corner_corner})
      once(*pairs);
  }

  const Point& point_a(std::int32_t vertex) const { return placed[static_cast<std::size_t>(vertex)]; }
  const Point& point_b(std::int32_t vertex) const { return b.vertices[static_cast<std::size_t>(vertex)]; }
  const Edges::Edge& edge_a(std::int32_t edge) const { return edges_a.all[static_cast<std::size_t>(edge)]; }
  const Edges::Edge& edge_b(std::int32_t edge) const { return edges_b.all[static_cast<std::size_t>(edge)]; }
  Corners face_a(std::int32_t t) const {
    const auto& v = a.triangles[static_cast<std::size_t>(t)];
    return {point_a(v[0]), point_a(v[1]), point_a(v[2])};
  }
  Corners face_b(std::int32_t t) const {
    const auto& v = b.triangles[static_cast<std::size_t>(t)];
    return {point_b(v[0]), point_b(v[1]), point_b(v[2])};
  }

  enum class Kind { CORNER_FACE, FACE_CORNER, EDGE_EDGE };
  /// Calls take(kind, number on A, number on B, found) for all vertex-triangle and edge-edge pairs.
  template <class Take>
  void for_each(const Take& take) const {
    const auto corner_of = [](const Mesh& mesh, std::int32_t v) {
      const auto at = static_cast<std::size_t>(v);
      return std::pair(mesh.triangle_of[at], mesh.corner_of[at]);
    };
    constexpr std::int32_t ANY = LMDBENCH_PART_UNKNOWN;
    for (const auto& [v, t] : corner_face) {
      const auto [carrier, corner] = corner_of(a, v);
      const Corners face = face_b(t);
      take(Kind::CORNER_FACE, v, t,
           found(point_a(v), closest_on_triangle(point_a(v), face[0], face[1], face[2]), carrier, corner, t,
                 ANY));
    }
    for (const auto& [t, v] : face_corner) {
      const auto [carrier, corner] = corner_of(b, v);
      const Corners face = face_a(t);
      take(Kind::FACE_CORNER, t, v,
           found(closest_on_triangle(point_b(v), face[0], face[1], face[2]), point_b(v), t, ANY, carrier,
                 corner));
    }
    for (const auto& [i, j] : edge_edge) {
      const Edges::Edge &ea = edge_a(i), &eb = edge_b(j);
      Point p{}, q{};
      closest_of_segments(point_a(ea.from), point_a(ea.to), point_b(eb.from), point_b(eb.to), p, q);
      take(Kind::EDGE_EDGE, i, j, found(p, q, ea.triangle, ANY, eb.triangle, ANY));
    }
  }

 private:
  static void collect(void* pairs, RTCCollision* collisions, unsigned count) {
    for (unsigned i = 0; i < count; ++i)
      static_cast<Pairs*>(pairs)->emplace_back(static_cast<std::int32_t>(collisions[i].primID0),
                                               static_cast<std::int32_t>(collisions[i].primID1));
  }

  Device device_;
  Boxes boxes_a_, boxes_b_;
};

}  // namespace rivals
