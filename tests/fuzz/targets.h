// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Promises of every reader, for any bytes; for fuzzers and the test of tests/fuzz/corpus/NAME. A
/// reader takes the bytes, or refuses them by an error with file and remedy in printable text. A
/// value has the invariants of its type and reads back the same if it can be written.
/// @return nothing if refused, empty if good, or the broken promise
namespace lmdbench::testing {

std::optional<std::string> broken_off(std::string_view bytes);
std::optional<std::string> broken_ply(std::string_view bytes);
std::optional<std::string> broken_obj(std::string_view bytes);
/// The first byte chooses PLY, OBJ, STL, glTF or GLB. Uses the real child process, with limits that
/// keep a fuzzer going.
std::optional<std::string> broken_import(std::string_view bytes);
std::optional<std::string> broken_manifest(std::string_view bytes);
std::optional<std::string> broken_tum(std::string_view bytes);
std::optional<std::string> broken_path(std::string_view bytes);
/// HDF5 itself may crash on damaged files: only the child that first looks at the file may crash.
std::optional<std::string> broken_result(std::string_view bytes);
std::optional<std::string> broken_experiment(std::string_view bytes);
std::optional<std::string> broken_sweep(std::string_view bytes);
/// Lines that are no entries of a journal are ignored.
std::optional<std::string> broken_journal(std::string_view bytes);

}  // namespace lmdbench::testing
