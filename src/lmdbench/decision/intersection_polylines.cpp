// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/intersection_polylines.h>
#include <lmdbench/geometry/triangle_intersection.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace lmdbench {

namespace {

/// An edge of one mesh that pierces a triangle of the other.
struct Piercing {
  bool moving_edge;
  std::int32_t edge, triangle;
  auto operator<=>(const Piercing&) const = default;
};

/// An end of a segment: the segments of two pairs of triangles meet in one piercing.
struct SegmentEnd {
  Piercing at;
  std::size_t segment;  ///< The other end of segment s is ends[...] with the same number.
  auto operator<=>(const SegmentEnd&) const = default;
};

class Tracer {
 public:
  Tracer(const Surface& moving, const RigidTransform& X_WM, const Surface& fixed)
      : moving_(moving), X_WM_(X_WM), fixed_(fixed) {}

  void add_segment(std::int32_t t_moving, std::int32_t t_fixed) {
    const Triangle a = X_WM_.triangle(moving_.mesh.triangle(t_moving));
    const Triangle b = fixed_.mesh.triangle(t_fixed);
    std::array<Piercing, 2> ends{};
    std::size_t count = 0;
    const auto add = [&](const Piercing& end) {
      if (count < 2) ends[count] = end;
      ++count;
    };
    for (const std::int32_t edge : moving_.adjacency.triangle_edges[static_cast<std::size_t>(t_moving)])
      if (pierces(moving_edge(edge), PiercingBody::DISPLACED, b)) add({true, edge, t_fixed});
    for (const std::int32_t edge : fixed_.adjacency.triangle_edges[static_cast<std::size_t>(t_fixed)])
      if (pierces(fixed_.edge(edge), PiercingBody::RESTING, a)) add({false, edge, t_moving});
    // Triangles that only touch have none, where ties are broken.
    if (count == 2) segments_.push_back(ends);
  }

  void chain(std::int32_t body, std::vector<IntersectionPolyline>& polylines) {
    for (std::size_t s = 0; s < segments_.size(); ++s)
      for (const Piercing& end : segments_[s]) ends_.push_back({end, s});
    std::sort(ends_.begin(), ends_.end());
    used_.assign(segments_.size(), false);
    // Open polylines first, from their ends; the others are closed.
    for (const bool open : {true, false})
      for (std::size_t s = 0; s < segments_.size(); ++s)
        for (std::size_t k = 0; k < 2 && !used_[s]; ++k)
          if (!open || !goes_on(segments_[s][k])) polylines.push_back(walk(body, s, k));
  }

 private:
  Segment moving_edge(std::int32_t edge) const {
    const auto [p, q] = moving_.edge(edge);
    return {X_WM_.point(p), X_WM_.point(q)};
  }
  Vec3 point_of(const Piercing& at) const {
    return at.moving_edge
               ? piercing_point(moving_edge(at.edge), fixed_.mesh.triangle(at.triangle))
               : piercing_point(fixed_.edge(at.edge), X_WM_.triangle(moving_.mesh.triangle(at.triangle)));
  }
  /// The segments that meet there.
  std::span<const SegmentEnd> meeting(const Piercing& at) const {
    const auto [first, last] =
        std::equal_range(ends_.begin(), ends_.end(), SegmentEnd{at, 0},
                         [](const SegmentEnd& a, const SegmentEnd& b) { return a.at < b.at; });
    return {first, last};
  }
  bool goes_on(const Piercing& at) const { return meeting(at).size() == 2; }

  /// Follows the segments from end `k` of segment `s`.
  IntersectionPolyline walk(std::int32_t body, std::size_t s, std::size_t k) {
    IntersectionPolyline line;
    line.fixed_body = body;
    const Piercing start = segments_[s][k];
    line.points.push_back(point_of(start));
    for (;;) {
      used_[s] = true;
      const Piercing& next = segments_[s][0] == segments_[s][k] ? segments_[s][1] : segments_[s][0];
      if (next == start) {
        line.closed = true;
        return line;
      }
      line.points.push_back(point_of(next));
      const std::span<const SegmentEnd> here = meeting(next);
      if (here.size() != 2) return line;
      s = here[0].segment == s ? here[1].segment : here[0].segment;
      if (used_[s]) return line;
      k = segments_[s][0] == next ? 0 : 1;
    }
  }

  const Surface& moving_;
  const RigidTransform& X_WM_;
  const Surface& fixed_;
  std::vector<std::array<Piercing, 2>> segments_;
  std::vector<SegmentEnd> ends_;
  std::vector<bool> used_;
};

}  // namespace

double IntersectionPolyline::length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  if (closed && !points.empty()) sum += (points.front() - points.back()).norm();
  return sum;
}

void append_polylines(const Surface& moving, const RigidTransform& X_WM, const Surface& fixed,
                      std::vector<CrossingPair>& pairs, std::vector<IntersectionPolyline>& polylines) {
  if (pairs.empty()) return;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Tracer tracer(moving, X_WM, fixed);
  for (const CrossingPair& pair : pairs) tracer.add_segment(pair.moving, pair.fixed);
  tracer.chain(pairs.front().fixed_body, polylines);
}

}  // namespace lmdbench
