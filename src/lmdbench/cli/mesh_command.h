// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace lmdbench {

/// `lmdbench mesh info MESH... [--json]` and `lmdbench mesh build [NAME...] [--json]`.
void add_mesh_command(CLI::App& app);

}  // namespace lmdbench
