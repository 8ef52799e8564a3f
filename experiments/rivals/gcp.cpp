// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// The geometric contact potential (Huang et al. 2025, smooth contact of ipc-toolkit). Pairs of
// features (vertex-vertex, edge-vertex, face-vertex, edge-edge) have smooth weights for an LMD's
// yes or no: a minimum of the distance along the pair's direction d (tangents: H(-d.t) per edge of
// a vertex and face of an edge; normals: d on the outer side), nearest points inside the features
// (mollifiers), share of the surface. Set: weight above zero. Force: minus the gradient of the sum
// of weights times barrier. Our decisions: H is the cubic smoothstep from -alpha to 0; the text's
// barrier, a cubic B-spline over the cutoff, over d/c to the power of 1; ipc-toolkit's mollifiers
// (threshold 1e-3); areas, squared lengths in squared cutoffs; newtons as they result, times the
// cutoff; open borders ask no face. Derivatives, also of weights, by A's motion: Eigen's AutoDiff.
#include "near_pairs.h"
#include "plugin.hpp"
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <unsupported/Eigen/AutoDiff>

#include <memory>

namespace {

using namespace rivals;

using Gradient = Eigen::Matrix<double, 6, 1>;  // translation and rotation of A
using Number = Eigen::AutoDiffScalar<Gradient>;
using Vector = Eigen::Matrix<Number, 3, 1>;

Number product(const Vector& a, const Vector& b) {
  return Number(a[0] * b[0]) + Number(a[1] * b[1]) + Number(a[2] * b[2]);
}
Vector times(const Number& s, const Vector& a) {
  return Vector(Number(s * a[0]), Number(s * a[1]), Number(s * a[2]));
}
Vector normal_to(const Vector& a, const Vector& b) {
  return Vector(Number(a[1] * b[2]) - Number(a[2] * b[1]), Number(a[2] * b[0]) - Number(a[0] * b[2]),
                Number(a[0] * b[1]) - Number(a[1] * b[0]));
}
Vector unit(const Vector& a) {
  return times(Number(1.0 / sqrt(product(a, a))), a);
}

/// From 0 at -alpha to 1 at 0.
Number heaviside(const Number& x, double alpha) {
  if (x.value() >= 0.0) return Number(1.0, Gradient::Zero());
  if (x.value() <= -alpha) return Number(0.0, Gradient::Zero());
  const Number s = x / alpha + 1.0;
  return s * s * (3.0 - 2.0 * s);
}
/// From 0 at 0 to 1 at 1.
Number mollifier(const Number& x) {
  if (x.value() >= 1.0) return Number(1.0, Gradient::Zero());
  if (x.value() <= 0.0) return Number(0.0, Gradient::Zero());
  return x * (2.0 - x);
}
Number barrier(const Number& x) {
  const Number y = 1.0 - x;
  const Number spline = x.value() < 0.5 ? Number(2.0 / 3.0 - 4.0 * x * x * y) : Number(4.0 / 3.0 * y * y * y);
  return spline / x;
}

class Side {
 public:
  Side(const NearPairs& near, bool is_a)
      : near_(near), is_a_(is_a), edges_(is_a ? near.edges_a : near.edges_b) {}

  /// Vertices of A carry derivatives: they move with it.
  Vector point(std::int32_t v) const {
    const Point& p = is_a_ ? near_.point_a(v) : near_.point_b(v);
    Vector result;
    for (int k = 0; k < 3; ++k) result[k] = Number(p[static_cast<std::size_t>(k)], Gradient::Zero());
    if (!is_a_) return result;
    const Point arm = p - origin;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      result[k].derivatives()[k] = 1.0;
      result[k].derivatives()[3 + l] = arm[static_cast<std::size_t>(m)];
      result[k].derivatives()[3 + m] = -arm[static_cast<std::size_t>(l)];
    }
    return result;
  }
  const Edges::Edge& edge(std::int32_t e) const { return edges_.all[static_cast<std::size_t>(e)]; }
  std::array<std::int32_t, 3> corners(std::int32_t t) const {
    return (is_a_ ? near_.a : near_.b).triangles[static_cast<std::size_t>(t)];
  }
  Vector face_normal(std::int32_t t) const {
    const auto v = corners(t);
    return normal_to(point(v[1]) - point(v[0]), point(v[2]) - point(v[0]));
  }

