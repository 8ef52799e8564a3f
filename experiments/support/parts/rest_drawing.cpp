// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <support/parts/rest_drawing.h>

#include <algorithm>
#include <set>

namespace lmdbench::parts {
namespace {

Cell stepped(Cell cell, std::size_t axis, int step = 1) {
  cell[axis] += step;
  return cell;
}

/// The two other axes.
std::array<std::size_t, 2> others(std::size_t axis) {
  return {(axis + 1) % 3, (axis + 2) % 3};
}

bool are_both(char a, char b) {
  return (a == 'A' && b == 'B') || (a == 'B' && b == 'A');
}

}  // namespace

RestDrawing::RestDrawing(std::string_view drawing) {
  const auto layers = static_cast<int>(std::count(drawing.begin(), drawing.end(), ';')) + 1;
  const std::string_view layer = drawing.substr(0, drawing.find(';'));
  const auto rows = static_cast<int>(std::count(layer.begin(), layer.end(), '/')) + 1;
  counts_ = {static_cast<int>(std::min(layer.find('/'), layer.size())), layers, rows};
  std::copy_if(drawing.begin(), drawing.end(), std::back_inserter(cells_),
               [](char c) { return c != '/' && c != ';'; });
  for (std::size_t axis = 0; axis < 3; ++axis)
    sides_[axis].assign(static_cast<std::size_t>(counts_[axis]) + 1, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) find_faces(axis);
  for (std::size_t axis = 0; axis < 3; ++axis) find_edges(axis);
  find_corners();
}

char RestDrawing::at(const Cell& cell) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (cell[axis] < 0 || cell[axis] >= counts_[axis]) return '.';
  const int row = counts_[2] - 1 - cell[2];
  return cells_[static_cast<std::size_t>((cell[1] * counts_[2] + row) * counts_[0] + cell[0])];
}

void RestDrawing::meet(std::size_t axis, int line, int side) {
  int& known = sides_[axis][static_cast<std::size_t>(line)];
  sound_ = sound_ && known != -side;
  known = side;
}

/// Whether different parts are on both sides of the line above the cell.
bool RestDrawing::is_facing(std::size_t axis, const Cell& lower) const {
  return are_both(at(lower), at(stepped(lower, axis)));
}

/// Whether only two edges along the axis pass each other at the upper lines of the cell.
bool RestDrawing::is_passing(std::size_t axis, const Cell& lowest) const {
  const auto [a, b] = others(axis);
  const char p = at(lowest), q = at(stepped(lowest, a)), r = at(stepped(lowest, b)),
             s = at(stepped(stepped(lowest, a), b));
  return (are_both(p, s) && q == '.' && r == '.') || (are_both(q, r) && p == '.' && s == '.');
}

namespace {

/// Calls with every cell, including those just around the drawing.
template <typename Visit>
void for_cells(const Cell& counts, const Visit& visit) {
  for (int i = -1; i <= counts[0]; ++i)
    for (int j = -1; j <= counts[1]; ++j)
      for (int k = -1; k <= counts[2]; ++k) visit(Cell{i, j, k});
}

}  // namespace

void RestDrawing::find_faces(std::size_t axis) {
  const auto [a, b] = others(axis);
  std::set<Cell> seen;
  for_cells(counts_, [&](const Cell& first) {
    if (!is_facing(axis, first) || !seen.insert(first).second) return;
    Meeting meeting;
    meeting.axes = {{axis, first[axis] + 1}};
    meet(axis, first[axis] + 1, at(first) == 'B' ? 1 : -1);
    std::vector<Cell> open = {first};
    while (!open.empty()) {
      const Cell cell = open.back();
      open.pop_back();
      const auto border = [&](std::size_t along, int step) {
        const char next = at(stepped(cell, along, step));
        return Border{along, cell[along] + (step + 1) / 2,
                      next != '.' && next == at(stepped(stepped(cell, along, step), axis))};
      };
      for (const int i : {0, 1})
        for (const int j : {0, 1}) {
          meeting.corners.push_back(stepped(stepped(stepped(cell, axis), a, i), b, j));
          if (!is_facing(axis, stepped(cell, a, 2 * i - 1)) && !is_facing(axis, stepped(cell, b, 2 * j - 1)))
            meeting.border_pairs.push_back({border(a, 2 * i - 1), border(b, 2 * j - 1)});
        }
      for (const std::size_t along : {a, b})
        for (const int step : {-1, 1}) {
          const Cell next = stepped(cell, along, step);
          if (is_facing(axis, next) && seen.insert(next).second) open.push_back(next);
        }
    }
    meetings_.push_back(std::move(meeting));
  });
}

