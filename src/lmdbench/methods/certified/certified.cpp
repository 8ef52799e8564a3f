// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/triangle_contact_batch.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/flat_pieces.h>
#include <lmdbench/lmd/search_counters.h>
#include <lmdbench/lmd/triangle_pair.h>
#include <lmdbench/methods/certified/certified.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace lmdbench {

namespace {

/// Distance, relative to the coordinates, at or below which a direction is dominated
/// by the rounding of the points.
constexpr double RELATIVE_TOUCH = 1e-9;
/// PairFilter::margin: above the error of a direction at half the touch distance (4 * 2.2e-16 / 5e-10).
constexpr double FILTER_MARGIN = 1e-5;
/// PairFilter::tiny relative to the coordinates: roundings of such a length's ends are well under the margin.
constexpr double RELATIVE_TINY = 1e-8;
/// Motions of a frame that are larger than this many cutoffs are jumps: next to nothing would be kept.
constexpr double LARGEST_PACE = 1.0;
/// Two minima whose distances differ by more than this part of them, and PLATEAU_SLOPE of the coordinates, cannot be on one
/// plateau (its tolerance is 1e-9).
constexpr double APART = 1e-6;

/// Pairs between the one that is decided and the one whose data is fetched; twice that for the indices,
/// without which the rest is not known.
constexpr std::size_t FETCH_DISTANCE = 4;

/// Flat contacts are found from the largest features down, so that what is part of one is known before it is
/// looked at.
constexpr int RANKS = 3;
int rank_of(const WidePair& pair) {
  const int faces = static_cast<int>(pair.a.is_face()) + static_cast<int>(pair.b.is_face());
  if (faces == 2) return 0;
  const bool vertex =
      pair.a.feature_id().kind == FeatureKind::VERTEX || pair.b.feature_id().kind == FeatureKind::VERTEX;
  return faces == 1 && !vertex ? 1 : 2;
}

/// Brings a feature's indices near; a mesh that does not fit into a processor's cache
/// is slow to follow otherwise.
void fetch_indices(const Surface& surface, const FeatureId& feature) {
  const auto index = static_cast<std::size_t>(feature.index);
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      __builtin_prefetch(&surface.mesh.vertices[index]);
      break;
    case FeatureKind::EDGE:
      __builtin_prefetch(&surface.adjacency.edges[index]);
      break;
    case FeatureKind::FACE:
      __builtin_prefetch(&surface.mesh.triangles[index]);
      __builtin_prefetch(&surface.face_normals[index]);
      break;
  }
}

/// Brings its vertices near, or those round it.
void fetch_vertices(const Surface& surface, const FeatureId& feature) {
  const auto index = static_cast<std::size_t>(feature.index);
  const auto fetch = [&](std::int32_t vertex) {
    __builtin_prefetch(&surface.mesh.vertices[static_cast<std::size_t>(vertex)]);
  };
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      __builtin_prefetch(surface.adjacency.vertex_triangles[feature.index].data());
      break;
    case FeatureKind::EDGE:
      for (const std::int32_t vertex : surface.adjacency.edges[index]) fetch(vertex);
      break;
    case FeatureKind::FACE:
      for (const std::int32_t vertex : surface.mesh.triangles[index]) fetch(vertex);
      break;
  }
}

