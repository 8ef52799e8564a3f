// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/geometry/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// The disagreement ledger: for a cross-checked frame whose answers for the minimum distance
/// differ, exact arithmetic tells which one is wrong and by how much.
namespace lmdbench::exact {

/// One answer for a frame.
struct Opinion {
  std::string who;              ///< Method, "lmdbench" (exact form), "fcl" or "fcl-unscaled".
  double distance = 0.0;        ///< metres; infinite where a method found no pair
  double relative_error = 0.0;  ///< |distance - truth| / truth; infinite if false or missed
  bool wrong = false;
};

/// A triangle pair of a disputed frame, which pastes into a test.
struct JudgedPair {
  std::string why;  ///< "nearest", or whose pair it is: "fcl", "fcl-unscaled"
  std::int32_t fixed_body = 0;
  std::int32_t triangle_moving = -1, triangle_fixed = -1;
  Triangle moving_M;          ///< In the moving mesh's frame [m].
  Triangle fixed_W;           ///< In the world [m].
  double exact = 0.0;         ///< Exact distance, rounded once [m].
  double fcl = 0.0;           ///< By FCL's kernel, scaled as in the probe [m].
  double fcl_unscaled = 0.0;  ///< The same with the meshes as they are.
};

/// A frame whose answers differ.
struct LedgerRow {
  std::int64_t frame = 0;
  Pose pose;           ///< X_WM
  double truth = 0.0;  ///< Exact minimum distance, rounded once [m]; 0 in contact.
  /// The exact nearest pair, then those that FCL names where it is wrong.
  std::vector<JudgedPair> pairs;
  std::vector<Opinion> opinions;
};

/// All arbitrated frames of a result.
struct Ledger {
  std::string experiment;
  std::int64_t frames = 0;         ///< Cross-checked frames.
  std::int64_t disagreements = 0;  ///< Rows that fcl, lmdbench or methods cause.
  double tolerance = 0.0;          ///< Relative.
  double scale = 1.0;              ///< Factor of the meshes in the probe's calls of FCL.
  std::vector<LedgerRow> rows;     ///< Frames in which any two differ, "fcl-unscaled" included.
};

/// Reads a result with an FCL cross-check, loads its scene, arbitrates frames with differing
/// answers.
/// @param experiment_file  its folder is the base of relative names in the result
/// @throws InputError when the result has no cross-check or does not fit the meshes and path found
Ledger arbitrate(const std::filesystem::path& result, const std::filesystem::path& experiment_file);

/// The experiment file that a result's command line names, or an empty path.
std::filesystem::path experiment_file_of(const std::filesystem::path& result);

/// A table with a row a run: whose answers were wrong in how many frames and by how much; then the
/// worst row of each party and kind of error, which pastes into a test.
std::string ledger_markdown(const std::vector<Ledger>& ledgers);

/// All rows; numbers have 17 digits and read back to the same bits.
std::string ledger_json(const Ledger& ledger);

}  // namespace lmdbench::exact
