// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

namespace lmdbench {

/// The JSON Schema (draft 07) of experiment files: experiments/schema/experiment.schema.json, with the names
/// and options of the methods of this build.
const nlohmann::json& experiment_schema();

}  // namespace lmdbench
