// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace lmdbench {

/// `lmdbench anatomy`: see commands.h.
void add_anatomy_command(CLI::App& app);

}  // namespace lmdbench
