// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/shape/polygon_sweep.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace lmdbench {

namespace {

/// Most distance of the ends of a piece and its continuation, in tolerances.
constexpr double CONTINUATION = 4.0;
/// Keeps slopes finite.
constexpr double STEEPEST = std::numeric_limits<double>::max();
/// Times as steep is a side whose place is known better than that of a nearly level one.
constexpr double STEEPER = 2.0;

/// A side that is not level, from its lower to its upper end.
struct Climb {
  Vec2 low, high;
  int winding;        ///< Winding number to its right less that to its left.
  std::size_t owner;  ///< Index of its polygon.
  double slope;

  Climb(const PolygonSide& side, std::size_t of)
      : low(side.from), high(side.to), winding(side.from[1] < side.to[1] ? -1 : 1), owner(of) {
    if (winding > 0) std::swap(low, high);
    slope = std::clamp((high[0] - low[0]) / (high[1] - low[1]), -STEEPEST, STEEPEST);
  }
  /// Not beyond its ends, from which rounding may lead far where it is nearly level.
  double x_at(double y) const {
    const auto [least, greatest] = std::minmax(low[0], high[0]);
    return std::clamp(low[0] + slope * (y - low[1]), least, greatest);
  }
};

/// A side in a row, and its place at the row's middle.
struct Active {
  const Climb* climb;
  double x;
};

/// Corners of one border of a convex piece from the bottom; the last is at the top.
struct Border {
  std::vector<Vec2> corners;
  const Climb* along;     ///< The side on which its last two corners lie.
  double left_out = 0.0;  ///< Most distance of what was left out since the last but one [m].

  /// Distance of the last corner from the way past it to a new top; negative where it turns right.
  double bend(const Vec2& top) const {
    const Vec2 &start = corners[corners.size() - 2], &last = corners.back();
    return cross(last - start, top - last) / (top - start).norm();
  }
  bool is_straight(const Vec2& top, double tolerance) const {
    return left_out + std::abs(bend(top)) <= tolerance;
  }
  void extend(const Climb& climb, const Vec2& top, double tolerance) {
    if (along != &climb && !is_straight(top, tolerance)) {
      corners.push_back(top);
      along = &climb;
      left_out = 0.0;
      return;
    }
    if (along != &climb) left_out += std::abs(bend(top));
    corners.back() = top;
  }
};

struct Outline {
  Border left, right;
};

/// A convex piece that may still grow upwards.
struct OpenPiece {
  static constexpr std::size_t NONE = std::numeric_limits<std::size_t>::max();

  const Climb *left, *right;    ///< The sides at its top.
  double left_x, right_x, top;  ///< At the top; its height.
  std::size_t part = 0;
  std::size_t outline = NONE;  ///< NONE once it has grown.
};

class Sweep {
 public:
  Sweep(std::array<std::span<const PolygonSide>, 2> polygons, double tolerance)
      : owners_(polygons[1].empty() ? 1 : 2), tolerance_(tolerance) {
    LMDBENCH_EXPECTS(tolerance >= 0.0, "a tolerance that is negative or not a number");
    heights_.reserve(polygons[0].size() + polygons[1].size());
    climbs_.reserve(polygons[0].size() + polygons[1].size());
    for (std::size_t owner = 0; owner < owners_; ++owner)
      for (const PolygonSide& side : polygons[owner]) {
        heights_.push_back(side.from[1]);
        if (side.from[1] != side.to[1]) climbs_.emplace_back(side, owner);
      }
    std::ranges::stable_sort(climbs_, {}, [](const Climb& climb) { return climb.low[1]; });
    add_crossings();
    find_rows();
  }