  // Weights of a feature for the unit direction to the other one; zero if they are no pair.
  Number of_vertex(std::int32_t v, const Vector& d) const {
    const Vector p = point(v);
    Number weight(1.0, Gradient::Zero()), lengths(0.0, Gradient::Zero());
    for (const std::int32_t e : edges_.of_vertex[static_cast<std::size_t>(v)]) {
      const Vector along = point(edge(e).from == v ? edge(e).to : edge(e).from) - p;
      const Number length = product(along, along);
      weight *= heaviside(-product(d, along) / sqrt(length), tangent_alpha);
      if (weight.value() == 0.0) return weight;
      lengths += length;
    }
    return weight * outside(edges_.triangles_of_vertex[static_cast<std::size_t>(v)], d) * lengths / 3.0;
  }
  Number of_edge(std::int32_t e, const Vector& d) const {
    const Vector from = point(edge(e).from), along = point(edge(e).to) - from;
    const Number length = product(along, along);
    Number weight(1.0, Gradient::Zero());
    for (const std::int32_t t : edge(e).triangles) {
      Vector inward = Vector::Zero();
      for (const std::int32_t v : corners(t))
        if (v != edge(e).from && v != edge(e).to) inward = point(v) - from;
      inward -= times(product(inward, along) / length, along);
      weight *= heaviside(-product(d, unit(inward)), tangent_alpha);
      if (weight.value() == 0.0) return weight;
    }
    return weight * outside(edge(e).triangles, d) * length;
  }
  Number of_face(std::int32_t t, const Vector& d) const {
    const Vector normal = face_normal(t);
    if (product(normal, d).value() <= 0.0) return Number(0.0, Gradient::Zero());
    return 0.5 * sqrt(product(normal, normal));
  }

  Point origin{};  ///< Origin of A's frame, which A turns about.
  double tangent_alpha = 0.5, normal_alpha = 0.1;

 private:
  Number outside(const std::vector<std::int32_t>& faces, const Vector& d) const {
    Number sum(faces.empty() ? 1.0 : 0.0, Gradient::Zero());
    for (const std::int32_t t : faces) sum += heaviside(product(d, unit(face_normal(t))), normal_alpha);
    return heaviside(sum - 1.0, 1.0);
  }

  const NearPairs& near_;
  bool is_a_;
  const Edges& edges_;
};

/// Nearest point to p on the line through an edge.
Vector on_line(const Vector& p, const Vector& from, const Vector& along) {
  return from + times(product(p - from, along) / product(along, along), along);
}
Number squared(const Vector& a) {
  return product(a, a);
}

class Gcp {
 public:
  Gcp(const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff, const std::string& options)
      : near_(std::make_unique<NearPairs>(a, b, cutoff)),
        a_(*near_, true),
        b_(*near_, false),
        cutoff_(cutoff) {
    const auto json = nlohmann::json::parse(options);
    a_.tangent_alpha = b_.tangent_alpha = json.at("tangent_alpha").get<double>();
    a_.normal_alpha = b_.normal_alpha = json.at("normal_alpha").get<double>();
  }

