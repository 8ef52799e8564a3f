// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/geometry/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// The disagreement ledger: where those who answered a cross-checked frame's minimum distance differ, exact
/// arithmetic says who was wrong and by how much.
namespace lmdbench::exact {

/// One opinion on a frame.
struct Opinion {
  std::string who;        ///< A method's label, "lmdbench" (exact-form nearest pair), "fcl", "fcl-unscaled".
  double distance = 0.0;  ///< metres; infinite where a method found no pair
  double relative_error =
      0.0;  ///< |distance - truth| / truth; infinite for a contact that is none or a missed pair
  bool wrong = false;
};

/// A triangle pair of a disputed frame, as it pastes into a test.
struct JudgedPair {
  std::string why;  ///< "nearest", or who named it: "fcl", "fcl-unscaled"
  std::int32_t fixed_body = 0;
  std::int32_t triangle_moving = -1, triangle_fixed = -1;
  Triangle moving_M;          ///< In the moving mesh's frame [m].
  Triangle fixed_W;           ///< In the world [m].
  double exact = 0.0;         ///< Exact distance, rounded once [m].
  double fcl = 0.0;           ///< What FCL's kernel answers within the probe's query, scaled as there [m].
  double fcl_unscaled = 0.0;  ///< The same with the meshes as they are.
};

/// A frame whose opinions differ.
struct LedgerRow {
  std::int64_t frame = 0;
  Pose pose;           ///< X_WM
  double truth = 0.0;  ///< Exact minimum distance, rounded once [m]; 0 in contact.
  /// The exact nearest pair, then those that FCL names where it is wrong.
  std::vector<JudgedPair> pairs;
  std::vector<Opinion> opinions;
};

/// What one party answered over all arbitrated frames.
struct Ledger {
  std::string experiment;
  std::int64_t frames = 0;  ///< Cross-checked.
  std::int64_t disagreements =
      0;                        ///< Rows of which fcl, lmdbench and the methods make up; all are arbitrated.
  double tolerance = 0.0;       ///< Relative.
  double scale = 1.0;           ///< Of the meshes as the probe hands them to FCL.
  std::vector<LedgerRow> rows;  ///< Frames in which any two differ, fcl-unscaled among them.
};

/// Reads a result with an FCL cross-check, loads its scene again and arbitrates every
/// frame in which opinions differ.
/// @param experiment_file  the experiment's file: relative names in the result are relative to its folder
/// @throws InputError when the result has no cross-check or does not fit the meshes and path found
Ledger arbitrate(const std::filesystem::path& result, const std::filesystem::path& experiment_file);

/// The experiment file that a result's command line names, or an empty path.
std::filesystem::path experiment_file_of(const std::filesystem::path& result);

/// A table with a row a run: who was wrong in how many frames and by how much; then the worst row of each
/// party and kind of error, as a test to paste.
std::string ledger_markdown(const std::vector<Ledger>& ledgers);

/// All rows; numbers have 17 digits and read back to the same bits.
std::string ledger_json(const Ledger& ledger);

}  // namespace lmdbench::exact