/// Points of a strict minimum: what the exact kernel finds on any triangle pair that holds both features,
/// without looking at the other features. False when a foot is not inside its feature after all.
bool strict_points(const PairFilter& filter, const FeatureId& on_moving, const FeatureId& on_fixed, Vec3& p,
                   Vec3& q) {
  const auto a = static_cast<std::size_t>(on_moving.index), b = static_cast<std::size_t>(on_fixed.index);
  const auto vertex_moving = [&](std::int32_t vertex) {
    return filter.X_WM.point(filter.moving.mesh.vertices[static_cast<std::size_t>(vertex)]);
  };
  const auto vertex_fixed = [&](std::int32_t vertex) -> const Vec3& {
    return filter.fixed.mesh.vertices[static_cast<std::size_t>(vertex)];
  };
  const auto edge_moving = [&] {
    const auto& ends = filter.moving.adjacency.edges[a];
    return Segment{vertex_moving(ends[0]), vertex_moving(ends[1])};
  };
  const auto edge_fixed = [&] {
    const auto& ends = filter.fixed.adjacency.edges[b];
    return Segment{vertex_fixed(ends[0]), vertex_fixed(ends[1])};
  };
  const auto on_segment = [](const Vec3& point, const Segment& segment, Vec3& foot) {
    const PointSegmentDistance nearest = point_segment_distance(point, segment);
    foot = nearest.point;
    return nearest.feature == SegmentFeature::EDGE;
  };
  const auto on_triangle = [](const Vec3& point, const Triangle& triangle, Vec3& foot) {
    const PointTriangleDistance nearest = point_triangle_distance(point, triangle);
    foot = nearest.point;
    return is_face(nearest.feature);
  };

  if (on_moving.kind == FeatureKind::VERTEX) {
    p = vertex_moving(on_moving.index);
    if (on_fixed.kind == FeatureKind::EDGE) return on_segment(p, edge_fixed(), q);
    if (on_fixed.kind == FeatureKind::FACE)
      return on_triangle(p, filter.fixed.mesh.triangle(on_fixed.index), q);
    q = vertex_fixed(on_fixed.index);
    return true;
  }
  if (on_fixed.kind == FeatureKind::VERTEX) {
    q = vertex_fixed(on_fixed.index);
    if (on_moving.kind == FeatureKind::EDGE) return on_segment(q, edge_moving(), p);
    return on_triangle(q, filter.X_WM.triangle(filter.moving.mesh.triangle(on_moving.index)), p);
  }
  if (on_moving.kind != FeatureKind::EDGE || on_fixed.kind != FeatureKind::EDGE) return false;
  const SegmentPairDistance nearest = segment_distance(edge_moving(), edge_fixed());
  p = nearest.point_a;
  q = nearest.point_b;
  return nearest.feature_a == SegmentFeature::EDGE && nearest.feature_b == SegmentFeature::EDGE &&
         nearest.minimiser_dimension == 0;
}

const WideHierarchy& hierarchy_of(const Body& body, bool joins_flat) {
  return joins_flat ? body.prepared<WideHierarchy>() : body.prepared<SingleFeatureHierarchy>().hierarchy;
}

}  // namespace

Certified::Certified(Scene scene, const CertifiedOptions& options, WideKernel kernel, FlatFeatures flat)
    : scene_(std::move(scene)),
      joins_flat_(flat == FlatFeatures::JOINED),
      hierarchy_moving_(hierarchy_of(*scene_.moving, joins_flat_)),
      flat_moving_(&scene_.moving->prepared<FlatMesh>()),
      coherent_(options.frame_coherence),
      target_(options.kernel),
      kernel_(kernel),
      flat_pieces_(scene_) {
  const UseVectorTarget refused_here_if_not_available(target_);
  double extent = hierarchy_moving_.radius;
  for (const auto& body : scene_.fixed) {
    hierarchies_fixed_.push_back(&hierarchy_of(*body, joins_flat_));
    extent = std::max(extent, hierarchies_fixed_.back()->radius);
  }
  // Without a cutoff that means something there is nothing to save, and lever arms would be without bound.
  coherent_ = coherent_ && scene_.cutoff <= 10.0 * extent;
  kept_.resize(scene_.fixed.size());
  for (const auto& body : scene_.fixed) flat_fixed_.push_back(&body->prepared<FlatMesh>());
}

bool Certified::evaluate(const Frame& frame, const TrianglePair& pair, LocalMinimum& minimum,
                         WorkCounters& counters) {
  const PairFilter& filter = frame.filter;
  const Triangle a = filter.X_WM.triangle(filter.moving.mesh.triangle(pair.moving));
  const TrianglePairDistance nearest = triangle_distance(a, filter.fixed.mesh.triangle(pair.fixed));
  ++counters[Counter::TRIANGLE_DISTANCES];
  if (nearest.intersecting) touching_pairs_.push_back({frame.body, pair.moving, pair.fixed});
  minimum =
      minimum_of_triangle_pair(filter.moving, filter.fixed, frame.body, pair.moving, pair.fixed, nearest);
  if (!(nearest.squared_distance <= scene_.cutoff * scene_.cutoff)) {
    ++counters[Counter::REJECTED_CUTOFF];
    return false;
  }
  ++counters[Counter::FIRST_ORDER_TESTS];
  return meets_first_order(filter.moving, filter.X_WM, filter.fixed, minimum);
}

