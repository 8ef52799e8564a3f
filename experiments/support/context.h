// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lmdbench::experiments {

/// Context of a stored result: program version, commit, compiler and flags, processor and load
/// ("build" and "machine").
nlohmann::json run_context();

}  // namespace lmdbench::experiments
