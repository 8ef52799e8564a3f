// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace lmdbench::python {

/// Adds the exceptions Error, UsageError, InputError and EnvironmentError to the module, each with the `exit_code` that the
/// program would leave with, and makes every error of the library one of them, with its text.
void register_errors(pybind11::module_& module);

}  // namespace lmdbench::python
