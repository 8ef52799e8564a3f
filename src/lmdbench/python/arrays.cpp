// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/python/arrays.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace lmdbench::python {
namespace {

using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

std::string shape_text(const py::array& array) {
  return fmt::format("({})",
                     fmt::join(std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()), ", "));
}

[[noreturn]] void refuse(const std::string& name, const py::array& array, const std::string& wanted) {
  throw UsageError("", name,
                   fmt::format("has shape {} and type {}", shape_text(array),
                               py::cast<std::string>(py::str(array.dtype()))),
                   fmt::format("give {}", wanted));
}

/// Whether the array's numpy kind is among these letters: b, i, u, f, c, ...
bool holds(const py::array& array, std::string_view kinds) {
  return kinds.find(array.dtype().kind()) != std::string_view::npos;
}

std::vector<Vec3> rows_of_three(const py::array& array, const std::string& name, const std::string& wanted) {
  if (array.ndim() != 2 || array.shape(1) != 3 || !holds(array, "fiu")) refuse(name, array, wanted);
  const Reals numbers(array);
  std::vector<Vec3> rows(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = Eigen::Map<const Vec3>(numbers.data() + 3 * i);
  return rows;
}

TimedPose pose_of(const double* numbers, std::size_t index) {
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor, Eigen::Unaligned> matrix(numbers);
  const Mat3 rotation = matrix.topLeftCorner<3, 3>();
  const auto refuse_pose = [index](const std::string& problem) {
    throw InputError("", fmt::format("pose {}", index), problem,
                     "give rigid transforms of column vectors: [[R, t], [0 0 0 1]], R R^T = I, det R = 1");
  };
  if (!matrix.allFinite()) refuse_pose("holds a number that is not finite");
  if (matrix.cwiseAbs().maxCoeff() > LARGEST_COORDINATE)
    refuse_pose(fmt::format("is farther than {:g} m", LARGEST_COORDINATE));
  if (matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
    refuse_pose("ends in another row than 0 0 0 1");
  const double off = (rotation * rotation.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (off > QUATERNION_LENGTH_TOLERANCE || rotation.determinant() <= 0.0)
    refuse_pose("turns by a matrix that is no rotation");
  return {static_cast<double>(index),
          {matrix.topRightCorner<3, 1>(), Eigen::Quaterniond(rotation).normalized()}};
}

}  // namespace

py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

namespace {

py::dtype make_lmd_dtype() {
  static const Lmd SAMPLE;
  py::list names;
  py::list formats;
  py::list offsets;
  const auto field = [&](const char* name, const py::object& format, const void* member) {
    names.append(name);
    formats.append(format);
    offsets.append(static_cast<const char*>(member) - reinterpret_cast<const char*>(&SAMPLE));
  };
  static const FeatureId FEATURE;
  py::list feature_offsets;
  feature_offsets.append(0);
  feature_offsets.append(reinterpret_cast<const char*>(&FEATURE.index) -
                         reinterpret_cast<const char*>(&FEATURE));
  py::list feature_names;
  py::list feature_formats;
  for (const auto& [name, format] : {std::pair{"kind", "u1"}, std::pair{"index", "i4"}}) {
    feature_names.append(name);
    feature_formats.append(format);
  }
  const py::dtype feature(feature_names, feature_formats, feature_offsets, sizeof(FeatureId));
  const py::str point("3f8");
  field("distance", py::str("f8"), &SAMPLE.distance);
  field("point_moving", point, &SAMPLE.point_moving);
  field("point_fixed", point, &SAMPLE.point_fixed);
  field("direction", point, &SAMPLE.direction);
  field("feature_moving", feature, &SAMPLE.feature_moving);
  field("feature_fixed", feature, &SAMPLE.feature_fixed);
  field("fixed_body", py::str("i4"), &SAMPLE.fixed_body);
  field("intersecting", py::str("?"), &SAMPLE.intersecting);
  return {names, formats, offsets, sizeof(Lmd)};
}

}  // namespace

py::dtype lmd_dtype() {
  // Never freed: its destructor would run after the interpreter's end.
  static const auto* const DTYPE = new py::dtype(make_lmd_dtype());
  return *DTYPE;
}

py::array lmds_view(const LmdSet& lmds, const py::object& owner) {
  static_assert(sizeof(FeatureKind) == 1 && sizeof(bool) == 1);
  return read_only(py::array(lmd_dtype(), {static_cast<py::ssize_t>(lmds.size())},
                             {static_cast<py::ssize_t>(sizeof(Lmd))}, lmds.data(), owner));
}

TriangleMesh mesh_of(const py::array& vertices, const py::array& triangles, const std::string& name) {
  TriangleMesh mesh;
  mesh.vertices = rows_of_three(vertices, name + ": vertices", "(V, 3) real numbers, metres");
  if (triangles.ndim() != 2 || triangles.shape(1) != 3 || !holds(triangles, "iu"))
    refuse(name + ": triangles", triangles, "(T, 3) whole numbers, vertices counted from 0");
  const Integers corners(triangles);
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  mesh.triangles.resize(static_cast<std::size_t>(triangles.shape(0)));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t corner = corners.data()[3 * t + k];
      if (corner < 0 || corner >= count)
        throw InputError(name, fmt::format("triangle {}", t),
                         fmt::format("names vertex {} of {}", corner, count),
                         "vertices count from 0 in the order of the array");
      mesh.triangles[t][k] = static_cast<std::int32_t>(corner);
    }
  return mesh;
}

Path poses_of(const py::array& matrices) {
  const py::ssize_t dimensions = matrices.ndim();
  if ((dimensions != 2 && dimensions != 3) || !holds(matrices, "fiu") ||
      matrices.shape(dimensions - 1) != 4 || matrices.shape(dimensions - 2) != 4)
    refuse("poses", matrices, "(N, 4, 4) real numbers, or the name of a TUM file");
  const Reals numbers(matrices);
  Path path(static_cast<std::size_t>(numbers.size() / 16));
  for (std::size_t i = 0; i < path.size(); ++i) path[i] = pose_of(numbers.data() + 16 * i, i);
  return path;
}

py::array times_of(const Path& path) {
  std::vector<double> times;
  times.reserve(path.size());
  for (const TimedPose& timed : path) times.push_back(timed.time);
  return array_of(std::move(times));
}

py::array matrices_of(const Path& path) {
  py::array_t<double> matrices({static_cast<py::ssize_t>(path.size()), py::ssize_t{4}, py::ssize_t{4}});
  auto numbers = matrices.mutable_unchecked<3>();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const RigidTransform transform(path[i].pose);
    const auto n = static_cast<py::ssize_t>(i);
    for (py::ssize_t row = 0; row < 3; ++row) {
      for (py::ssize_t column = 0; column < 3; ++column)
        numbers(n, row, column) = transform.rotation(row, column);
      numbers(n, row, 3) = transform.translation[row];
      numbers(n, 3, row) = 0.0;
    }
    numbers(n, 3, 3) = 1.0;
  }
  return matrices;
}

Points::Points(const py::array& points, const std::string& name) {
  const std::string wanted = "(3) or (N, 3) real numbers, metres";
  rows_ = rows_of_three(points.ndim() == 1 ? points.attr("reshape")(1, -1).cast<py::array>() : points, name,
                        wanted);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (!rows_[i].allFinite())
      throw UsageError("", name, fmt::format("row {} is not finite", i), "give metres");
}

void require_rows(const Points& points, std::size_t count, const std::string& name) {
  if (points.size() != 1 && points.size() != count)
    throw UsageError("", name, fmt::format("has {} rows for {} poses", points.size(), count),
                     "give one row, or one a pose");
}

}  // namespace lmdbench::python
