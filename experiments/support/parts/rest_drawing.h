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

/// Two parts drawn in cells between lines (rest_fits.h), and where they meet when every line is one plane for both. Part A's lines are
/// then moved off B's, to the side of A: each meeting becomes a gap of its own.
class RestDrawing {
 public:
  /// @pre rows of a layer and layers of a drawing are of one size
  explicit RestDrawing(std::string_view drawing);

  int count(std::size_t axis) const { return counts_[axis]; }
  /// 'A', 'B', or '.', which is also what is round the drawing.
  char at(const Cell& cell) const;

  /// Whether both parts are manifolds, meet somewhere, and A is on one side of every line across which they meet.
  bool is_sound() const { return sound_ && !meetings_.empty(); }
  /// On which side of a line part A meets B: 1 where its cells are those above, -1 below, 0 where nothing meets.
  int side_of_a(std::size_t axis, int line) const { return sides_[axis][static_cast<std::size_t>(line)]; }

  /// A line at which a contact of faces ends; reflex where one of the parts turns round the other there.
  struct Border {
    std::size_t axis;
    int line;
    bool is_reflex;
  };
  /// A connected place where both parts meet: of faces on one line, of edges on two, of corners on three.
  struct Meeting {
    std::vector<std::pair<std::size_t, int>> axes;  ///< Axis and line.
    std::vector<Cell> corners;                      ///< Of all cells of it, as lines.
    std::vector<std::array<Border, 2>>
        border_pairs;         ///< Of faces: the borders at each convex corner of the place.
    bool leads_down = false;  ///< Of edges: one goes on where faces meet.
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