/// Settles a candidate or leaves its triangle pairs to decide_pending; returns what TraversalFront asks for.
Certificate Certified::decide(const Frame& frame, const WidePair& candidate, double lever_arm,
                              WorkCounters& counters) {
  const FeatureId on_moving = candidate.a.feature_id(), on_fixed = candidate.b.feature_id();
  const PairAnswer answer = frame.filter(on_moving, on_fixed, lever_arm);
  if (answer.verdict == PairVerdict::NO_LMD) return answer.certificate;
  if (frame.is_flat) flat_candidates_.push_back(candidate);
  if (!frame.is_flat || !decide_flat(frame, on_moving, on_fixed, counters))
    settle(frame, on_moving, on_fixed, answer, counters);
  return {};
}

/// Makes a minimum of a pair of single features that the filter did not reject, or leaves its triangle pairs
/// to decide_pending.
void Certified::settle(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed,
                       const PairAnswer& answer, WorkCounters& counters) {
  const PairFilter& filter = frame.filter;
  const auto triangles_moving = filter.moving.incident_triangles(on_moving);
  const auto triangles_fixed = filter.fixed.incident_triangles(on_fixed);
  Lmd lmd;
  if (answer.verdict == PairVerdict::LMD &&
      strict_points(filter, on_moving, on_fixed, lmd.point_moving, lmd.point_fixed)) {
    const Vec3 d = lmd.point_fixed - lmd.point_moving;
    lmd.distance = std::sqrt(d.squaredNorm());
    lmd.direction = d / lmd.distance;
    lmd.feature_moving = on_moving;
    lmd.feature_fixed = on_fixed;
    lmd.triangle_moving = triangles_moving.front();
    lmd.triangle_fixed = triangles_fixed.front();
    lmd.fixed_body = frame.body;
    ++counters[Counter::FIRST_ORDER_TESTS];
    if (is_local_minimum(filter.moving, filter.X_WM, filter.fixed, lmd)) {
      minima_.push_back({lmd, 0, 0.0});
      return;
    }
  }
  // Close to a tie, or the exact test sees the pair otherwise: leave nothing to the closed form.
  const bool has_vertex = on_moving.kind == FeatureKind::VERTEX || on_fixed.kind == FeatureKind::VERTEX;
  for (const std::int32_t t_moving : triangles_moving)
    for (const std::int32_t t_fixed : triangles_fixed) pending_.push_back({{t_moving, t_fixed}, has_vertex});
}

/// Pairs of faces that are looked at together, in vectors.
struct Certified::TouchBatch {
  static constexpr std::size_t SIZE = 64;
  std::array<Triangle, SIZE> moving, fixed;
  std::array<std::pair<TrianglePair, std::uint32_t>, SIZE> pairs;
  std::size_t count = 0;

  bool is_full() const { return count == SIZE; }
  void push(const Triangle& of_moving_mesh, const Triangle& of_fixed_mesh, const TrianglePair& pair,
            std::uint32_t place) {
    moving[count] = of_moving_mesh;
    fixed[count] = of_fixed_mesh;
    pairs[count++] = {pair, place};
  }
  std::span<const Triangle> of_moving() const { return std::span(moving).first(count); }
  std::span<const Triangle> of_fixed() const { return std::span(fixed).first(count); }
};

