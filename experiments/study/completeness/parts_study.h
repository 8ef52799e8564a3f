// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/completeness/study.h>
#include <support/parts/parts_scenes.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lmdbench::completeness {

/// What is judged: every variant of `certified` against `exhaustive`, at `poses` poses of each kind of parts in each
/// kind of coordinates, rounded up to whole scenes.
struct PartsStudy {
  std::vector<std::string> kinds;  ///< Of `parts::parts_kinds`.
  std::vector<parts::Coordinates> coordinates;
  parts::PoseFamily family = parts::PoseFamily::ANY;
  std::size_t poses = 0;
  std::uint64_t seed = 1;
};

/// One kind in one kind of coordinates.
struct PartsResult {
  std::string kind;
  parts::Coordinates coordinates = parts::Coordinates::EXACT;
  std::size_t poses = 0, true_lmds = 0;
  std::size_t wrong_poses = 0;          ///< At which some variant is wrong.
  std::vector<Judgement> judgements;    ///< In the order of `variants()`.
  std::size_t poses_that_show_cut = 0;  ///< Of RECUT: `exhaustive` answers otherwise than for EXACT.
};

/// Whether two sets have the same contacts: pairs of the same kinds of features at the same distance and places, in any
/// order and under any numbers. Where triangles intersect there is no verdict, and they pass: pieces of an intersection,
/// and whether a neighbour just clear of it is one of them, depend on the cut.
/// @param scale distances and points may differ by 1e-9 of it [m]
bool same_contacts(const LmdSet& a, const LmdSet& b, double scale);

/// @param complain receives each wrong pose as a line for a test of `expect_right`, and what is wrong
PartsResult judge_parts(const PartsStudy& study, const std::string& kind, parts::Coordinates coordinates,
                        const Complain& complain);

/// A scene and pose as C++.
std::string test_line(const parts::PartsChoice& choice, const Pose& X_WM);

}  // namespace lmdbench::completeness
