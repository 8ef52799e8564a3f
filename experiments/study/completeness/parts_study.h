// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/completeness/study.h>
#include <support/parts/parts_scenes.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lmdbench::completeness {

/// Every variant of `certified` is judged against `exhaustive` at `poses` poses of each kind of
/// parts in each kind of coordinates, rounded up to whole scenes.
struct PartsStudy {
  std::vector<std::string> kinds;  ///< Of `parts::parts_kinds`.
  std::vector<parts::Coordinates> coordinates;
  parts::PoseFamily family = parts::PoseFamily::ANY;
  std::size_t poses = 0;
  std::uint64_t seed = 1;
};

/// Result of one kind in one kind of coordinates.
struct PartsResult {
  std::string kind;
  parts::Coordinates coordinates = parts::Coordinates::EXACT;
  std::size_t poses = 0, true_lmds = 0;
  std::size_t wrong_poses = 0;           ///< Poses at which some variant is wrong.
  std::vector<Judgement> judgements;     ///< In the order of `variants()`.
  std::size_t poses_that_show_cut = 0;   ///< Only RECUT: `exhaustive` differs from EXACT.
  std::size_t poses_beside = 0;          ///< Only RECUT: `same_contacts` leaves LMDs out.
  std::size_t of_these_at_a_border = 0;  ///< `is_at_a_border` of either cut.
};

/// Whether two sets have the same contacts: the same kinds of features, distances, directions and
/// places in any order. Without what intersects: the cut decides what that consists of. Beside
/// intersections without LMDs of a few roundings, too: they may belong to them.
/// @param beside receives whether such LMDs were left out
bool same_contacts(const LmdSet& a, const LmdSet& b, double scale, bool* beside = nullptr);

/// Whether the set at a pose is another one (by twice the places of `same_contacts`) after one of
/// twelve moves and turns as small as the tolerance of the definition, along and about each axis:
/// it hangs on what is as narrow, as level or as far as the tolerance, which rounding may decide.
/// Or whether rounding alone moves a place by a quarter of that, when all lengths are divided by an
/// odd number: the middle of a face of 3e-9 m by 1 m is known to some 1e-9 m.
/// @param scale  the parts' extent [m]; a turn moves no point by more than the tolerance of it
bool is_at_a_border(const Scene& scene, const Pose& X_WM, double scale);

/// @param complain receives each wrong pose as a line for a test (`expect_right`), and the errors
PartsResult judge_parts(const PartsStudy& study, const std::string& kind, parts::Coordinates coordinates,
                        const Complain& complain);

/// A scene and pose as a line of C++.
std::string test_line(const parts::PartsChoice& choice, const Pose& X_WM);

}  // namespace lmdbench::completeness