/// Decides the pairs of `touching_`, and calls plan(place, certificate) for each; lever arms are the caller's.
template <class Plan>
void Certified::decide_touching(const Frame& frame, WorkCounters& counters, Plan&& plan) {
  const PairFilter& filter = frame.filter;
  const double margin = 2.0 * filter.touch;
  const bool knows_flat =
      joins_flat_ && (frame.flat_moving.mesh.joins_features || frame.flat_fixed.mesh.joins_features);
  counters[Counter::LEAF_PAIRS] += touching_.size();
  TouchBatch batch, not_crossing;
  const auto decide_not_crossing = [&] {
    std::array<ClearGap, TouchBatch::SIZE> gaps;
    find_clear_gaps(not_crossing.of_moving(), not_crossing.of_fixed(),
                    std::span(gaps).first(not_crossing.count));
    for (std::size_t k = 0; k < not_crossing.count; ++k) {
      const auto& [pair, place] = not_crossing.pairs[k];
      if (gaps[k].gap > margin) {
        plan(place, Certificate{gaps[k].gap - margin, gaps[k].axis});
        continue;
      }
      LocalMinimum minimum;
      if (evaluate(frame, pair, minimum, counters)) minima_.push_back(minimum);
      plan(place, Certificate{minimum.lmd.distance - margin, minimum.lmd.direction});
    }
    not_crossing.count = 0;
  };
  const auto decide_batch = [&] {
    std::array<ClearCrossing, TouchBatch::SIZE> crossings;
    find_clear_crossings(batch.of_moving(), batch.of_fixed(), std::span(crossings).first(batch.count));
    for (std::size_t k = 0; k < batch.count; ++k) {
      const auto& [pair, place] = batch.pairs[k];
      if (crossings[k].length > 0.0) {
        ++counters[Counter::TRIANGLE_DISTANCES];
        crossings_.push_back({{FeatureKind::FACE, pair.moving},
                              {FeatureKind::FACE, pair.fixed},
                              pair.moving,
                              pair.fixed,
                              frame.body,
                              1,
                              crossings[k].length,
                              crossings[k].middle});
        plan(place, Certificate{});
      } else {
        not_crossing.push(batch.moving[k], batch.fixed[k], pair, place);
        if (not_crossing.is_full()) decide_not_crossing();
      }
    }
    batch.count = 0;
  };
  for (const auto& [candidate, place] : touching_) {
    const FeatureId on_moving = candidate.a.feature_id(), on_fixed = candidate.b.feature_id();
    if (knows_flat &&
        (frame.flat_moving.mesh.is_joined(on_moving) || frame.flat_fixed.mesh.is_joined(on_fixed))) {
      plan(place, decide_touching_flat(frame, candidate, counters));
      continue;
    }
    batch.push(filter.X_WM.triangle(filter.moving.mesh.triangle(on_moving.index)),
               filter.fixed.mesh.triangle(on_fixed.index), {on_moving.index, on_fixed.index}, place);
    if (batch.is_full()) decide_batch();
  }
  decide_batch();
  decide_not_crossing();
}

/// @param first of minima_ that are this body's
void Certified::decide_pending(const Frame& frame, std::size_t first, WorkCounters& counters) {
  std::sort(pending_.begin(), pending_.end());
  pending_.erase(
      std::unique(pending_.begin(), pending_.end(),
                  [](const PendingPair& a, const PendingPair& b) { return a.triangles == b.triangles; }),
      pending_.end());
  flat_pieces_.clear();
  LocalMinimum minimum;
  for (const PendingPair& pair : pending_) {
    if (evaluate(frame, pair.triangles, minimum, counters)) minima_.push_back(minimum);
    if (!pair.has_vertex && minimum.lmd.distance <= scene_.cutoff)
      flat_pieces_.offer(frame.filter.X_WM, frame.body, pair.triangles.moving, pair.triangles.fixed);
  }
  if (joins_flat_) {
    // A tie of two edges brings triangles of the faces beside them, a corner of what may be a large place: what lies over
    // that corner can look parallel where the whole place is not.
    flat_pieces_.keep_whole([&](const FeatureId& flat_moving, const FeatureId& flat_fixed) {
      return (frame.flat_moving.mesh.is_single(flat_moving) && frame.flat_fixed.mesh.is_single(flat_fixed)) ||
             contacts_.is_left_to_triangles(flat_moving, flat_fixed);
    });
  }
  flat_pieces_.append_parallel(minima_, first);
  pending_.clear();
}