void RestDrawing::find_edges(std::size_t axis) {
  const auto [a, b] = others(axis);
  for_cells(counts_, [&](const Cell& cell) {
    for (const char part : {'A', 'B'}) {
      const bool p = at(cell) == part, q = at(stepped(cell, a)) == part, r = at(stepped(cell, b)) == part,
                 s = at(stepped(stepped(cell, a), b)) == part;
      if (p == s && q == r && p != q) sound_ = false;  // two edges of one part coincide
    }
    if (!is_passing(axis, cell) || is_passing(axis, stepped(cell, axis, -1))) return;
    Meeting meeting;
    const bool rises = at(cell) != '.';  // the lower cell along a is the lower one along b
    const int side_a = at(rises ? cell : stepped(cell, b)) == 'A' ? -1 : 1;
    meet(a, cell[a] + 1, side_a);
    meet(b, cell[b] + 1, rises ? side_a : -side_a);
    meeting.axes = {{a, cell[a] + 1}, {b, cell[b] + 1}};
    const auto has_both = [&](const Cell& lowest) {
      std::string all;
      for (const int i : {0, 1})
        for (const int j : {0, 1}) all += at(stepped(stepped(lowest, a, i), b, j));
      return all.find('A') != std::string::npos && all.find('B') != std::string::npos;
    };
    Cell end = cell;
    for (; is_passing(axis, end); end = stepped(end, axis))
      for (const int i : {0, 1}) meeting.corners.push_back(stepped(stepped(stepped(end, a), b), axis, i));
    meeting.leads_down = has_both(end) || has_both(stepped(cell, axis, -1));
    meetings_.push_back(std::move(meeting));
  });
}

void RestDrawing::find_corners() {
  for_cells(counts_, [&](const Cell& cell) {
    for (int diagonal = 0; diagonal < 4; ++diagonal) {
      const auto corner = [&](int bits) {
        return at({cell[0] + (bits & 1), cell[1] + (bits >> 1 & 1), cell[2] + (bits >> 2 & 1)});
      };
      const int low = diagonal, high = 7 - diagonal;
      const auto only = [&](char p, char q, char rest, bool inverse) {
        for (int bits = 0; bits < 8; ++bits) {
          const char expected = bits == low ? p : bits == high ? q : rest;
          if (inverse ? (corner(bits) == rest) != (expected == rest) : corner(bits) != expected) return false;
        }
        return true;
      };
      for (const char part : {'A', 'B'}) {
        int holding = 0;
        for (int bits = 0; bits < 8; ++bits) holding += corner(bits) == part;
        const bool both = corner(low) == part && corner(high) == part,
                   none = corner(low) != part && corner(high) != part;
        if ((both && holding == 2) || (none && holding == 6))
          sound_ = false;  // two corners of one part coincide
      }
      const bool a_is_low = only('A', 'B', '.', false);
      if (!a_is_low && !only('B', 'A', '.', false)) continue;
      Meeting meeting;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool low_is_above = (low >> axis & 1) != 0;
        meet(axis, cell[axis] + 1, low_is_above == a_is_low ? 1 : -1);
        meeting.axes.emplace_back(axis, cell[axis] + 1);
      }
      meeting.corners = {{cell[0] + 1, cell[1] + 1, cell[2] + 1}};
      meetings_.push_back(std::move(meeting));
    }
  });
}

}  // namespace lmdbench::parts
