// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_reader.h>

#include <string>
#include <utility>
#include <vector>

namespace lmdbench {

/// Facts of /provenance/machine, name and value, sorted by name.
std::vector<std::pair<std::string, std::string>> machine_of(const ResultReader& file);

/// Why absolute times of two results cannot be compared: processor, caches, virtual machine, frequency settings that
/// differ. Each reason is a phrase with both values; empty where times can be compared.
std::vector<std::string> machine_differences(const ResultReader& a, const ResultReader& b);

/// What differs in how the two programs were built or what they ran on, without forbidding a comparison: compiler, flags,
/// libraries, kernel.
std::vector<std::string> build_differences(const ResultReader& a, const ResultReader& b);

}  // namespace lmdbench
