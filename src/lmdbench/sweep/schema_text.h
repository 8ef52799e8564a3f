// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lmdbench {

/// experiments/schema/sweep.schema.json as it was when the program was built.
const std::string& sweep_schema_text();

}  // namespace lmdbench
