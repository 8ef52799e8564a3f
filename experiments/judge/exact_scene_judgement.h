// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench::exact {

/// Exact judgement of one method's LMD sets along an experiment's path.
struct Judgement {
  std::string experiment;
  std::string method;
  std::int64_t frames = 0;  ///< Judged frames, from the path's first to its last one.
  std::int64_t exact = 0;   ///< Exact LMDs, summed over the frames.
  std::int64_t same_features = 0;
  std::int64_t same_contact = 0;  ///< Found as part of a plateau.
  std::int64_t uncertain = 0;     ///< Not found, but decided by rounding.
  std::int64_t missed = 0;
  std::int64_t found = 0;                  ///< Reported LMDs at a distance above 0.
  std::int64_t sharing = 0;                ///< Of these, sharing a plane (ExactAgreement::sharing).
  std::int64_t tolerated = 0;              ///< Of these, true only within first-order tolerance.
  std::int64_t untrue = 0;                 ///< Of these, true in no reading.
  std::int64_t touching = 0;               ///< Frames in which the meshes touch.
  std::int64_t wrong_contacts = 0;         ///< Frames where method and truth differ in that.
  std::vector<std::string> failures = {};  ///< Misses, untrue LMDs, wrong contacts.
};

/// Judges `exhaustive`, the truth of all reports, and `certified`, which promises the same set, in
/// evenly spread frames of an experiment.
std::vector<Judgement> judge_experiment(const std::filesystem::path& experiment_file,
                                        std::int64_t most_frames);

/// A table with a row for each experiment and method, and the meaning of its columns.
std::string judgement_table(const std::vector<Judgement>& judgements);

}  // namespace lmdbench::exact
