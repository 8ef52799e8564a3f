// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/region_shape.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {

namespace {

/// Slopes that differ by less than this are one line: the angle at which a piece may be bent inwards.
constexpr double SLOPE_ROUNDING = 1e-9;

/// A side that is not level, from its lower to its upper end.
struct Climb {
  Vec2 low, high;
  int winding;  ///< What is right of it is wound round so much more often than
                ///< what is left.
  double slope;

  explicit Climb(const PolygonSide& side)
      : low(side.from), high(side.to), winding(side.from[1] < side.to[1] ? -1 : 1) {
    if (winding > 0) std::swap(low, high);
    slope = (high[0] - low[0]) / (high[1] - low[1]);
  }
  double x_at(double y) const { return low[0] + slope * (y - low[1]); }
};

/// A convex piece that may still grow upwards.
struct OpenPiece {
  std::vector<Vec2> left,
      right;  ///< Corners from the bottom; the last of each is at the top.
  double left_slope, right_slope;
};

class Sweep {
 public:
  Sweep(std::span<const PolygonSide> sides, double tolerance) : tolerance_(tolerance) {
    for (const PolygonSide& side : sides) {
      heights_.push_back(side.from[1]);
      heights_.push_back(side.to[1]);
      if (std::abs(side.from[1] - side.to[1]) > tolerance) climbs_.emplace_back(side);
    }
    std::sort(heights_.begin(), heights_.end());
    std::stable_sort(climbs_.begin(), climbs_.end(),
                     [](const Climb& a, const Climb& b) { return a.low[1] < b.low[1]; });
  }

  std::vector<ConvexPolygon> run() {
    std::size_t next = 0;
    std::vector<const Climb*> active;
    for (std::size_t i = 0; i + 1 < heights_.size();) {
      // The next height that is not level with this one.
      std::size_t j = i + 1;
      while (j < heights_.size() && heights_[j] - heights_[i] <= tolerance_) ++j;
      if (j == heights_.size()) break;
      const double bottom = heights_[i], top = heights_[j];
      for (; next < climbs_.size() && climbs_[next].low[1] <= bottom + tolerance_; ++next)
        active.push_back(&climbs_[next]);
      std::erase_if(active, [&](const Climb* climb) { return climb->high[1] <= bottom + tolerance_; });
      row(active, bottom, top);
      i = j;
    }
    close_all();
    return std::move(pieces_);
  }

 private:
  void row(std::vector<const Climb*>& active, double bottom, double top) {
    const double middle = 0.5 * (bottom + top);
    std::stable_sort(active.begin(), active.end(),
                     [&](const Climb* a, const Climb* b) { return a->x_at(middle) < b->x_at(middle); });
    std::vector<OpenPiece> before;
    before.swap(open_);
    int winding = 0;
    const Climb* left = nullptr;
    for (const Climb* climb : active) {
      const bool was_inside = winding > 0;
      winding += climb->winding;
      if (!was_inside && winding > 0) left = climb;
      if (was_inside && winding <= 0) trapezoid(*left, *climb, bottom, top, before);
    }
    for (OpenPiece& piece : before) close(piece);
  }

  void trapezoid(const Climb& left, const Climb& right, double bottom, double top,
                 std::vector<OpenPiece>& before) {
    const Vec2 left_bottom(left.x_at(bottom), bottom), right_bottom(right.x_at(bottom), bottom);
    const Vec2 left_top(left.x_at(top), top), right_top(right.x_at(top), top);
    const auto goes_on = [&](const OpenPiece& piece) {
      return std::abs(piece.left.back()[0] - left_bottom[0]) <= 4.0 * tolerance_ &&
             std::abs(piece.right.back()[0] - right_bottom[0]) <= 4.0 * tolerance_ &&
             left.slope >= piece.left_slope - SLOPE_ROUNDING * (1.0 + std::abs(left.slope)) &&
             right.slope <= piece.right_slope + SLOPE_ROUNDING * (1.0 + std::abs(right.slope));
    };
    const auto found = std::find_if(before.begin(), before.end(), goes_on);
    if (found == before.end()) {
      open_.push_back({{left_bottom, left_top}, {right_bottom, right_top}, left.slope, right.slope});
      return;
    }
    OpenPiece piece = std::move(*found);
    before.erase(found);
    extend(piece.left, piece.left_slope, left_top, left.slope);
    extend(piece.right, piece.right_slope, right_top, right.slope);
    open_.push_back(std::move(piece));
  }

  static void extend(std::vector<Vec2>& chain, double& slope, const Vec2& top, double next_slope) {
    if (std::abs(next_slope - slope) <= SLOPE_ROUNDING * (1.0 + std::abs(slope))) {
      chain.back() = top;
      return;
    }
    chain.push_back(top);
    slope = next_slope;
  }

  void close(const OpenPiece& piece) {
    ConvexPolygon polygon;
    const auto add = [&](const Vec2& x) {
      if (polygon.corners.empty() || (polygon.corners.back() - x).norm() > tolerance_)
        polygon.corners.push_back(x);
    };
    std::for_each(piece.right.begin(), piece.right.end(), add);
    std::for_each(piece.left.rbegin(), piece.left.rend(), add);
    while (polygon.corners.size() > 1 &&
           (polygon.corners.back() - polygon.corners.front()).norm() <= tolerance_)
      polygon.corners.pop_back();
    if (polygon.corners.size() > 2) pieces_.push_back(std::move(polygon));
  }

  void close_all() {
    for (const OpenPiece& piece : open_) close(piece);
    open_.clear();
  }

  double tolerance_;
  std::vector<double> heights_;
  std::vector<Climb> climbs_;
  std::vector<OpenPiece> open_;
  std::vector<ConvexPolygon> pieces_;
};

}  // namespace

std::vector<ConvexPolygon> convex_pieces(std::span<const PolygonSide> sides, double tolerance) {
  return Sweep(sides, tolerance).run();
}

}  // namespace lmdbench
