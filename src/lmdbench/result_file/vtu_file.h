// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// Files of the Visualization Toolkit's XML formats for ParaView: unstructured grids (.vtu) and
/// their collections over time (.pvd). Numbers are text: any XML reader reads them, in any byte
/// order. Format: "VTK File Formats", docs.vtk.org.
namespace lmdbench {

/// VTK's numbers of the cell types in use.
enum class VtuCell : std::uint8_t { VERTEX = 1, POLYLINE = 4, TRIANGLE = 5 };

/// A named value at every point or of every cell.
struct VtuArray {
  std::string name;            ///< With its unit: "distance [m]".
  std::size_t components = 1;  ///< 1, or 3 for a vector.
  std::vector<double>
      values;  ///< components times the number of points or cells; finite: no NaN in the format.
};

/// Points and cells of one kind.
struct VtuGrid {
  std::vector<Vec3> points;
  VtuCell cell = VtuCell::VERTEX;
  std::vector<std::int32_t> corners;  ///< Indices of points, cell after cell.
  std::vector<std::int32_t> ends;     ///< Of every cell the number of corners to its end.
  std::vector<VtuArray> point_data;
  std::vector<VtuArray> cell_data;

  /// Appends a cell with points of its own.
  void add(const std::vector<Vec3>& cell_points);
};

/// @throws std::logic_error for arrays of another length and for values that are not finite
std::string vtu_text(const VtuGrid& grid);

/// @param files time [s] and name of a file, relative to the collection
std::string pvd_text(const std::vector<std::pair<double, std::string>>& files);

}  // namespace lmdbench
