// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result_file/vtu_file.h>

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string_view>

namespace lmdbench {
namespace {

constexpr std::string_view HEAD =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\">\n";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

template <class Number>
void add_array(std::string& text, std::string_view type, std::string_view name, std::size_t components,
               std::span<const Number> values) {
  auto out = std::back_inserter(text);
  fmt::format_to(out, "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n",
                 type, escaped(name), components);
  for (std::size_t i = 0; i < values.size(); ++i)
    fmt::format_to(out, "{}{}", values[i], (i + 1) % (4 * components) == 0 ? '\n' : ' ');
  text += "\n</DataArray>\n";
}

void add_data(std::string& text, std::string_view element, const std::vector<VtuArray>& arrays,
              std::size_t count) {
  fmt::format_to(std::back_inserter(text), "<{}>\n", element);
  for (const VtuArray& array : arrays) {
    if (array.values.size() != count * array.components)
      throw std::logic_error("vtu: array '" + array.name + "' has not one value a point or cell");
    for (const double value : array.values)
      if (!std::isfinite(value)) throw std::logic_error("vtu: array '" + array.name + "' is not finite");
    add_array<double>(text, "Float64", array.name, array.components, array.values);
  }
  fmt::format_to(std::back_inserter(text), "</{}>\n", element);
}

}  // namespace

void VtuGrid::add(const std::vector<Vec3>& cell_points) {
  for (const Vec3& p : cell_points) {
    corners.push_back(static_cast<std::int32_t>(points.size()));
    points.push_back(p);
  }
  ends.push_back(static_cast<std::int32_t>(corners.size()));
}

std::string vtu_text(const VtuGrid& grid) {
  std::string text = fmt::format(fmt::runtime(HEAD), "UnstructuredGrid");
  fmt::format_to(std::back_inserter(text),
                 "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
                 grid.points.size(), grid.ends.size());
  std::vector<double> coordinates;
  coordinates.reserve(3 * grid.points.size());
  for (const Vec3& p : grid.points) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  // Far from the origin single precision would be wider than a mesh.
  add_array<double>(text, "Float64", "points", 3, coordinates);
  text += "</Points>\n<Cells>\n";
  add_array<std::int32_t>(text, "Int32", "connectivity", 1, grid.corners);
  add_array<std::int32_t>(text, "Int32", "offsets", 1, grid.ends);
  add_array<std::int32_t>(text, "UInt8", "types", 1,
                          std::vector<std::int32_t>(grid.ends.size(), static_cast<std::int32_t>(grid.cell)));
  text += "</Cells>\n";
  add_data(text, "PointData", grid.point_data, grid.points.size());
  add_data(text, "CellData", grid.cell_data, grid.ends.size());
  return text + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string pvd_text(const std::vector<std::pair<double, std::string>>& files) {
  std::string text = fmt::format(fmt::runtime(HEAD), "Collection") + "<Collection>\n";
  for (const auto& [time, file] : files)
    fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time,
                   escaped(file));
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace lmdbench
