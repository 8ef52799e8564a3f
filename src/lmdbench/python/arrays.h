// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>
#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/motion/path.h>

#include <pybind11/numpy.h>

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Between numpy's arrays and the library's types. Input is checked and copied once; output is a
/// read-only view of the library's own memory.
namespace lmdbench::python {

namespace py = pybind11;

/// An object that keeps `shared` alive, for arrays that view its memory.
template <class T>
py::capsule kept(const std::shared_ptr<T>& shared) {
  return py::capsule(new std::shared_ptr<T>(shared),
                     [](void* held) { delete static_cast<std::shared_ptr<T>*>(held); });
}

/// Makes an array read-only: only the library may write into its memory.
py::array read_only(py::array array);

/// One-dimensional view of numbers; (n, k) for rows of k numbers. `owner` keeps them alive.
template <class Row>
py::array view_of(const std::vector<Row>& rows, const py::object& owner) {
  const auto count = static_cast<py::ssize_t>(rows.size());
  if constexpr (std::is_arithmetic_v<Row>) {
    return read_only(py::array_t<Row>({count}, {static_cast<py::ssize_t>(sizeof(Row))}, rows.data(), owner));
  } else {
    using Number = std::remove_cvref_t<decltype(std::declval<Row>()[0])>;
    static_assert(sizeof(Row) % sizeof(Number) == 0);
    const Number* first = rows.empty() ? nullptr : &rows.front()[0];
    return read_only(py::array_t<Number>(
        {count, static_cast<py::ssize_t>(sizeof(Row) / sizeof(Number))},
        {static_cast<py::ssize_t>(sizeof(Row)), static_cast<py::ssize_t>(sizeof(Number))}, first, owner));
  }
}

/// The same of rows that the array owns.
template <class Row>
py::array array_of(std::vector<Row> rows) {
  const auto shared = std::make_shared<std::vector<Row>>(std::move(rows));
  return view_of(*shared, kept(shared));
}

/// Memory layout of an Lmd as a numpy type.
py::dtype lmd_dtype();
/// (n) structured view of a set.
py::array lmds_view(const LmdSet& lmds, const py::object& owner);

/// @param vertices  (V, 3) real numbers [m]
/// @param triangles (T, 3) whole numbers
/// @throws UsageError for another shape or kind; InputError for an index of no vertex
TriangleMesh mesh_of(const py::array& vertices, const py::array& triangles, const std::string& name);

/// @param matrices (N, 4, 4) or (4, 4) rigid transforms; times count the poses
/// @throws UsageError for another shape; InputError naming the pose that is not rigid
Path poses_of(const py::array& matrices);
py::array times_of(const Path& path);
/// (N, 4, 4)
py::array matrices_of(const Path& path);

/// Points (n, 3), or one (3) for all rows.
class Points {
 public:
  /// @throws UsageError for another shape, or a number that is not finite
  Points(const py::array& points, const std::string& name);
  Vec3 row(std::size_t index) const { return rows_[rows_.size() == 1 ? 0 : index]; }
  std::size_t size() const { return rows_.size(); }

 private:
  std::vector<Vec3> rows_;
};

/// @throws UsageError unless there is one row, or `count`
void require_rows(const Points& points, std::size_t count, const std::string& name);

}  // namespace lmdbench::python
