// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/decide.h>
#include <lmdbench/decision/intersection_polylines.h>
#include <lmdbench/decision/intersections.h>
#include <lmdbench/methods/certified/keep/certificate.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lmdbench {

/// Decides pairs of faces and regions that may touch (PROOF.md, lemma 10): which of their triangles intersect, exactly, and what corners and chains
/// that are nearer than `touch` share. Nearer than that a direction between two points is rounding, so that no cone of a
/// hierarchy holds it; what has a plane's or a product's direction is found by the hierarchies at every distance.
///
/// Triangles that clearly cross, and those that are clearly apart, are told in vectors (triangle_contact_batch.h), the others by the
/// exact kernel.
class TouchingPairs {
 public:
  /// What a frame fixes, and where results go.
  struct Frame {
    const ShapePair& pair;
    std::int32_t body;
    double touch;  ///< metres
    bool keeps;    ///< Whether certificates are made use of: else any gap will do, not the widest.
    ContactSet& contacts;
    std::vector<Intersection>& intersections;
    std::vector<CrossingPair>& crossing_pairs;  ///< Of triangles that intersect but do not clearly cross.
    std::uint64_t triangle_pairs = 0, triangle_distances = 0;  ///< Counted.
  };

  /// @return for each pair what its decision stands; lever arms are the caller's. Valid until the next call.
  std::span<const Certificate> decide(Frame& frame, std::span<const WidePair> pairs);

 private:
  struct Batch;
  struct Half;

  void decide_batch(Frame& frame, Batch& batch, Batch& not_crossing);
  void decide_not_crossing(Frame& frame, Batch& batch);
  Certificate decide_triangles(Frame& frame, std::int32_t t_moving, std::int32_t t_fixed);
  Certificate decide_regions(Frame& frame, const WidePair& pair);

  std::vector<Certificate> certificates_;
  std::vector<std::pair<FeatureId, FeatureId>> asked_;  ///< What corners and chains within touch share.
  std::vector<std::int32_t> faces_of_large_, faces_of_small_;
  std::vector<Vec3> points_moving_, points_fixed_;
};

}  // namespace lmdbench
