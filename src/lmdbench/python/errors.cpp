// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/python/errors.h>

#include <exception>
#include <string>
#include <utility>

namespace lmdbench::python {
namespace {

namespace py = pybind11;

/// The classes live as long as the interpreter: exceptions may come as late as its end.
PyObject* usage_error = nullptr;
PyObject* input_error = nullptr;
PyObject* environment_error = nullptr;
PyObject* any_error = nullptr;

PyObject* make_class(py::module_& module, const char* name, const char* meaning, const py::tuple& bases,
                     ExitCode code) {
  py::dict members;
  members["exit_code"] = static_cast<int>(code);
  PyObject* made = PyErr_NewExceptionWithDoc((std::string("lmdbench.") + name).c_str(), meaning, bases.ptr(),
                                             members.ptr());
  if (made == nullptr) throw py::error_already_set();
  module.attr(name) = py::reinterpret_borrow<py::object>(made);
  return made;
}

PyObject* class_for(ExitCode code) {
  switch (code) {
    case ExitCode::USAGE:
      return usage_error;
    case ExitCode::INPUT_DATA:
      return input_error;
    case ExitCode::ENVIRONMENT:
      return environment_error;
    default:
      return any_error;
  }
}

}  // namespace

void register_errors(py::module_& module) {
  const auto value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
  any_error =
      make_class(module, "Error", "What lmdbench refuses; its text names file, place and remedy.",
                 py::make_tuple(py::reinterpret_borrow<py::object>(PyExc_RuntimeError)), ExitCode::INTERNAL);
  const auto base = py::reinterpret_borrow<py::object>(any_error);
  usage_error = make_class(module, "UsageError", "An argument is wrong (exit code 2 of the program).",
                           py::make_tuple(base, value_error), ExitCode::USAGE);
  input_error =
      make_class(module, "InputError", "A mesh, path or result file is wrong (exit code 3 of the program).",
                 py::make_tuple(base, value_error), ExitCode::INPUT_DATA);
  environment_error = make_class(module, "EnvironmentError",
                                 "The system or this build lacks something (exit code 4 of the program).",
                                 py::make_tuple(base), ExitCode::ENVIRONMENT);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const lmdbench::Error& error) {
      PyErr_SetString(class_for(error.code()), error.what());
    }
  });
}

}  // namespace lmdbench::python
