// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/studies.h>

#include <string>
#include <vector>

/// Studies in pieces: scripts/cluster/ runs the pieces elsewhere and joins their reports.
namespace lmdbench::study {

using Arguments = std::vector<std::string>;

/// An option that may be repeated, and its values in the whole study.
struct Split {
  std::string option;
  std::vector<std::string> values;
};

/// The command and its options as given, one argument each, without `options` and --json.
Arguments arguments_without(const CLI::App& command, const std::vector<std::string>& options);

/// A piece for each combination of values; the last option varies fastest.
std::vector<Arguments> pieces_by(const CLI::App& command, const std::vector<Split>& splits);

/// Numbers as texts that are read back to the same bits.
std::vector<std::string> texts(const std::vector<double>& values);

/// JSON array of the chosen subcommand's pieces; the whole command line where it has none.
std::string pieces_json(const CLI::App& app, const Run& chosen);

}  // namespace lmdbench::study
