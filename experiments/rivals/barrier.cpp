// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Incremental potential contact (Li et al. 2020, section 4). Set: vertex-triangle and edge-edge
// pairs nearer than the cutoff c, at exact distances. Force: minus the gradient of the sum of b(d)
// = -(1 - d/c)^2 ln(d/c), with a mollifier for nearly parallel edges. "weights" "area" (Li et al.
// 2023): times a third of the area about a vertex or edge. "maximum" "improved" (same paper): less
// what triangles share (triangles - edges + vertices about a vertex, edges - (degree - 1) vertices
// about an edge): finer meshes push no more. That cancels where only parts about one feature are
// near: with a cutoff of several edges too much is subtracted, on flat grids until the push turns
// about. Our decisions: "improved" is "plain" where the cutoff is above a mean edge; pairs on the
// same lower features are one contact, as in ipc-toolkit, with as many forces; b is of d, not its
// square; newtons are b's times c, areas over c^2; two edges share a weight; distance 0, excluded
// by the barrier, has no force.
#include "near_pairs.h"
#include "plugin.hpp"
#include <nlohmann/json.hpp>

#include <memory>

namespace {

using namespace rivals;

class Barrier {
 public:
  Barrier(const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff, const std::string& options)
      : pairs_(std::make_unique<NearPairs>(a, b, cutoff)),
        cutoff_(cutoff),
        by_area_(nlohmann::json::parse(options).at("weights") == "area"),
        subtracts_(by_area_ && nlohmann::json::parse(options).at("maximum") == "improved" &&
                   cutoff <= std::min(pairs_->edges_a.mean_length(pairs_->a),
                                      pairs_->edges_b.mean_length(pairs_->b))),
        share_a_(pairs_->a, pairs_->edges_a, cutoff),
        share_b_(pairs_->b, pairs_->edges_b, cutoff) {}

  void search(const double* X_BA, std::vector<lmdbench_contact>& contacts) {
    using Kind = NearPairs::Kind;
    const Transform X{X_BA};
    const NearPairs& near = *pairs_;
    pairs_->find(X, subtracts_);
    wrench_ = {X.origin(), {}, {}};
    std::vector<Found> all;
    near.for_each([&](Kind kind, std::int32_t i, std::int32_t j, const Found& pair) {
      if (!(pair.distance < cutoff_)) return;
      all.push_back(pair);
      const auto at_a = static_cast<std::size_t>(i), at_b = static_cast<std::size_t>(j);
      if (kind == Kind::EDGE_EDGE)
        push_edges(near.edge_a(i), near.edge_b(j), pair,
                   by_area_ ? 0.5 * (share_a_.edge[at_a] + share_b_.edge[at_b]) : 1.0);
      else
        push(pair, !by_area_                   ? 1.0
                   : kind == Kind::CORNER_FACE ? share_a_.vertex[at_a]
                                               : share_b_.vertex[at_b]);
    });
    if (subtracts_) subtract_what_is_shared();
    hand_over(all, contacts);
  }

  void force(double* wrench) const { wrench_.to(wrench); }

 private:
  /// A third of the area about each vertex and edge, in squared cutoffs.
  struct Shares {
    std::vector<double> vertex, edge;
    Shares(const Mesh& mesh, const Edges& edges, double cutoff)
        : vertex(mesh.vertices.size()), edge(edges.all.size()) {
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Point& origin = mesh.corner(t, 0);
        const double third =
            norm(cross(mesh.corner(t, 1) - origin, mesh.corner(t, 2) - origin)) / (6.0 * cutoff * cutoff);
        for (const std::int32_t v : mesh.triangles[t]) vertex[static_cast<std::size_t>(v)] += third;
        for (const std::int32_t e : edges.of_triangle[t]) edge[static_cast<std::size_t>(e)] += third;
      }
    }
  };

  double barrier(double d) const {
    return -(1.0 - d / cutoff_) * (1.0 - d / cutoff_) * std::log(d / cutoff_);
  }
  /// -db/dd times c
  double slope(double d) const {
    const double x = d / cutoff_;
    return (1.0 - x) * (1.0 - x) / x - 2.0 * (1.0 - x) * std::log(x);
  }