  void search(const double* X_BA, std::vector<lmdbench_contact>& contacts) {
    const Transform X{X_BA};
    near_->find(X, true);
    a_.origin = X.origin();
    gradient_.setZero();
    std::vector<Found> all;
    const NearPairs& near = *near_;
    for (const auto& [v, w] : near.corner_corner) {
      const Vector p = a_.point(v), q = b_.point(w);
      offer(
          p, q, one(), corner(near.a, v), corner(near.b, w), all,
          [&, v = v](const Vector& d) { return a_.of_vertex(v, d); },
          [&, w = w](const Vector& d) { return b_.of_vertex(w, d); });
    }
    for (const auto& [v, e] : near.corner_edge) {
      const Vector p = a_.point(v);
      const auto [q, weight] = of_line(p, b_, e);
      offer(
          p, q, weight, corner(near.a, v), side(b_, e), all,
          [&, v = v](const Vector& d) { return a_.of_vertex(v, d); },
          [&, e = e](const Vector& d) { return b_.of_edge(e, d); });
    }
    for (const auto& [e, w] : near.edge_corner) {
      const Vector q = b_.point(w);
      const auto [p, weight] = of_line(q, a_, e);
      offer(
          p, q, weight, side(a_, e), corner(near.b, w), all,
          [&, e = e](const Vector& d) { return a_.of_edge(e, d); },
          [&, w = w](const Vector& d) { return b_.of_vertex(w, d); });
    }
    for (const auto& [v, t] : near.corner_face) {
      const Vector p = a_.point(v);
      const auto [q, weight] = of_plane(p, b_, t);
      offer(
          p, q, weight, corner(near.a, v), {t, LMDBENCH_FACE}, all,
          [&, v = v](const Vector& d) { return a_.of_vertex(v, d); },
          [&, t = t](const Vector& d) { return b_.of_face(t, d); });
    }
    for (const auto& [t, w] : near.face_corner) {
      const Vector q = b_.point(w);
      const auto [p, weight] = of_plane(q, a_, t);
      offer(
          p, q, weight, {t, LMDBENCH_FACE}, corner(near.b, w), all,
          [&, t = t](const Vector& d) { return a_.of_face(t, d); },
          [&, w = w](const Vector& d) { return b_.of_vertex(w, d); });
    }
    for (const auto& [i, j] : near.edge_edge) {
      Vector p, q;
      const Number weight = of_lines(i, j, p, q);
      offer(
          p, q, weight, side(a_, i), side(b_, j), all,
          [&, i = i](const Vector& d) { return a_.of_edge(i, d); },
          [&, j = j](const Vector& d) { return b_.of_edge(j, d); });
    }
    hand_over(all, contacts);
  }

  void force(double* wrench) const {
    for (int k = 0; k < 6; ++k) wrench[k] = -cutoff_ * gradient_[k];
  }

 private:
  using Place = std::pair<std::int32_t, std::int32_t>;  // triangle, part
  static Number one() { return Number(1.0, Gradient::Zero()); }
  static Number none() { return Number(0.0, Gradient::Zero()); }
  static Place corner(const Mesh& mesh, std::int32_t v) {
    return {mesh.triangle_of[static_cast<std::size_t>(v)], mesh.corner_of[static_cast<std::size_t>(v)]};
  }
  static Place side(const Side& of, std::int32_t e) { return {of.edge(e).triangle, of.edge(e).part}; }

  /// How far a squared distance is above that of the pair, in thresholds.
  static Number inside(const Number& squared_distance, const Number& of_pair) {
    constexpr double THRESHOLD = 1e-3;
    return mollifier((squared_distance - of_pair) / (THRESHOLD * of_pair));
  }

  bool is_far(const Vector& p, const Vector& q) const {
    const Number d = squared(q - p);
    return !(d.value() > 0.0) || d.value() >= cutoff_ * cutoff_;
  }

