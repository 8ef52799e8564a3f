// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/registry.h>

#include <support/lmd_error.h>

#include <string>
#include <vector>

namespace lmdbench::recall_study {

/// A method with fixed options, observed before or after tracking.
struct Variant {
  std::string label;
  std::string method;
  nlohmann::json options = nlohmann::json::object();  ///< Options other than the defaults.
  int trackings = 0;  ///< At the pose of the search; 0: the candidates of the search.
};

/// Where the improved algorithm loses LMDs, step by step: cones (search without pre-test), each
/// reading of the visibility pre-test, each reduction rule with and without the pre-test.
std::vector<Variant> improved_variants();

/// The original algorithm over its G5 tolerance (decision E5), before and after one tracking.
std::vector<Variant> original_variants();

/// Sums over all poses at one cutoff.
struct VariantResult {
  Variant variant;
  /// Each pair once. Where the minimum is missed, the main part of the force is wrong.
  experiments::LmdError error;
  std::size_t poses_with_loss = 0;  ///< Poses where a true LMD's feature pair is missing.
};

/// Runs a variant at every pose and compares it with the truth there.
/// @param truth true LMDs within the scene's cutoff at each pose
VariantResult judge(const Variant& variant, const Scene& scene, const std::vector<Pose>& poses,
                    const experiments::Truth& truth);

}  // namespace lmdbench::recall_study
