// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lmdbench::parts {

/// Numbers of a cell, or of the lines that meet in its lowest corner.
using Cell = std::array<int, 3>;

/// Two parts drawn in cells between lines (rest_fits.h), and where they meet if each line is one
/// plane for both. Then part A's lines are moved off B's towards A: each meeting becomes a gap.
class RestDrawing {
 public:
  /// @pre all rows of a layer, and all layers, have one size
  explicit RestDrawing(std::string_view drawing);

  int count(std::size_t axis) const { return counts_[axis]; }
  /// 'A', 'B' or '.', also outside the drawing.
  char at(const Cell& cell) const;

  /// Both parts are manifolds that meet somewhere; A is on one side of each line where they meet.
  bool is_sound() const { return sound_ && !meetings_.empty(); }
  /// Side of A at a line where it meets B: 1 if its cells are above, -1 below, 0 if nothing meets.
  int side_of_a(std::size_t axis, int line) const { return sides_[axis][static_cast<std::size_t>(line)]; }

  /// A line where a contact of faces ends; reflex if one of the parts turns round the other there.
  struct Border {
    std::size_t axis;
    int line;
    bool is_reflex;
  };
  /// A connected place where both parts meet: faces on one line, edges on two, corners on three.
  struct Meeting {
    std::vector<std::pair<std::size_t, int>> axes;    ///< Axis and line.
    std::vector<Cell> corners;                        ///< Corners of all its cells, as lines.
    std::vector<std::array<Border, 2>> border_pairs;  ///< Of faces: borders at each convex corner.
    bool leads_down = false;                          ///< Of edges: one continues where faces meet.
  };
  const std::vector<Meeting>& meetings() const { return meetings_; }

 private:
  bool is_facing(std::size_t axis, const Cell& lower) const;
  bool is_passing(std::size_t axis, const Cell& lowest) const;
  void meet(std::size_t axis, int line, int side);
  void find_faces(std::size_t axis);
  void find_edges(std::size_t axis);
  void find_corners();

  Cell counts_{};
  std::string cells_;
  std::array<std::vector<int>, 3> sides_;
  std::vector<Meeting> meetings_;
  bool sound_ = true;
};

}  // namespace lmdbench::parts
