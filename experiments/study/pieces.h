// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/studies.h>

#include <string>
#include <vector>

/// Studies that other processes do piece by piece: scripts/cluster/ runs the pieces and puts their reports together.
namespace lmdbench::study {

using Arguments = std::vector<std::string>;

/// An option that may be repeated, and the values that the whole study goes through.
struct Split {
  std::string option;
  std::vector<std::string> values;
};

/// The command and its options as they were given, each as one argument, but for some of them and for --json.
Arguments arguments_without(const CLI::App& command, const std::vector<std::string>& options);

/// A piece for each combination of values, the last option fastest.
std::vector<Arguments> pieces_by(const CLI::App& command, const std::vector<Split>& splits);

/// Numbers so that reading them again gives the same bits.
std::vector<std::string> texts(const std::vector<double>& values);

/// JSON array of the chosen subcommand's pieces; of the whole command line where it does not fall into any.
std::string pieces_json(const CLI::App& app, const Run& chosen);

}  // namespace lmdbench::study
