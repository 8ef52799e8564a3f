// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
// The compiled part of the Python module: meshes, searches, forces and agreement of numpy arrays.
// The users' interface is package/__init__.py; this part trusts its types, not its values.
#include <lmdbench/force/aggregation.h>
#include <lmdbench/lmd/agreement.h>
#include <lmdbench/lmdbench.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/python/arrays.h>
#include <lmdbench/python/errors.h>

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench::python {
namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;

/// Interval of checks for Python's signals (Ctrl-C) outside the interpreter.
constexpr std::chrono::milliseconds BETWEEN_LOOKS_AT_SIGNALS{50};

/// pybind11 would turn a bare Path into a list.
struct Poses {
  Path path;
};

/// The sets of some poses, in the search's memory, and the scene of their features.
struct Sets {
  std::vector<LmdSet> sets;
  std::vector<double> seconds;
  Scene scene;
  Path path;
};

/// A search that Python's threads can share: one waits for the other.
class Search {
 public:
  Search(const PreparedMesh& moving, const std::vector<PreparedMesh>& fixed, double cutoff,
         const std::string& method, const std::string& options)
      : search_(moving, fixed, cutoff, method, options), scene_{moving.body(), {}, cutoff} {
    for (const PreparedMesh& mesh : fixed) scene_.fixed.push_back(mesh.body());
  }

  /// Runs without the interpreter lock.
  std::shared_ptr<Sets> at(const Poses& poses) {
    const Path& path = poses.path;
    const std::lock_guard lock(mutex_);
    auto found = std::make_shared<Sets>();
    found->scene = scene_;
    found->path = path;
    found->sets.reserve(path.size());
    found->seconds.reserve(path.size());
    Clock::time_point looked = Clock::now();
    for (const TimedPose& timed : path) {
      const Clock::time_point begin = Clock::now();
      found->sets.push_back(search_.at(timed.pose));
      const Clock::time_point end = Clock::now();
      found->seconds.push_back(std::chrono::duration<double>(end - begin).count());
      if (end - looked < BETWEEN_LOOKS_AT_SIGNALS) continue;
      looked = end;
      const py::gil_scoped_acquire python;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    return found;
  }

 private:
  std::mutex mutex_;
  LmdSearch search_;
  Scene scene_;
};

py::tuple forces(const Sets& sets, const ForceProfile& profile, const Points& references) {
  validate_force_profile(profile);
  if (profile.cutoff > sets.scene.cutoff)
    throw UsageError("", "cutoff",
                     fmt::format("{} m is above that of the search, {} m", profile.cutoff, sets.scene.cutoff),
                     "search with the larger one");
  const std::size_t count = sets.sets.size();
  require_rows(references, count, "reference");
  std::vector<Vec3> force(count);
  std::vector<Vec3> torque(count);
  std::vector<double> stiffness(count);
  {
    const py::gil_scoped_release released;
    for (std::size_t i = 0; i < count; ++i) {
      const Wrench wrench = sum_forces(sets.sets[i], profile, references.row(i));
      force[i] = wrench.force;
      torque[i] = wrench.torque;
      stiffness[i] = wrench.stiffness;
    }
  }
  return py::make_tuple(array_of(std::move(force)), array_of(std::move(torque)),
                        array_of(std::move(stiffness)));
}

bool same_shapes(const Scene& a, const Scene& b) {
  const auto same = [](const Body& x, const Body& y) {
    const TriangleMesh &first = x.surface().mesh, &second = y.surface().mesh;
    return first.vertices == second.vertices && first.triangles == second.triangles;
  };
  return same(*a.moving, *b.moving) &&
         std::ranges::equal(a.fixed, b.fixed,
                            [&](const FixedBody& x, const FixedBody& y) { return same(*x, *y); });
}

/// To rounding: a quaternion may have been a matrix on its way.
bool same_pose(const TimedPose& a, const TimedPose& b) {
  constexpr double ROUNDING = 1e-14;
  const auto &p = a.pose.rotation.coeffs(), &q = b.pose.rotation.coeffs();
  return a.pose.translation == b.pose.translation && std::min((p - q).norm(), (p + q).norm()) <= ROUNDING;
}

/// (N, 4) counts: true, found, reported, right.
py::array agreements(const Sets& truth, const Sets& reported, bool neighbouring) {
  if (truth.sets.size() != reported.sets.size())
    throw UsageError("", "sets", fmt::format("{} poses against {}", truth.sets.size(), reported.sets.size()),
                     "search the same poses");
  if (!same_shapes(truth.scene, reported.scene))
    throw UsageError("", "sets", "are of different meshes", "search the same meshes");
  if (truth.scene.cutoff != reported.scene.cutoff)
    throw UsageError("", "sets",
                     fmt::format("are of cutoffs {} and {}", truth.scene.cutoff, reported.scene.cutoff),
                     "search with one cutoff");
  if (!std::ranges::equal(truth.path, reported.path, same_pose))
    throw UsageError("", "sets", "are of different poses", "search the same poses");
  std::vector<std::array<std::int64_t, 4>> rows(truth.sets.size());
  {
    const py::gil_scoped_release released;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Agreement found =
          agreement(truth.sets[i], reported.sets[i],
                    neighbouring ? Match::NEIGHBOURING_FEATURES : Match::SAME_FEATURES, truth.scene);
      rows[i] = {static_cast<std::int64_t>(found.true_lmds), static_cast<std::int64_t>(found.found),
                 static_cast<std::int64_t>(found.reported), static_cast<std::int64_t>(found.right)};
    }
  }
  return array_of(std::move(rows));
}

}  // namespace
}  // namespace lmdbench::python