  void push(const Point& p, const Point& q, double weight) {
    const double d = distance(p, q);
    if (d > 0.0 && d < cutoff_) wrench_.push(p, (weight * slope(d) / d) * (p - q));
  }
  void push(const Found& pair, double weight) {
    const auto& [p, q] = std::pair(pair.contact.point_a, pair.contact.point_b);
    push(Point{p[0], p[1], p[2]}, Point{q[0], q[1], q[2]}, weight);
  }

  /// Li et al. 2020, equation 24: the mollifier of nearly parallel edges, which also turns A.
  void push_edges(const Edges::Edge& ea, const Edges::Edge& eb, const Found& pair, double weight) {
    const Point along_a = pairs_->point_a(ea.to) - pairs_->point_a(ea.from),
                along_b = pairs_->point_b(eb.to) - pairs_->point_b(eb.from), both = cross(along_a, along_b);
    const double threshold = 1e-3 * dot(along_a, along_a) * dot(along_b, along_b),
                 x = threshold > 0.0 ? dot(both, both) / threshold : 0.0;
    if (x >= 1.0) return push(pair, weight);
    push(pair, weight * x * (2.0 - x));
    if (pair.distance > 0.0 && threshold > 0.0)
      wrench_.torque =
          wrench_.torque - (weight * cutoff_ * barrier(pair.distance) * 2.0 * (1.0 - x) * 2.0 / threshold) *
                               cross(along_a, cross(along_b, both));
  }

  void subtract_what_is_shared() {
    const NearPairs& near = *pairs_;
    const auto nearest = [](const Point& p, const Point& from, const Point& to) {
      const Point along = to - from;
      const double length = dot(along, along);
      return from + (length > 0.0 ? std::clamp(dot(p - from, along) / length, 0.0, 1.0) : 0.0) * along;
    };
    const auto spare = [](const Edges& edges, std::int32_t v) {
      return static_cast<double>(edges.of_vertex[static_cast<std::size_t>(v)].size()) - 1.0;
    };
    for (const auto& [v, e] : near.corner_edge) {
      const auto at = static_cast<std::size_t>(v);
      const Point& p = near.point_a(v);
      const Edges::Edge& edge = near.edge_b(e);
      push(p, nearest(p, near.point_b(edge.from), near.point_b(edge.to)),
           -share_a_.vertex[at] - 0.5 * spare(near.edges_a, v) * share_b_.edge[static_cast<std::size_t>(e)]);
    }
    for (const auto& [e, v] : near.edge_corner) {
      const auto at = static_cast<std::size_t>(v);
      const Point& q = near.point_b(v);
      const Edges::Edge& edge = near.edge_a(e);
      push(nearest(q, near.point_a(edge.from), near.point_a(edge.to)), q,
           -share_b_.vertex[at] - 0.5 * spare(near.edges_b, v) * share_a_.edge[static_cast<std::size_t>(e)]);
    }
    for (const auto& [v, w] : near.corner_corner)
      push(near.point_a(v), near.point_b(w),
           share_a_.vertex[static_cast<std::size_t>(v)] + share_b_.vertex[static_cast<std::size_t>(w)]);
  }

  std::unique_ptr<NearPairs> pairs_;
  double cutoff_;
  bool by_area_, subtracts_;
  Shares share_a_, share_b_;
  Wrench wrench_;
};

constexpr lmdbench_method METHOD = plugin::Functions<Barrier>::with_force(
    plugin::Functions<Barrier>::described("barrier", "3",
                                          "all vertex-triangle and edge-edge pairs within the cutoff, with a "
                                          "log barrier (incremental potential "
                                          "contact)",
                                          LMDBENCH_PROMISE_APPROXIMATION,
                                          R"json({"weights": {"enum": ["each", "area"], "default": "area",
        "description": "each pair counts once (2020), or by area (2023)"},
        "maximum": {"enum": ["improved", "plain"], "default": "improved",
        "description": "by area: less what triangles share, if the cutoff is within a mean edge, or all"}})json"));

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = plugin::entry_of<METHOD>();
