// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/method_options.h>
#include <lmdbench/lmd/scene.h>

#include <memory>
#include <string_view>
#include <vector>

namespace lmdbench {

/// Names that `make_method` knows, in the order of reports.
const std::vector<std::string_view>& method_names();

/// @throws UsageError for an unknown name, listing the known ones
std::unique_ptr<Method> make_method(std::string_view name, const Scene& scene,
                                    const MethodOptions& options = {});

}  // namespace lmdbench
