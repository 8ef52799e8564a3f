// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lmdbench {

/// experiments/schema/experiment.schema.json as it was when the program was built: without the methods'
/// options, see `experiment_schema`.
const std::string& experiment_schema_text();

}  // namespace lmdbench
