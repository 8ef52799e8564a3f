// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/decide.h>
#include <lmdbench/decision/drop_intersecting.h>
#include <lmdbench/decision/intersection_polylines.h>
#include <lmdbench/decision/intersections.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/methods/certified/decide/certificate.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace lmdbench {

/// Decides pairs of faces and regions that may touch; of regions their triangles near each other.
/// 1. Triangles that clearly cross or are clearly apart are told in vectors (PROOF.md, lemmas 11,
///    12; triangle_contact_batch.h), the others by the exact kernel.
/// 2. Of triangles within `touch` the definition is asked for corners with corners and chains, and
///    for parallel chains (PROOF.md, lemma 10): their direction is rounding, and no cone holds it.
///    Contacts with a plane's or product's direction the hierarchies find at every distance.
/// 3. Triangles of regions at rest on each other, or one by a chain on the other, are not compared
///    (lemma 10): a contact stands for them, and corners and chains are found along the borders.
class TouchingPairs {
 public:
  /// What a frame fixes, and where results go.
  struct Frame {
    const ShapePair& pair;
    std::int32_t body;
    double touch;  ///< metres
    bool keeps;    ///< Certificates are used: the widest gap is needed, not any.
    ContactSet& contacts;
    std::vector<Intersection>& intersections;
    std::vector<CrossingPair>* crossing_pairs;  ///< Of all that intersect; null: not asked.
    std::vector<RestingRegions>& resting;       ///< Whose triangles were not compared.
    /// Of triangles and of what is looked up along borders, and of triangles decided exactly.
    std::uint64_t pairs = 0, triangle_distances = 0;
  };

  /// @return each pair's certificate, without lever arms; valid until the next call
  std::span<const Certificate> decide(Frame& frame, std::span<const WidePair> pairs);
  /// Appends what intersects of the triangles of two regions.
  void compare(Frame& frame, const RestingRegions& regions);

 private:
  struct Batch;
  struct Half;

  void decide_batch(Frame& frame, Batch& batch, Batch& not_crossing);
  void decide_not_crossing(Frame& frame, Batch& batch);
  Certificate decide_triangles(Frame& frame, std::int32_t t_moving, std::int32_t t_fixed);
  Certificate decide_regions(Frame& frame, const WidePair& pair);
  void decide_near_regions(Frame& frame, const Half& moving, const Half& fixed);
  void decide_triangles_of(Frame& frame, const Half& moving, const Half& fixed, bool is_noted);
  static bool are_opposed(const Frame& frame, const Half& moving, const Half& fixed);
  void note_along_borders(Frame& frame, const Half& a, const Half& b);
  static std::optional<RestingRegions> find_rest(const Frame& frame, const Half& moving, const Half& fixed);
  static std::optional<RestingRegions> find_chain_at_rest(const Frame& frame, const Half& wall,
                                                          const Half& base);
  static TrianglePairDistance intersect(Frame& frame, std::int32_t t_moving, std::int32_t t_fixed);

  std::vector<Certificate> certificates_;
  std::vector<std::pair<FeatureId, FeatureId>> asked_;  ///< Corners and chains within touch.
  std::vector<std::int32_t> faces_of_large_, faces_of_small_;
  std::vector<Vec3> points_moving_, points_fixed_;
};

}  // namespace lmdbench
