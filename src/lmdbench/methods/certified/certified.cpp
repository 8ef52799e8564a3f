// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/decide.h>
#include <lmdbench/decision/join_contacts.h>
#include <lmdbench/lmd/search_counters.h>
#include <lmdbench/lmd/well_formed.h>
#include <lmdbench/methods/certified/build/hierarchies_among.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/certified/decide/filter.h>
#include <lmdbench/methods/certified/decide/touching_pairs.h>
#include <lmdbench/methods/certified/layout/single_precision.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>

namespace lmdbench {

namespace {

/// PairFilter::margin: above what is granted at half the touch distance (128 * 2.2e-16 / 1e-8).
constexpr double FILTER_MARGIN = 1e-5;
/// A motion of more cutoffs in a frame is a jump: next to nothing would be kept.
constexpr double LARGEST_PACE = 1.0;

/// A cutoff of more sizes of the meshes rejects nothing.
constexpr double MOST_SIZES = 10.0;

/// What is kept is made over several frames, which are searched from scratch meanwhile, and so is
/// what a jolt makes due: so many tests a frame, or this part of the last search's or of those kept
/// so far, if that is more. A kept test costs two to three (scripts/tuned_constants.py --only
/// SHARE_OF_TESTS).
constexpr std::size_t FEW_TESTS = 64, SHARE_OF_TESTS = 8;

/// Vertices are fetched so many pairs ahead, indices, which are needed for that, twice as many.
constexpr std::size_t FETCH_DISTANCE = 4;

/// The reach. The tolerance of meshes that deform changes with them: rounded up to a power of two
/// it is the same in neighbouring frames, so that what was kept stays valid.
double kept_reach(const ContactTolerance& tolerance, const WideHierarchy& moving,
                  const WideHierarchy& fixed) {
  if (moving.changes.now == 0 && fixed.changes.now == 0) return tolerance.reach;
  return tolerance.cutoff + 2.0 * std::exp2(std::ceil(std::log2(tolerance.known)));
}

/// Fetches a feature's indices: meshes larger than the cache are slow otherwise.
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

/// Fetches its vertices; of a vertex the list of its triangles.
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

/// Memory of a search, of which the next one needs nothing.
struct SearchScratch {
  WideScratch wide;
  TraversalFront::Scratch front;
  ContactSet contacts;
  TouchingPairs touching;
  std::vector<RestingRegions> resting;
  std::vector<WidePair> touching_pairs;
  std::vector<std::uint32_t> touching_leaves;  ///< Of touching_pairs, in the front.
};

/// Handed on from search to search: a servo thread finds it grown, and a pile of a thousand pairs
/// needs no more of it than there are threads.
class BorrowedScratch {
 public:
  BorrowedScratch() {
    for (std::atomic<SearchScratch*>& spare : spares)
      if (spare.load() != nullptr && (scratch_ = spare.exchange(nullptr)) != nullptr) return;
    scratch_ = new SearchScratch;
  }
  ~BorrowedScratch() {
    for (std::atomic<SearchScratch*>& spare : spares)
      if (SearchScratch* none = nullptr; spare.compare_exchange_strong(none, scratch_)) return;
    delete scratch_;
  }
  BorrowedScratch(const BorrowedScratch&) = delete;
  BorrowedScratch& operator=(const BorrowedScratch&) = delete;
  SearchScratch& operator*() const { return *scratch_; }

 private:
  static inline std::array<std::atomic<SearchScratch*>, 64> spares{};

  SearchScratch* scratch_ = nullptr;
};

/// Of both meshes in the world at any pose within the cutoff [m]. Of a cutoff of more than ten
/// sizes ten count (PROOF.md, not proved).
double most_coordinates(const Scene& scene) {
  const auto extent = [](const Body& body) { return body.prepared<ShapeComplex>().regions.extent; };
  const double moving = extent(*scene.moving), fixed = extent(scene.fixed_body());
  return std::numbers::sqrt3 * (2.0 * moving + fixed) + std::min(scene.cutoff, MOST_SIZES * (moving + fixed));
}

const WideHierarchy& hierarchy_of(const Body& body, const Scene& scene, bool with_critical) {
  const double coordinates = most_coordinates(scene);
  return with_critical ? body.prepared<HierarchiesAmong<true>>().at(body, coordinates)
                       : body.prepared<HierarchiesAmong<false>>().at(body, coordinates);
}

/// For the contract of the filter.
bool has_contact(const ShapePair& pair, const FeatureId& on_moving, const FeatureId& on_fixed) {
  ContactSet contacts;
  decide(pair, on_moving, on_fixed, contacts);
  return !contacts.contacts.empty();
}

}  // namespace

/// Input and results of a frame.
struct Certified::Frame {
  const WideHierarchy& moving;
  const WideHierarchy& fixed;
  const ShapePair& pair;
  const PairFilter& filter;
  const WideQuery& query;
  double search_distance;  ///< The larger of reach and touch [m].
  TouchingPairs::Frame touching;
  WorkCounters& counters;
  SearchScratch& scratch;
  const SignedPair* signs = nullptr;  ///< Where critical pairs are looked for.
  WideCounters work{};