  /// The pieces by part.
  std::vector<SharedPart> run() {
    std::size_t next = 0;
    std::vector<Active> active;
    for (std::size_t i = 0; i + 1 < heights_.size(); ++i) {
      for (; next < climbs_.size() && is_level(heights_[i], climbs_[next].low[1]); ++next)
        active.push_back({&climbs_[next], 0.0});
      std::erase_if(active, [&](const Active& side) { return is_level(heights_[i], side.climb->high[1]); });
      row(active, heights_[i], heights_[i + 1]);
    }
    for (const OpenPiece& piece : open_) close(piece);
    return grouped();
  }

 private:
  /// Heights at which a side of one polygon crosses a side of the other, or sides of a polygon that
  /// is alone cross. Sides that are level to the tolerance, many in single precision, cross at the
  /// heights of their ends.
  void add_crossings() {
    std::array<std::vector<const Climb*>, 2> active;
    // Corners of one polygon are often on its own sides, to rounding.
    const double beyond = owners_ == 2 ? 0.0 : tolerance_;
    for (const Climb& climb : climbs_) {
      if (is_level(climb.low[1], climb.high[1])) continue;
      std::vector<const Climb*>& others = active[owners_ - 1 - climb.owner];
      std::erase_if(others, [&](const Climb* other) { return other->high[1] <= climb.low[1]; });
      for (const Climb* other : others) {
        const double bottom = climb.low[1], top = std::min(climb.high[1], other->high[1]);
        const double at_bottom = climb.low[0] - other->x_at(bottom),
                     at_top = climb.x_at(top) - other->x_at(top);
        if ((at_bottom < -beyond && at_top > beyond) || (at_bottom > beyond && at_top < -beyond))
          heights_.push_back(bottom + at_bottom / (at_bottom - at_top) * (top - bottom));
      }
      active[climb.owner].push_back(&climb);
    }
  }

  /// Whether a height, no lower than one at which a row begins, belongs to that row: one rule for
  /// all ends, so a corner is in one row for all of its sides and winding numbers add up.
  bool is_level(double beginning, double y) const { return y - beginning <= tolerance_; }

  /// Leaves of the heights those at which rows begin.
  void find_rows() {
    std::ranges::sort(heights_);
    heights_.erase(std::unique(heights_.begin(), heights_.end(),
                               [&](double beginning, double y) { return is_level(beginning, y); }),
                   heights_.end());
  }

  /// Most distance of what is one [m].
  double gap() const { return CONTINUATION * tolerance_; }

  void row(std::vector<Active>& active, double bottom, double top) {
    const double middle = 0.5 * (bottom + top);
    // Nearly sorted: the order of the row below.
    for (std::size_t k = 0; k < active.size(); ++k) {
      const Active climb{active[k].climb, active[k].climb->x_at(middle)};
      std::size_t at = k;
      for (; at > 0 && active[at - 1].x > climb.x; --at) active[at] = active[at - 1];
      active[at] = climb;
    }
    const bool is_in_order = before_.empty();
    before_.insert(before_.begin(), open_.begin(), open_.end());
    if (!is_in_order) std::ranges::sort(before_, {}, &OpenPiece::left_x);
    open_.clear();
    first_before_ = 0;
    std::array<int, 2> winding{0, owners_ == 1 ? 1 : 0};
    std::size_t left = 0;
    for (std::size_t k = 0; k < active.size(); ++k) {
      const Climb& climb = *active[k].climb;
      const bool was_inside = winding[0] > 0 && winding[1] > 0;
      winding[climb.owner] += climb.winding;
      const bool is_inside = winding[0] > 0 && winding[1] > 0;
      if (!was_inside && is_inside) left = k;
      if (was_inside && !is_inside) trapezoid(active, left, k, bottom, top);
    }
    for (OpenPiece& piece : before_) {
      close(piece);
      piece.outline = OpenPiece::NONE;
    }
    // Below a thin row it still meets what begins above.
    std::erase_if(before_, [&](const OpenPiece& piece) { return top - piece.top > gap(); });
  }