  std::pair<Vector, Number> of_line(const Vector& p, const Side& of, std::int32_t e) const {
    const Vector from = of.point(of.edge(e).from), to = of.point(of.edge(e).to), along = to - from;
    const Number t = product(p - from, along) / product(along, along);
    if (!(t.value() > 0.0 && t.value() < 1.0)) return {p, none()};
    const Vector q = from + times(t, along);
    if (is_far(p, q)) return {p, none()};
    const Number d = squared(q - p);
    return {q, inside(squared(from - p), d) * inside(squared(to - p), d)};
  }
  std::pair<Vector, Number> of_plane(const Vector& p, const Side& of, std::int32_t t) const {
    const auto v = of.corners(t);
    const std::array<Vector, 3> corners{of.point(v[0]), of.point(v[1]), of.point(v[2])};
    const Vector normal = of.face_normal(t);
    const Vector q = p - times(product(p - corners[0], normal) / product(normal, normal), normal);
    if (is_far(p, q)) return {p, none()};
    Number weight = one();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector along = corners[(k + 1) % 3] - corners[k];
      if (product(normal_to(along, q - corners[k]), normal).value() <= 0.0) return {p, none()};
      weight *= inside(squared(on_line(p, corners[k], along) - p), squared(q - p));
    }
    return {q, weight};
  }
  Number of_lines(std::int32_t i, std::int32_t j, Vector& p, Vector& q) const {
    const Vector a0 = a_.point(a_.edge(i).from), a1 = a_.point(a_.edge(i).to), b0 = b_.point(b_.edge(j).from),
                 b1 = b_.point(b_.edge(j).to);
    const Vector u = a1 - a0, v = b1 - b0, w = a0 - b0;
    const Number a = product(u, u), b = product(u, v), c = product(v, v), d = product(u, w),
                 e = product(v, w);
    const Number denominator = a * c - b * b;
    if (!(denominator.value() > 1e-12 * a.value() * c.value())) return none();
    const Number s = (b * e - c * d) / denominator, t = (a * e - b * d) / denominator;
    if (!(s.value() > 0.0 && s.value() < 1.0 && t.value() > 0.0 && t.value() < 1.0)) return none();
    p = a0 + times(s, u);
    q = b0 + times(t, v);
    if (is_far(p, q)) return none();
    const Number of_pair = squared(q - p);
    return inside(to_segment(a0, b0, b1), of_pair) * inside(to_segment(a1, b0, b1), of_pair) *
           inside(to_segment(b0, a0, a1), of_pair) * inside(to_segment(b1, a0, a1), of_pair);
  }
  static Number to_segment(const Vector& p, const Vector& from, const Vector& to) {
    const Vector along = to - from;
    const Number t = product(p - from, along) / product(along, along);
    if (t.value() <= 0.0) return squared(from - p);
    if (t.value() >= 1.0) return squared(to - p);
    return squared(from + times(t, along) - p);
  }

  template <class OfA, class OfB>
  void offer(const Vector& p, const Vector& q, const Number& inside, Place on_a, Place on_b,
             std::vector<Found>& all, const OfA& of_a, const OfB& of_b) {
    if (!(inside.value() > 0.0) || is_far(p, q)) return;
    const Number d = sqrt(squared(q - p));
    const Vector u = times(Number(1.0 / d), q - p);
    const Number weight_a = of_a(u);
    if (!(weight_a.value() > 0.0)) return;
    const Number weight_b = of_b(-u);
    if (!(weight_b.value() > 0.0)) return;
    const double unit = 1.0 / (cutoff_ * cutoff_);
    const Number x = d / cutoff_;
    const Number term = inside * weight_a * weight_b * (unit * unit) * barrier(x);
    gradient_ += term.derivatives();
    const auto plain = [](const Vector& v) { return Point{v[0].value(), v[1].value(), v[2].value()}; };
    all.push_back(found(plain(p), plain(q), on_a.first, on_a.second, on_b.first, on_b.second));
  }

  std::unique_ptr<NearPairs> near_;
  Side a_, b_;
  double cutoff_;
  Gradient gradient_ = Gradient::Zero();
};

constexpr lmdbench_method METHOD = plugin::Functions<Gcp>::with_force(plugin::Functions<Gcp>::described(
    "gcp", "1", "pairs of features with smooth weights above zero (geometric contact potential)",
    LMDBENCH_PROMISE_APPROXIMATION,
    R"({"tangent_alpha": {"type": "number", "exclusiveMinimum": 0, "default": 0.5,
        "description": "how far beyond a minimum along a tangent a pair still counts, a cosine"},
        "normal_alpha": {"type": "number", "exclusiveMinimum": 0, "default": 0.1,
        "description": "how far behind a face a direction still is outside, a cosine"}})"));

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = plugin::entry_of<METHOD>();
