// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lmdbench::experiments {

/// What a stored result needs beside its numbers: program version, commit, compiler and flags, processor and
/// load ("build" and "machine").
nlohmann::json run_context();

}  // namespace lmdbench::experiments