PYBIND11_MODULE(_lmdbench, module) {
  namespace py = pybind11;
  using namespace lmdbench;
  using namespace lmdbench::python;
  using lmdbench::python::Search;

  register_errors(module);
  module.attr("__version__") = library_version();
  module.attr("LMD_DTYPE") = lmd_dtype();
  module.def("method_names", &method_names);

  py::class_<PreparedMesh>(module, "Mesh")
      .def_static(
          "from_file",
          [](const std::filesystem::path& file, const std::string& tolerance) {
            return PreparedMesh(file, tolerance);
          },
          py::arg("file"), py::arg("planar_tolerance"), py::call_guard<py::gil_scoped_release>())
      .def_static(
          "from_arrays",
          [](const py::array& vertices, const py::array& triangles, const std::string& tolerance,
             const std::string& name) {
            TriangleMesh mesh = mesh_of(vertices, triangles, name);
            const py::gil_scoped_release released;
            return PreparedMesh(std::move(mesh), tolerance, name);
          },
          py::arg("vertices"), py::arg("triangles"), py::arg("planar_tolerance"), py::arg("name"))
      .def_property_readonly(
          "vertices",
          [](const PreparedMesh& mesh) { return view_of(mesh.mesh().vertices, kept(mesh.body())); })
      .def_property_readonly(
          "triangles",
          [](const PreparedMesh& mesh) { return view_of(mesh.mesh().triangles, kept(mesh.body())); })
      .def_property_readonly("edges", [](const PreparedMesh& mesh) { return array_of(mesh.edges()); })
      .def_property_readonly("findings", &PreparedMesh::findings);

  py::class_<Poses>(module, "Poses")
      .def_static(
          "from_tum", [](const std::filesystem::path& file) { return Poses{read_tum(file)}; },
          py::arg("file"), py::call_guard<py::gil_scoped_release>())
      .def_static(
          "from_matrices", [](const py::array& matrices) { return Poses{poses_of(matrices)}; },
          py::arg("matrices"))
      .def("__len__", [](const Poses& poses) { return poses.path.size(); })
      .def_property_readonly("times", [](const Poses& poses) { return times_of(poses.path); })
      .def_property_readonly("matrices", [](const Poses& poses) { return matrices_of(poses.path); });

  py::class_<Sets, std::shared_ptr<Sets>>(module, "Sets")
      .def("__len__", [](const Sets& sets) { return sets.sets.size(); })
      .def(
          "array",
          [](const std::shared_ptr<Sets>& sets, std::size_t index) {
            if (index >= sets->sets.size()) throw py::index_error("no such pose");
            return lmds_view(sets->sets[index], kept(sets));
          },
          py::arg("index"))
      .def_property_readonly(
          "seconds", [](const std::shared_ptr<Sets>& sets) { return view_of(sets->seconds, kept(sets)); });

  py::class_<Search, std::shared_ptr<Search>>(module, "Search")
      .def(py::init<const PreparedMesh&, const std::vector<PreparedMesh>&, double, const std::string&,
                    const std::string&>(),
           py::arg("moving"), py::arg("fixed"), py::arg("cutoff"), py::arg("method"), py::arg("options"),
           py::call_guard<py::gil_scoped_release>())
      .def("at", &Search::at, py::arg("poses"), py::call_guard<py::gil_scoped_release>());

  module.def(
      "forces",
      [](const Sets& sets, const std::string& law, double cutoff, double saturation, double maximum,
         double sharpness, const py::array& references) {
        return forces(sets,
                      {.law = force_law_named(law, "", "law"),
                       .cutoff = cutoff,
                       .saturation_distance = saturation,
                       .maximum_force = maximum,
                       .sharpness = sharpness},
                      Points(references, "reference"));
      },
      py::arg("sets"), py::arg("law"), py::arg("cutoff"), py::arg("saturation_distance"),
      py::arg("maximum_force"), py::arg("sharpness"), py::arg("references"));
  module.def("agreements", &agreements, py::arg("truth"), py::arg("reported"), py::arg("neighbouring"));
}