  /// The nearest of some sides that is clearly steeper than a nearly level one; null where there is
  /// none, or the side is steep enough for its place to be known to the gap.
  /// @param nearest, end  of a row's sides, away from `level`
  template <class Iterator>
  static const Climb* steeper_beside(const Climb& level, Iterator nearest, Iterator end) {
    const double flatness = std::abs(level.slope);
    if (flatness <= CONTINUATION) return nullptr;
    const auto beside = std::find_if(
        nearest, end, [&](const Active& side) { return STEEPER * std::abs(side.climb->slope) < flatness; });
    return beside == end ? nullptr : beside->climb;
  }

  void trapezoid(std::span<const Active> row, std::size_t left_at, std::size_t right_at, double bottom,
                 double top) {
    const Climb &left = *row[left_at].climb, &right = *row[right_at].climb;
    const auto before = row.first(left_at), after = row.subspan(right_at + 1);
    const Climb* before_left = steeper_beside(left, before.rbegin(), before.rend());
    const Climb* after_right = steeper_beside(right, after.begin(), after.end());
    // A nearly level side is inaccurate at a height, in a thin row by all its length: it stays
    // between the steeper ones beside it, and where the two seem to have crossed, the steeper one
    // counts.
    const auto ends_at = [&](double y) -> std::pair<double, double> {
      double from = left.x_at(y), to = right.x_at(y);
      if (before_left != nullptr) from = std::max(from, before_left->x_at(y));
      if (after_right != nullptr) to = std::min(to, after_right->x_at(y));
      if (from <= to) return {from, to};
      const double x = std::abs(left.slope) < std::abs(right.slope) ? from : to;
      return {x, x};
    };
    const auto [bottom_from, bottom_to] = ends_at(bottom);
    const auto [top_from, top_to] = ends_at(top);
    const Vec2 left_bottom(bottom_from, bottom), left_top(top_from, top);
    const Vec2 right_bottom(bottom_to, bottom), right_top(top_to, top);
    if (owners_ == 2 && right_bottom[0] - left_bottom[0] <= tolerance_ &&
        right_top[0] - left_top[0] <= tolerance_)
      return;
    const bool meets_neighbour = !open_.empty() && (left_bottom[0] - last_right_bottom_ <= gap() ||
                                                    left_top[0] - open_.back().right_x <= gap());
    last_right_bottom_ = right_bottom[0];
    while (first_before_ < before_.size() && before_[first_before_].right_x < left_bottom[0] - gap())
      ++first_before_;
    OpenPiece piece{&left, &right, left_top[0], right_top[0], top};
    OpenPiece* below = first_before_ < before_.size() ? &before_[first_before_] : nullptr;
    if (below != nullptr && below->left == &left && below->right == &right &&
        below->outline != OpenPiece::NONE) {
      // Same sides as in the row below: it met the same neighbours there.
      piece.part = below->part;
      grow(piece, *below, left_top, right_top);
    } else {
      grow_or_begin(piece, left_bottom, right_bottom, left_top, right_top);
    }
    if (meets_neighbour) meetings_.emplace_back(piece.part, open_.back().part);
    open_.push_back(piece);
  }

  /// A piece continues the one below where the two together are convex.
  void grow_or_begin(OpenPiece& piece, const Vec2& left_bottom, const Vec2& right_bottom,
                     const Vec2& left_top, const Vec2& right_top) {
    piece.part = part_count_++;
    for (std::size_t k = first_before_; k < before_.size() && before_[k].left_x <= right_bottom[0] + gap();
         ++k) {
      OpenPiece& below = before_[k];
      meetings_.emplace_back(piece.part, below.part);
      const bool goes_on = piece.outline == OpenPiece::NONE && below.outline != OpenPiece::NONE &&
                           std::abs(below.left_x - left_bottom[0]) <= gap() &&
                           std::abs(below.right_x - right_bottom[0]) <= gap() &&
                           is_convex(outlines_[below.outline], left_top, right_top);
      if (!goes_on) continue;
      grow(piece, below, left_top, right_top);
    }
    if (piece.outline != OpenPiece::NONE) return;
    piece.outline = outlines_.size();
    outlines_.push_back({{{left_bottom, left_top}, piece.left}, {{right_bottom, right_top}, piece.right}});
  }

