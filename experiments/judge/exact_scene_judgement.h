// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lmdbench::exact {

/// Exact judgement of one method's LMD sets along an experiment's path or at generated poses.
struct Judgement {
  std::string scene;  ///< Name of the experiment or kind.
  std::string method;
  std::int64_t frames = 0;    ///< Judged frames, from the path's first to its last one.
  std::int64_t exact = 0;     ///< Exact LMDs, summed over the frames.
  std::int64_t certain = 0;   ///< Of these, those asked for.
  std::int64_t required = 0;  ///< Reported LMDs without which a certain one would be missed.
  std::int64_t same_features = 0;
  std::int64_t same_contact = 0;  ///< Found as part of a plateau.
  std::int64_t uncertain = 0;     ///< Not found, but decided by rounding.
  std::int64_t missed = 0;
  std::int64_t found = 0;                  ///< Reported LMDs at a distance above 0.
  std::int64_t sharing = 0;                ///< Of these, sharing a plane (ExactAgreement::sharing).
  std::int64_t doubled = 0;                ///< Of these, beside another one of the same contact.
  std::int64_t tolerated = 0;              ///< Of these, true only within first-order tolerance.
  std::int64_t untrue = 0;                 ///< Of these, true in no reading.
  std::int64_t misplaced = 0;              ///< Of these, with a point off its feature.
  std::int64_t touching = 0;               ///< Frames in which the meshes touch.
  std::int64_t wrong_contacts = 0;         ///< Frames where method and truth differ in that.
  std::int64_t wrong_frames = 0;           ///< Frames with any failure.
  std::vector<std::string> failures = {};  ///< All that is wrong.
};

/// The methods that promise the complete set: `exhaustive`, the truth of all reports, and
/// `certified`.
std::vector<std::unique_ptr<Method>> judged_methods(const Scene& scene);

/// One row for each of these methods.
std::vector<Judgement> empty_judgements(const std::string& scene);

/// Judges the sets of these methods at a pose.
/// @param place begins the texts of failures
/// @param judgements receives counts and failures, one row for each method
/// @return whether a method is wrong
bool judge_pose(const Scene& scene, const Pose& X_WM, std::span<const std::unique_ptr<Method>> methods,
                const std::string& place, std::span<Judgement> judgements);

/// Judges them in evenly spread frames of an experiment.
std::vector<Judgement> judge_experiment(const std::filesystem::path& experiment_file,
                                        std::int64_t most_frames);

/// A table with a row for each judgement and a sum, and the meaning of its columns.
/// @param heading of the first column
std::string judgement_table(const std::vector<Judgement>& judgements, const char* heading);

}  // namespace lmdbench::exact
