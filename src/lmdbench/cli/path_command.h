// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace lmdbench {

/// `lmdbench path generate SPEC.json --out FILE.tum [--json]` and
/// `lmdbench path info FILE.tum [--spec SPEC.json] [--rate HZ] [--json]`.
void add_path_command(CLI::App& app);

}  // namespace lmdbench