  void grow(OpenPiece& piece, OpenPiece& below, const Vec2& left_top, const Vec2& right_top) {
    piece.outline = std::exchange(below.outline, OpenPiece::NONE);
    outlines_[piece.outline].left.extend(*piece.left, left_top, tolerance_);
    outlines_[piece.outline].right.extend(*piece.right, right_top, tolerance_);
  }

  bool is_convex(const Outline& below, const Vec2& left_top, const Vec2& right_top) const {
    return (below.left.bend(left_top) <= 0.0 || below.left.is_straight(left_top, tolerance_)) &&
           (below.right.bend(right_top) >= 0.0 || below.right.is_straight(right_top, tolerance_));
  }

  void close(const OpenPiece& piece) {
    if (piece.outline == OpenPiece::NONE) return;
    const auto& [left, right] = outlines_[piece.outline];
    ConvexPolygon polygon;
    polygon.corners.reserve(left.corners.size() + right.corners.size());
    const auto add = [&](const Vec2& x) {
      if (polygon.corners.empty() || (polygon.corners.back() - x).norm() > tolerance_)
        polygon.corners.push_back(x);
    };
    std::ranges::for_each(right.corners, add);
    std::for_each(left.corners.rbegin(), left.corners.rend(), add);
    while (polygon.corners.size() > 1 &&
           (polygon.corners.back() - polygon.corners.front()).norm() <= tolerance_)
      polygon.corners.pop_back();
    if (polygon.corners.size() < 3) return;
    pieces_.push_back(std::move(polygon));
    part_of_piece_.push_back(piece.part);
  }

  std::vector<SharedPart> grouped() {
    std::vector<SharedPart> result;
    boost::disjoint_sets_with_storage<> parts(part_count_);
    for (const auto& [one, other] : meetings_) parts.union_set(one, other);
    std::vector<std::size_t> place(part_count_, part_count_);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      std::size_t& at = place[parts.find_set(part_of_piece_[i])];
      if (at == part_count_) {
        at = result.size();
        result.emplace_back();
      }
      result[at].push_back(std::move(pieces_[i]));
    }
    return result;
  }

  std::size_t owners_;
  double tolerance_;
  std::vector<double> heights_;  ///< Once there are rows: where they begin, and the last one ends.
  std::vector<Climb> climbs_;
  std::vector<Outline> outlines_;
  std::vector<OpenPiece> open_, before_;  ///< Of this row and below it, from left to right.
  std::size_t first_before_ = 0;          ///< The first of before_ not left of the row so far.
  double last_right_bottom_ = 0.0;        ///< Of the last trapezoid of the row.
  std::vector<ConvexPolygon> pieces_;
  std::vector<std::size_t> part_of_piece_;
  std::size_t part_count_ = 0;                                 ///< One a trapezoid, before joining.
  std::vector<std::pair<std::size_t, std::size_t>> meetings_;  ///< Of parts.
};

}  // namespace

void append_sides_of(const ConvexPolygon& polygon, std::vector<PolygonSide>& sides) {
  for (std::size_t k = 0; k < polygon.corners.size(); ++k)
    sides.push_back({polygon.corners[k], polygon.corners[(k + 1) % polygon.corners.size()]});
}

std::vector<ConvexPolygon> convex_pieces(std::span<const PolygonSide> sides, double tolerance) {
  std::vector<ConvexPolygon> pieces;
  for (SharedPart& part : Sweep({sides, {}}, tolerance).run())
    std::ranges::move(part, std::back_inserter(pieces));
  return pieces;
}

std::vector<SharedPart> shared_parts(std::span<const PolygonSide> a, std::span<const PolygonSide> b,
                                     double tolerance) {
  if (a.empty() || b.empty()) return {};
  return Sweep({a, b}, tolerance).run();
}

}  // namespace lmdbench
