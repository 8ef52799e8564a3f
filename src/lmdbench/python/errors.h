// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace lmdbench::python {

/// Adds the exceptions Error, UsageError, InputError and EnvironmentError to the module, each with
/// the program's `exit_code`, and translates the library's errors into them, with their text.
void register_errors(pybind11::module_& module);

}  // namespace lmdbench::python
