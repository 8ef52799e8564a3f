// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace CLI {
class App;
}

namespace lmdbench {

/// Calls that show the use of a command, as typed in the source tree.
struct CommandExamples {
  std::string_view command;  ///< "run", "mesh build"; empty: the program itself.
  std::array<std::string_view, 2> calls;
};

std::span<const CommandExamples> command_examples();

/// Ends the help of each command with its examples.
void add_examples(CLI::App& app);

}  // namespace lmdbench