void Certified::report(const RigidTransform& X_WM, double coordinates, LmdSet& lmds) {
  double tolerance = 0.0;
  for (const auto& body : scene_.fixed)
    tolerance = std::max(tolerance, parallel_tolerance(scene_.moving->surface(), body->surface()));
  const auto merge = [&] {
    merge_plateaus(scene_, X_WM, minima_, crossings_, lmds);
    lmds.insert(lmds.end(), plateaus_.begin(), plateaus_.end());
    std::sort(lmds.begin(), lmds.end(), lmd_less);
  };
  // Plateaus are rare: they have a size, or several pairs of equal distances.
  if (!crossings_.empty() ||
      std::any_of(minima_.begin(), minima_.end(), [](const LocalMinimum& m) { return m.dimension > 0; })) {
    merge();
    return;
  }
  // A pair may come from its own candidate and from that of a neighbour that was close to a tie.
  keep_one_a_feature_pair(minima_);
  for (std::size_t i = 0; i < minima_.size(); ++i) {
    for (std::size_t j = i + 1; j < minima_.size(); ++j) {
      const double a = minima_[i].lmd.distance, b = minima_[j].lmd.distance;
      if (std::abs(a - b) > APART * std::max(a, b) + PLATEAU_SLOPE * coordinates + tolerance) continue;
      merge();
      return;
    }
  }
  lmds.clear();
  for (const LocalMinimum& minimum : minima_)
    if (minimum.strict) lmds.push_back(minimum.lmd);
  lmds.insert(lmds.end(), plateaus_.begin(), plateaus_.end());
  std::sort(lmds.begin(), lmds.end(), lmd_less);
}