  /// Asks the definition where the filter does not reject. @return the answer's certificate
  Certificate decide_pair(const WidePair& candidate, double lever_arm) {
    const FeatureId on_moving = candidate.a.feature_id(), on_fixed = candidate.b.feature_id();
    ++counters[Counter::LEAF_PAIRS];
    if (signs != nullptr) {
      // An index has no certificate: pairs that bounds cannot reject are asked in every frame.
      if (filter(on_moving, on_fixed, lever_arm).verdict == PairVerdict::NO_LMD) {
        signs->append(on_moving, on_fixed, scratch.contacts);
      } else {
        ++counters[Counter::DECISIONS];
        decide_critical(pair, *signs, on_moving, on_fixed, scratch.contacts);
      }
      return {};
    }
    const PairAnswer answer = filter(on_moving, on_fixed, lever_arm);
    if (answer.verdict == PairVerdict::NO_LMD) {
      LMDBENCH_ENSURES(!has_contact(pair, on_moving, on_fixed), "a margin of the filter below a tolerance");
      return answer.certificate;
    }
    ++counters[Counter::DECISIONS];
    decide(pair, on_moving, on_fixed, scratch.contacts);
    return {};
  }
};

Certified::Certified(Scene of_pair, const CertifiedOptions& options, WideKernel kernel)
    : Certified(std::move(of_pair), options, kernel, false) {}

Certified::Certified(Scene of_pair, const CertifiedOptions& options, WideKernel kernel, bool with_critical)
    : scene_(std::move(of_pair)),
      hierarchy_moving_(hierarchy_of(*scene_.moving, scene_, with_critical)),
      shape_moving_(scene_.moving->prepared<ShapeComplex>()),
      signs_moving_(with_critical ? &scene_.moving->prepared<SignedFeatures>() : nullptr),
      options_(options),
      fixed_{scene_.fixed_body().surface(),
             scene_.fixed_body().prepared<ShapeComplex>(),
             hierarchy_of(scene_.fixed_body(), scene_, with_critical),
             with_critical ? &scene_.fixed_body().prepared<SignedFeatures>() : nullptr,
             {},
             {}},
      coherent_(options.frame_coherence),
      target_(options.kernel),
      kernel_(kernel) {
  const UseVectorTarget refused_here_if_not_available(target_);
  // A cutoff of ten times the meshes' size saves nothing, and would make lever arms too long.
  coherent_ =
      coherent_ && scene_.cutoff <= MOST_SIZES * std::max(hierarchy_moving_.radius, fixed_.hierarchy.radius);
}

/// Brings the forecast to a frame.
/// @return whether it is one: the pose did not jump
bool Certified::follow_motion(const RigidTransform& X_WM, double touch, double search_distance) {
  if (!coherent_) return false;
  RigidTransform X_WH = X_WM;
  X_WH.translation = X_WM.point(hierarchy_moving_.origin);
  bool goes_on = false;
  if (has_last_ && touch == touch_) {
    motion_.advance(X_WH, 1e-3 * touch);
    goes_on = motion_.motion() <= LARGEST_PACE * scene_.cutoff;
  }
  // A jump must not be extrapolated.
  if (!goes_on) motion_.reset(X_WH, hierarchy_moving_.radius, search_distance);
  has_last_ = true;
  touch_ = touch;
  return goes_on;
}

/// What is kept is in the frames of the hierarchies; where these change it is dropped.
void Certified::follow_deformations() {
  if (hierarchy_moving_.changes.frame > seen_frame_) {
    seen_frame_ = hierarchy_moving_.changes.now;
    has_last_ = false;
    fixed_.front.clear();
  }
  if (fixed_.hierarchy.changes.frame > fixed_.seen_fixed) fixed_.front.clear();
}

void Certified::enumerate_from_scratch(Frame& frame) {
  WideScratch& scratch = frame.scratch.wide;
  WideCounters work;
  find_wide_pairs(frame.moving, frame.fixed, frame.query, kernel_, scratch, work);
  add_traversal<Counter>(frame.counters, work);
  fixed_.tests_from_scratch = work.node_tests;
  const auto fetch = [&](std::size_t k, const auto& fetch_part) {
    if (k >= scratch.lmd_pairs.size()) return;
    fetch_part(frame.pair.moving.surface, scratch.lmd_pairs[k].a.feature_id());
    fetch_part(frame.pair.fixed.surface, scratch.lmd_pairs[k].b.feature_id());
  };
  for (std::size_t k = 0; k < scratch.lmd_pairs.size(); ++k) {
    fetch(k + 2 * FETCH_DISTANCE, fetch_indices);
    fetch(k + FETCH_DISTANCE, fetch_vertices);
    frame.decide_pair(scratch.lmd_pairs[k], 1.0);
  }
  frame.scratch.touching.decide(frame.touching, scratch.touch_pairs);
}

/// Brings what is kept to a frame.
/// @return whether it is complete, so that nothing need be searched from scratch
bool Certified::advance_kept(Frame& frame) {
  TraversalFront& front = fixed_.front;
  TraversalFront::Scratch& scratch = frame.scratch.front;
  if (frame.filter.reach != fixed_.reach) front.clear();  // Where touch changes nothing is kept.
  front.follow(frame.moving, fixed_.seen_moving, frame.fixed, fixed_.seen_fixed, motion_);
  fixed_.reach = frame.filter.reach;
  fixed_.seen_moving = frame.moving.changes.now;
  fixed_.seen_fixed = frame.fixed.changes.now;
  const bool was_complete = front.is_complete();
  if (front.empty()) front.start(frame.moving, frame.fixed);
  const std::size_t due = front.collect_due_tests(motion_, scratch), kept = front.test_count();
  const std::size_t few = std::max(FEW_TESTS, CoherencePolicy::most_of(kept));
  const bool goes_on = was_complete && due <= few;
  const std::size_t added = std::max(FEW_TESTS, std::max(fixed_.tests_from_scratch, kept) / SHARE_OF_TESTS);
  front.advance(frame.moving, frame.fixed, frame.query, motion_, frame.pair.moving.X_WS,
                frame.search_distance, goes_on ? few : added + (due <= few ? due : 0), frame.work, scratch);
  fixed_.policy.note(goes_on ? frame.work.node_tests : due, front.test_count());
  front.collect_due(motion_, scratch);
  if (front.is_complete()) return true;
  front.postpone_due(motion_, scratch);
  return false;
}

void Certified::decide_kept(Frame& frame) {
  TraversalFront& front = fixed_.front;
  SearchScratch& scratch = frame.scratch;
  frame.touching.keeps = true;
  front.for_each_due(
      frame.moving, motion_, frame.search_distance, scratch.front,
      [&](const WidePair& pair, bool, double lever_arm) { return frame.decide_pair(pair, lever_arm); },
      [](const WidePair&, bool touches) { return !touches; });
  scratch.touching_pairs.clear();
  scratch.touching_leaves.clear();
  front.for_each_due_touching(scratch.front, [&](std::uint32_t leaf, const WidePair& pair) {
    scratch.touching_pairs.push_back(pair);
    scratch.touching_leaves.push_back(leaf);
  });
  const auto certificates = scratch.touching.decide(frame.touching, scratch.touching_pairs);
  for (std::size_t k = 0; k < certificates.size(); ++k) {
    const std::uint32_t leaf = scratch.touching_leaves[k];
    Certificate certificate = certificates[k];
    if (certificate.slack > 0.0)
      certificate.lever_arm = front.lever_arm_of(frame.moving, leaf, frame.search_distance);
    front.plan_leaf(frame.moving, motion_, leaf, certificate);
  }
}

template <class Join>
void Certified::find(const Pose& X_WM, WorkCounters& counters, Join&& join) {
  const UseVectorTarget use(target_);
  const RigidTransform transform(X_WM);
  intersections_.clear();
  crossing_pairs_.clear();
  follow_deformations();
  const ShapePair pair(scene_.moving->surface(), shape_moving_, fixed_.surface, fixed_.shape, transform,
                       scene_.cutoff);
  const double radius = hierarchy_moving_.radius, about_origin = hierarchy_moving_.origin.norm();
  const double of_fixed = fixed_.hierarchy.origin.cwiseAbs().maxCoeff() + fixed_.hierarchy.radius;
  const double coordinates =
      std::max({transform.point(hierarchy_moving_.origin).cwiseAbs().maxCoeff() + radius, of_fixed,
                pair.tolerance.coordinates});
  // Beyond so many sizes nothing is kept, and touch would be longer than edges.
  const double near = std::min(scene_.cutoff, MOST_SIZES * (radius + fixed_.hierarchy.radius));
  const double where_anything_is_near =
      of_fixed + radius + near +
      std::max(radius, about_origin + std::numbers::sqrt3 * shape_moving_.regions.extent);
  // The same at all poses at which anything is near, so that what was kept stays valid.
  const double touch =
      RELATIVE_TOUCH * std::exp2(std::ceil(std::log2(std::max(coordinates, where_anything_is_near))));
  const double reach = kept_reach(pair.tolerance, hierarchy_moving_, fixed_.hierarchy);
  const double search_distance = std::max(reach, touch);
  const bool keep = follow_motion(transform, touch, search_distance);
  // Of features no longer than touch rounding is well under the margin, at all poses that are kept.
  const PairFilter filter{pair, reach, touch, FILTER_MARGIN, touch};
  WideQuery query(hierarchy_moving_, fixed_.hierarchy, transform, reach, touch);
  const BorrowedScratch borrowed;
  SearchScratch& scratch = *borrowed;
  scratch.contacts.clear();
  scratch.resting.clear();
  std::optional<SignedPair> signs;
  if (signs_moving_ != nullptr) signs.emplace(pair, *signs_moving_, *fixed_.signs);
  const bool keeps = keep && query.possible && fixed_.policy.keep();
  if (keeps)
    query.limits.reach = round_up_to_single(reach);  // At all poses of a plan.
  else
    fixed_.front.clear();
  Frame frame{hierarchy_moving_,
              fixed_.hierarchy,
              pair,
              filter,
              query,
              search_distance,
              {pair, 0, touch, false, scratch.contacts, intersections_,
               lists_intersecting_pairs_ ? &crossing_pairs_ : nullptr, scratch.resting},
              counters,
              scratch,
              signs ? &*signs : nullptr};
  if (keeps && advance_kept(frame))
    decide_kept(frame);
  else
    enumerate_from_scratch(frame);
  add_traversal<Counter>(counters, frame.work);
  const auto compare = [&](const RestingRegions& regions, std::vector<Intersection>& intersections) {
    TouchingPairs::Frame compared{pair,          0,       touch,          false, scratch.contacts,
                                  intersections, nullptr, scratch.resting};
    scratch.touching.compare(compared, regions);
    frame.touching.pairs += compared.pairs;
    frame.touching.triangle_distances += compared.triangle_distances;
  };
  // By reference: std::function allocates for what is larger.
  join(pair, scratch.contacts, AtRest{scratch.resting, std::ref(compare)});
  counters[Counter::LEAF_PAIRS] += frame.touching.pairs;
  counters[Counter::TRIANGLE_DISTANCES] += frame.touching.triangle_distances;
}

void Certified::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  lmds.clear();
  find(X_WM, counters, [&](const ShapePair& pair, ContactSet& contacts, const AtRest& at_rest) {
    join_contacts(pair, 0, contacts, intersections_, lmds, at_rest);
  });
  append_contacts(scene_, intersections_, lmds);
  std::sort(lmds.begin(), lmds.end(), lmd_less);
  LMDBENCH_ENSURES(is_well_formed(lmds, scene_), "a contact whose point or name is of another place");
}

void Certified::find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) {
  if (signs_moving_ == nullptr) {
    if (!critical_) critical_.reset(new Certified(scene_, options_, kernel_, true));
    critical_->find_critical(X_WM, critical, counters);
    return;
  }
  critical.clear();
  find(X_WM, counters, [&](const ShapePair& pair, ContactSet& contacts, const AtRest& at_rest) {
    join_critical(pair, *signs_moving_, *fixed_.signs, 0, contacts, intersections_, critical, at_rest);
  });
  finish_critical(scene_, intersections_, critical);
}

}  // namespace lmdbench
