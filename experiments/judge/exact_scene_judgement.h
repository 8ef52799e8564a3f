// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench::exact {

/// What exact arithmetic says of one method's LMD sets along an experiment's path.
struct Judgement {
  std::string experiment;
  std::string method;
  std::int64_t frames = 0;  ///< Judged, from the first frame of the path to the last one.
  std::int64_t exact = 0;   ///< Exact LMDs, summed over the frames.
  std::int64_t same_features = 0;
  std::int64_t same_contact = 0;  ///< Known as a part of a plateau.
  std::int64_t uncertain = 0;     ///< Unknown, but left to rounding.
  std::int64_t missed = 0;
  std::int64_t found = 0;  ///< Reported LMDs at a distance above 0.
  std::int64_t sharing =
      0;  ///< Of these, in one plane of contact with another one (ExactAgreement::sharing).
  std::int64_t tolerated = 0;       ///< Of these, true only within the tolerance of the first-order test.
  std::int64_t untrue = 0;          ///< Of these, true in no reading.
  std::int64_t touching = 0;        ///< Frames in which the meshes touch.
  std::int64_t wrong_contacts = 0;  ///< Frames in which method and truth differ in that.
  std::vector<std::string> failures = {};  ///< Whatever is missed, untrue or a wrong contact, in words.
};

/// Judges `exhaustive`, the truth of all reports, and `certified`, which promises to equal it, in evenly
/// spread frames of an experiment.
std::vector<Judgement> judge_experiment(const std::filesystem::path& experiment_file,
                                        std::int64_t most_frames);

/// A row an experiment and method, with what the columns mean.
std::string judgement_table(const std::vector<Judgement>& judgements);

}  // namespace lmdbench::exact
