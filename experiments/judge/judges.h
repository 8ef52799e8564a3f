// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>

namespace CLI {
class App;
}

/// Each subcommand of lmdbench-judge has one file.
namespace lmdbench::exact {

/// The work of the chosen subcommand after the command line is read; returns the exit code.
using Run = std::function<int()>;

/// The methods that promise the set of the definition; flat and rest judge them.
inline constexpr std::array JUDGED_METHODS = {"exhaustive", "certified"};

/// Each adds its subcommand to `app`; naming it sets `chosen`, which must outlive the parsing.
void add_truth(CLI::App& app, Run& chosen);
void add_generated(CLI::App& app, Run& chosen);
void add_ledger(CLI::App& app, Run& chosen);
void add_flat(CLI::App& app, Run& chosen);
void add_rest(CLI::App& app, Run& chosen);
void add_accuracy(CLI::App& app, Run& chosen);

}  // namespace lmdbench::exact
