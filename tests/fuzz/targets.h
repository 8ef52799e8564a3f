// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

/// What every reader of files keeps to, whatever the bytes: for the fuzzers and for the test that replays their
/// corpora (tests/fuzz/corpus/NAME). Bytes are taken, or refused by an error of the input that names the file and a remedy in
/// printable text; what is taken holds what its type promises and, where it can be written, reads back the same.
/// Each returns nothing where the bytes were refused, an empty text where they were taken, or the promise that was broken.
namespace lmdbench::testing {

std::optional<std::string> broken_off(std::string_view bytes);
std::optional<std::string> broken_ply(std::string_view bytes);
std::optional<std::string> broken_obj(std::string_view bytes);
/// The first byte chooses PLY, OBJ, STL, glTF or GLB. Through the real child process, with limits that keep a fuzzer
/// going.
std::optional<std::string> broken_import(std::string_view bytes);
std::optional<std::string> broken_manifest(std::string_view bytes);
std::optional<std::string> broken_tum(std::string_view bytes);
std::optional<std::string> broken_path(std::string_view bytes);
/// HDF5 itself may crash on damaged files: that must stay in the child that looks at the file first.
std::optional<std::string> broken_result(std::string_view bytes);
std::optional<std::string> broken_experiment(std::string_view bytes);
std::optional<std::string> broken_sweep(std::string_view bytes);
/// What is no line of a journal is left out.
std::optional<std::string> broken_journal(std::string_view bytes);

}  // namespace lmdbench::testing
