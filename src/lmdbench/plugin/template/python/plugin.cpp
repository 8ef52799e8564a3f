// SPDX-License-Identifier: 0BSD
// Carries poses and contacts to method.py and back; change only the description at the end.
#include "lmdbench_method.h"
#include <dlfcn.h>
#include <pybind11/embed.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <cstdio>

namespace py = pybind11;

namespace {

void start_python() {
  static const bool started = [] {
    // Modules written in C look up the interpreter's functions globally.
    dlopen(LIBPYTHON, RTLD_NOW | RTLD_GLOBAL);
    PyConfig config;
    PyConfig_InitPythonConfig(&config);
    config.install_signal_handlers = 0;
    PyConfig_SetBytesString(&config, &config.program_name, PYTHON);  // finds the modules
    Py_InitializeFromConfig(&config);
    PyConfig_Clear(&config);
    py::module_::import("sys").attr("path").attr("insert")(0, FOLDER);
    PyEval_SaveThread();
    return true;
  }();
  static_cast<void>(started);
}

template <class Number>
py::array_t<Number> rows(const Number* data, uint64_t count, int columns) {
  return py::array_t<Number>({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(columns)},
                             data);  // a copy
}

int32_t create(const lmdbench_mesh* a, const lmdbench_mesh* b, double cutoff, const char* options,
               void** instance, char* message, uint64_t message_size) {
  start_python();
  const py::gil_scoped_acquire lock;
  try {
    py::object method = py::module_::import("method").attr("Method")(
        rows(a->vertices, a->vertex_count, 3), rows(a->triangles, a->triangle_count, 3),
        rows(b->vertices, b->vertex_count, 3), rows(b->triangles, b->triangle_count, 3), cutoff,
        py::module_::import("json").attr("loads")(options));
    *instance = new py::object(std::move(method));
    return 0;
  } catch (const std::exception& error) {
    std::snprintf(message, message_size, "%s", error.what());
    return 1;
  }
}

int32_t search(void* instance, const double* X_BA, lmdbench_contact* contacts, uint64_t capacity,
               uint64_t* needed) {
  const py::gil_scoped_acquire lock;
  try {
    using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
    using Integers = py::array_t<int32_t, py::array::c_style | py::array::forcecast>;
    const py::tuple found = static_cast<py::object*>(instance)->attr("search")(rows(X_BA, 3, 4));
    const Doubles points_a(found[0]), points_b(found[1]);
    const Integers triangles(found[2]);
    *needed = static_cast<uint64_t>(triangles.size() / 2);
    for (uint64_t i = 0; i < std::min(capacity, *needed); ++i) {
      std::copy_n(points_a.data() + 3 * i, 3, contacts[i].point_a);
      std::copy_n(points_b.data() + 3 * i, 3, contacts[i].point_b);
      contacts[i].triangle_a = triangles.data()[2 * i];
      contacts[i].triangle_b = triangles.data()[2 * i + 1];
      contacts[i].part_a = contacts[i].part_b = LMDBENCH_PART_UNKNOWN;
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

void destroy(void* instance) {
  const py::gil_scoped_acquire lock;
  delete static_cast<py::object*>(instance);
}

const lmdbench_method METHOD = {
    sizeof(lmdbench_method),
    "METHOD_NAME",
    "0.1",
    "each vertex of the moving mesh with the nearest vertex of the fixed one, by numpy",
    LMDBENCH_PROMISE_APPROXIMATION,
    0,
    nullptr,
    create,
    search,
    destroy,
    nullptr};

const lmdbench_method* get(uint32_t index) {
  return index == 0 ? &METHOD : nullptr;
}

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = {
    LMDBENCH_METHOD_ABI_MAJOR, LMDBENCH_METHOD_ABI_MINOR, sizeof(lmdbench_method_entry_type), get};
