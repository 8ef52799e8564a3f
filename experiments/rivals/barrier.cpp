// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// The pairs of incremental potential contact (Li et al. 2020, section 4): all vertex-triangle and edge-edge pairs nearer than the cutoff,
// each at its exact distance. Decisions, ours: pairs whose nearest points lie on lower parts (a vertex over an edge) are one pair of
// these parts, as ipc-toolkit merges them (there with their number as weight); the broad phase is made anew for each pose, from boxes
// inflated by the cutoff, as there (here by rtcCollide); the edge-edge mollifier and area weights are factors of the force and
// change no set. Forces are the experiment's law over these pairs, not the logarithm.
#include "closest.h"
#include "plugin.hpp"
#include <embree3/rtcore.h>

#include <memory>
#include <stdexcept>
#include <utility>

namespace {

using namespace rivals;

/// Edges of a mesh, each with a triangle and its number there.
struct Edges {
  struct Edge {
    std::int32_t from, to, triangle, part;
  };
  std::vector<Edge> all;
  std::vector<std::array<std::int32_t, 3>> of_triangle;

  explicit Edges(const Mesh& mesh) {
    std::vector<std::array<std::int32_t, 4>> sides;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::int32_t k = 0; k < 3; ++k) {
        const auto u = mesh.triangles[t][static_cast<std::size_t>(k)],
                   v = mesh.triangles[t][static_cast<std::size_t>((k + 1) % 3)];
        sides.push_back({std::min(u, v), std::max(u, v), static_cast<std::int32_t>(t), k});
      }
    std::sort(sides.begin(), sides.end());
    of_triangle.resize(mesh.triangles.size());
    for (const auto& [u, v, t, k] : sides) {
      if (all.empty() || all.back().from != u || all.back().to != v)
        all.push_back({u, v, t, LMDBENCH_EDGE_0 + k});
      of_triangle[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)] =
          static_cast<std::int32_t>(all.size() - 1);
    }
  }
};

/// Boxes of triangles, larger by a margin, that Embree makes a tree of.
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

class Barrier {
 public:
  Barrier(const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff, const std::string& /*options*/)
      : kept_(std::make_unique<Kept>(a, b, cutoff)), cutoff_(cutoff) {}

  void search(const double* X_BA, std::vector<lmdbench_contact>& contacts) {
    Kept& k = *kept_;
    const Transform X{X_BA};
    for (std::size_t v = 0; v < k.placed.size(); ++v) k.placed[v] = X(k.a.vertices[v]);
    k.boxes_a.update();
    Pairs near;
    rtcCollide(k.boxes_a.scene(), k.boxes_b.scene(), &Barrier::collect, &near);

    Pairs corner_a, corner_b, edges;
    for (const auto& [ta, tb] : near) {
      const auto &in_a = k.a.triangles[static_cast<std::size_t>(ta)],
                 &in_b = k.b.triangles[static_cast<std::size_t>(tb)];
      const auto &edges_a = k.edges_a.of_triangle[static_cast<std::size_t>(ta)],
                 &edges_b = k.edges_b.of_triangle[static_cast<std::size_t>(tb)];
      for (std::size_t i = 0; i < 3; ++i) {
        corner_a.emplace_back(in_a[i], tb);
        corner_b.emplace_back(ta, in_b[i]);
        for (std::size_t j = 0; j < 3; ++j) edges.emplace_back(edges_a[i], edges_b[j]);
      }
    }
    std::vector<Found> all;
    const auto keep = [&](const Found& pair) {
      if (pair.distance <= cutoff_) all.push_back(pair);
    };
    for (const auto& [v, t] : once(corner_a)) {
      const auto vertex = static_cast<std::size_t>(v), triangle = static_cast<std::size_t>(t);
      const Point& p = k.placed[vertex];
      const Point q =
          closest_on_triangle(p, k.b.corner(triangle, 0), k.b.corner(triangle, 1), k.b.corner(triangle, 2));
      keep(found(p, q, k.a.triangle_of[vertex], k.a.corner_of[vertex], t, LMDBENCH_PART_UNKNOWN));
    }
    const auto placed_corner = [&](std::int32_t t, std::size_t c) -> const Point& {
      return k.placed[static_cast<std::size_t>(k.a.triangles[static_cast<std::size_t>(t)][c])];
    };
    for (const auto& [t, v] : once(corner_b)) {
      const auto vertex = static_cast<std::size_t>(v);
      const Point& q = k.b.vertices[vertex];
      const Point p = closest_on_triangle(q, placed_corner(t, 0), placed_corner(t, 1), placed_corner(t, 2));
      keep(found(p, q, t, LMDBENCH_PART_UNKNOWN, k.b.triangle_of[vertex], k.b.corner_of[vertex]));
    }
    for (const auto& [of_a, of_b] : once(edges)) {
      const Edges::Edge &ea = k.edges_a.all[static_cast<std::size_t>(of_a)],
                        &eb = k.edges_b.all[static_cast<std::size_t>(of_b)];
      Point p{}, q{};
      closest_of_segments(k.placed[static_cast<std::size_t>(ea.from)],
                          k.placed[static_cast<std::size_t>(ea.to)],
                          k.b.vertices[static_cast<std::size_t>(eb.from)],
                          k.b.vertices[static_cast<std::size_t>(eb.to)], p, q);
      keep(found(p, q, ea.triangle, LMDBENCH_PART_UNKNOWN, eb.triangle, LMDBENCH_PART_UNKNOWN));
    }
    hand_over(all, contacts);
  }

 private:
  using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

  static void collect(void* pairs, RTCCollision* collisions, unsigned count) {
    for (unsigned i = 0; i < count; ++i)
      static_cast<Pairs*>(pairs)->emplace_back(static_cast<std::int32_t>(collisions[i].primID0),
                                               static_cast<std::int32_t>(collisions[i].primID1));
  }
  static const Pairs& once(Pairs& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  struct Kept {
    Mesh a, b;
    Edges edges_a{a}, edges_b{b};
    std::vector<Point> placed;  // vertices of A in B's frame
    Device device;
    Boxes boxes_a, boxes_b;
    Kept(const lmdbench_mesh& of_a, const lmdbench_mesh& of_b, double cutoff)
        : a(of_a),
          b(of_b),
          placed(a.vertices),
          boxes_a(device.device, a, placed, cutoff + 1e-6 * (a.diagonal + b.diagonal)),
          boxes_b(device.device, b, b.vertices, 0.0) {}
  };
  std::unique_ptr<Kept> kept_;
  double cutoff_;
};

constexpr lmdbench_method METHOD = plugin::Functions<Barrier>::described(
    "barrier", "1",
    "all vertex-triangle and edge-edge pairs within the cutoff (incremental potential contact)",
    LMDBENCH_PROMISE_APPROXIMATION);

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = plugin::entry_of<METHOD>();
