// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>

namespace CLI {
class App;
}

/// One file a subcommand of lmdbench-judge.
namespace lmdbench::exact {

/// What the chosen subcommand does once the command line is read; it returns the exit code.
using Run = std::function<int()>;

/// The methods that promise the set of the definition, which flat and rest judge.
inline constexpr std::array JUDGED_METHODS = {"exhaustive", "certified"};

/// Each adds its subcommand to `app`, which sets `chosen` when it is named; `chosen` must outlive the parsing.
void add_truth(CLI::App& app, Run& chosen);
void add_ledger(CLI::App& app, Run& chosen);
void add_flat(CLI::App& app, Run& chosen);
void add_rest(CLI::App& app, Run& chosen);
void add_accuracy(CLI::App& app, Run& chosen);

}  // namespace lmdbench::exact