void Certified::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  const UseVectorTarget use(target_);
  const RigidTransform transform(X_WM);
  const WideHierarchy& moving = hierarchy_moving_;
  minima_.clear();
  crossings_.clear();
  touching_pairs_.clear();
  plateaus_.clear();
  double coordinates = transform.point(moving.origin).cwiseAbs().maxCoeff() + moving.radius;
  for (const WideHierarchy* fixed : hierarchies_fixed_)
    coordinates = std::max(coordinates, fixed->origin.cwiseAbs().maxCoeff() + fixed->radius);
  // The same in neighbouring frames, so that what was kept with it stays valid.
  const double touch = RELATIVE_TOUCH * std::exp2(std::ceil(std::log2(coordinates)));
  const double longest = std::max(scene_.cutoff, touch);  // distance of what is looked for
  RigidTransform X_WH = transform;
  X_WH.translation = transform.point(moving.origin);
  bool keep = false;
  if (coherent_) {
    if (has_last_ && touch == touch_) {
      motion_.advance(X_WH, 1e-3 * touch);
      keep = motion_.motion() <= LARGEST_PACE * scene_.cutoff;
    }
    // A jump must not be taken for a motion that goes on.
    if (!keep) motion_.reset(X_WH, moving.radius, longest);
    has_last_ = true;
    touch_ = touch;
  }

  in_doubt_ = false;
  static const RigidTransform identity;
  const FlatSide flat_moving{scene_.moving->surface(), *flat_moving_, transform, true};
  for (std::size_t i = 0; i < scene_.fixed.size(); ++i) {
    const auto body = static_cast<std::int32_t>(i);
    const WideHierarchy& fixed = *hierarchies_fixed_[i];
    const FlatSide flat_fixed{scene_.fixed[i]->surface(), *flat_fixed_[i], identity, false};
    const PairFilter filter{scene_.moving->surface(),
                            transform,
                            scene_.fixed[i]->surface(),
                            scene_.cutoff,
                            touch,
                            FILTER_MARGIN,
                            RELATIVE_TINY * coordinates,
                            joins_flat_ && flat_moving.mesh.joins_features ? &flat_moving.mesh : nullptr,
                            joins_flat_ && flat_fixed.mesh.joins_features ? &flat_fixed.mesh : nullptr};
    PairFilter single_filter = filter;
    single_filter.flat_moving = single_filter.flat_fixed = nullptr;
    const double tolerance = parallel_tolerance(filter.moving, filter.fixed);
    const Frame frame{body,
                      filter,
                      single_filter,
                      flat_moving,
                      flat_fixed,
                      tolerance,
                      joins_flat_ && (tolerance > 0.0 || flat_moving.mesh.joins_features ||
                                      flat_fixed.mesh.joins_features)};
    if (frame.is_flat)
      contacts_.start(
          body, scene_.cutoff, touch, coordinates, tolerance,
          ParallelRule::of(filter.moving, *flat_moving.mesh.regions, filter.fixed, *flat_fixed.mesh.regions));
    flat_candidates_.clear();
    const std::size_t first = minima_.size();
    const WideQuery query(moving, fixed, transform, scene_.cutoff, touch);
    WideCounters work;
    const auto decide_pair = [&](const WidePair& pair, bool, double lever_arm) {
      ++counters[Counter::LEAF_PAIRS];
      return decide(frame, pair, lever_arm, counters);
    };
    touching_.clear();
    const int ranks = frame.is_flat ? RANKS : 1;
    std::size_t settled = first;
    TraversalFront& front = kept_[i].front;
    if (keep && query.possible && kept_[i].policy.keep()) {
      if (front.empty()) {
        front.start(moving, fixed, query, motion_, transform, longest, work);
      } else {
        front.advance(moving, fixed, query, motion_, transform, longest, work);
        kept_[i].policy.note(work.node_tests, front.test_count());
      }
      front.collect_due(motion_);
      for (int rank = 0; rank < ranks; ++rank)
        front.for_each_due(moving, motion_, longest, decide_pair, [&](const WidePair& pair, bool touches) {
          return !touches && (ranks == 1 || rank_of(pair) == rank);
        });
      settle_touching_contacts(frame, first, counters);
      settled = minima_.size();
      front.for_each_due_touching(
          [&](std::uint32_t leaf, const WidePair& pair) { touching_.emplace_back(pair, leaf); });
      decide_touching(frame, counters, [&](std::uint32_t leaf, Certificate certificate) {
        if (certificate.slack > 0.0) certificate.lever_arm = front.lever_arm_of(moving, leaf, longest);
        front.plan_leaf(moving, motion_, leaf, certificate);
      });
    } else {
      front.clear();
      find_wide_pairs(moving, fixed, query, kernel_, scratch_, work);
      const auto fetch = [&](std::size_t k, const auto& fetch_part) {
        if (k >= scratch_.lmd_pairs.size()) return;
        fetch_part(filter.moving, scratch_.lmd_pairs[k].a.feature_id());
        fetch_part(filter.fixed, scratch_.lmd_pairs[k].b.feature_id());
      };
      for (std::size_t k = 0; k < scratch_.lmd_pairs.size(); ++k) {
        fetch(k + 2 * FETCH_DISTANCE, fetch_indices);
        fetch(k + FETCH_DISTANCE, fetch_vertices);
        if (ranks == 1 || rank_of(scratch_.lmd_pairs[k]) == 0) decide_pair(scratch_.lmd_pairs[k], false, 1.0);
      }
      for (int rank = 1; rank < ranks; ++rank)
        for (const WidePair& pair : scratch_.lmd_pairs)
          if (rank_of(pair) == rank) decide_pair(pair, false, 1.0);
      settle_touching_contacts(frame, first, counters);
      settled = minima_.size();
      for (const WidePair& pair : scratch_.touch_pairs) touching_.emplace_back(pair, 0u);
      decide_touching(frame, counters, [](std::uint32_t, const Certificate&) {});
    }
    if (frame.is_flat)
      of_touching_.assign(minima_.begin() + static_cast<std::ptrdiff_t>(settled), minima_.end());
    decide_pending(frame, first, counters);
    if (frame.is_flat) {
      settle_contacts_beside(frame, first, of_touching_, counters);
      in_doubt_ = in_doubt_ || contacts_.is_in_doubt();
      take_contacts(frame, first);
    }
    add_traversal<Counter>(counters, work);
  }
  if (in_doubt_) {
    if (!by_single_features_)
      by_single_features_ = std::make_unique<Certified>(
          scene_, CertifiedOptions{.frame_coherence = coherent_, .kernel = target_}, kernel_,
          FlatFeatures::SINGLE);
    by_single_features_->search(X_WM, lmds, counters);
    return;
  }
  report(transform, coordinates, lmds);
}

}  // namespace lmdbench
