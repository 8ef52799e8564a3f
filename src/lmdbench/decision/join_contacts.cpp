// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/decision/covered_contacts.h>
#include <lmdbench/decision/join_contacts.h>
#include <lmdbench/decision/overlap.h>
#include <lmdbench/decision/represent_contacts.h>
#include <lmdbench/geometry/segment_distance.h>

#include <Eigen/Core>
#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <memory_resource>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace lmdbench {

namespace {

/// Contacts on more pairs of features (hubs of fans) are not joined over level ways.
constexpr std::size_t MOST_CARRIER_PAIRS = 256;
/// Tolerances beside a face at which a point leaves a gap of more than two in a segment on it.
constexpr double BESIDE = 8.0;
/// Faces whose normals differ by more are of no one contact, nor is what a contact of unknown
/// direction alone brings together; far above largest_tilt, LARGEST_TURN.
constexpr double LARGEST_ANGLE = 0.01;

bool contact_less(const Contact& a, const Contact& b) {
  if (a.distance != b.distance) return a.distance < b.distance;
  if (name_of(a) != name_of(b)) return name_of(a) < name_of(b);
  if (a.dimension != b.dimension) return a.dimension > b.dimension;
  if (a.index != b.index) return std::abs(a.index) > std::abs(b.index);
  const auto place = [](const Contact& c) {
    return std::tuple(c.point_moving[0], c.point_moving[1], c.point_moving[2]);
  };
  return place(a) < place(b);
}

/// A contact and the features that it lies on, one of each mesh.
struct OnCarriers {
  std::int32_t moving, fixed;
  std::size_t contact;
  auto operator<=>(const OnCarriers&) const = default;
};

bool intersect(std::span<const std::int32_t> a, std::span<const std::int32_t> b) {
  auto x = a.begin(), y = b.begin();
  while (x != a.end() && y != b.end()) {
    if (*x == *y) return true;
    if (*x < *y)
      ++x;
    else
      ++y;
  }
  return false;
}

using Rows = std::pmr::vector<std::pair<std::size_t, std::size_t>>;
/// Carriers of contacts, in rows; the rows are in the order in which they were asked for.
struct Carriers {
  std::vector<std::int32_t> items;
  Rows rows;  ///< First and count, a contact.
};
constexpr std::size_t NOT_KNOWN = std::numeric_limits<std::size_t>::max();

/// Makes LMDs of the contacts of two meshes, or critical pairs if `signs` is given.
class Joining {
 public:
  struct Signs {
    const SignedFeatures &moving, &fixed;
    CriticalSet& critical;
  };

  Joining(const ShapePair& pair, std::int32_t body, ContactSet& set, LmdSet* lmds, const Signs* signs)
      : pair_(pair),
        tolerance_(pair.tolerance),
        body_(body),
        contacts_(set.contacts),
        places_(pair, set, memory_),
        lmds_(lmds),
        signs_(signs) {}

  void run(std::vector<Intersection>& intersections, const AtRest& at_rest) {
    std::vector<RestingRegions> held;  // By a contact, as take_touching would find.
    std::vector<Intersection> touching;
    if (!intersections.empty() || !at_rest.regions.empty()) {
      TouchingContacts near(pair_, places_, contacts_);
      for (const RestingRegions& regions : at_rest.regions)
        if (near.hold(regions))
          held.push_back(regions);
        else
          at_rest.compare(regions, intersections);
      touching = take_touching(pair_, body_, near, intersections);
    }
    drop_intersecting(pair_, body_, places_, intersections, contacts_);
    std::vector<Contact> covered;
    if (signs_ == nullptr) covered = take_covered(pair_, contacts_);
    join_all();
    if (!covered.empty() && !covers_are_alone()) {
      for (Contact& contact : contacts_) contact.covers = contact.covers_point = false;
      contacts_.insert(contacts_.end(), covered.begin(), covered.end());
      join_all();
    }
    report_all();
    if (touching.empty() && held.empty()) return;
    // Triangles that touch where no LMD was reported intersect after all.
    std::vector<Contact> reported;
    for (const std::size_t i : reported_) reported.push_back(contacts_[i]);
    TouchingContacts near(pair_, places_, reported);
    for (const RestingRegions& regions : held)
      if (!near.hold(regions)) at_rest.compare(regions, touching);
    std::ranges::copy_if(touching, std::back_inserter(intersections),
                         [&](const Intersection& crossing) { return !near.are_at(crossing); });
  }

 private:
  void join_all() {
    sort_contacts();
    // A pair of features may have been decided twice.
    contacts_.erase(std::unique(contacts_.begin(), contacts_.end(),
                                [](const Contact& a, const Contact& b) {
                                  return a.dimension == b.dimension && name_of(a) == name_of(b) &&
                                         a.distance == b.distance && a.is_minimum == b.is_minimum &&
                                         a.point_moving == b.point_moving;
                                }),
                    contacts_.end());
    find_ties();
    if (ties_.empty()) return;
    ranks_.assign(contacts_.size(), 0);
    parents_.resize(contacts_.size());
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    sets_ = {ranks_.data(), parents_.data()};
    plane_of_.resize(contacts_.size());
    for (std::size_t i = 0; i < contacts_.size(); ++i) plane_of_[i] = has_plane(i) ? i : NOT_KNOWN;
    touching_.clear();
    shared_.clear();
    for (Carriers* carriers : {&carriers_moving_, &carriers_fixed_}) {
      carriers->items.clear();
      carriers->rows.assign(contacts_.size(), {NOT_KNOWN, 0});
    }
    if (signs_ == nullptr) {
      join_ties();
    } else {
      join_signed_ties();
    }
  }

  /// Whether the contacts within the spread of each covering polygon are just those of its LMD.
  bool covers_are_alone() {
    const auto root_of = [&](std::size_t i) { return ties_.empty() ? i : sets_.find_set(i); };
    std::pmr::vector<std::size_t> sizes(contacts_.size(), 0, &memory_);
    for (std::size_t i = 0; i < contacts_.size(); ++i) ++sizes[root_of(i)];
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (!contacts_[i].covers) continue;
      const double spread = covered_spread(tolerance_, contacts_[i]);
      const auto is_near = [&](std::size_t k) {
        return std::abs(contacts_[k].distance - contacts_[i].distance) <= spread;
      };
      std::size_t begin = i, end = i + 1;
      while (begin > 0 && is_near(begin - 1)) --begin;
      while (end < contacts_.size() && is_near(end)) ++end;
      for (std::size_t k = begin; k < end; ++k)
        if (root_of(k) != root_of(i)) return false;
      if (sizes[root_of(i)] != end - begin) return false;
    }
    return true;
  }

  /// Contacts are large: each moves once. Nearly always the distances alone give the order.
  void sort_contacts() {
    struct Key {
      double distance;
      const Contact* contact;
    };
    std::pmr::vector<Key> order(&memory_);
    order.reserve(contacts_.size());
    for (const Contact& contact : contacts_) order.push_back({contact.distance, &contact});
    std::ranges::sort(order, [](const Key& a, const Key& b) {
      return a.distance != b.distance ? a.distance < b.distance : contact_less(*a.contact, *b.contact);
    });
    std::pmr::vector<Contact> sorted(&memory_);
    sorted.reserve(order.size());
    for (const Key& key : order) sorted.push_back(*key.contact);
    std::ranges::copy(sorted, contacts_.begin());
  }

  // --- which contacts may be one

  /// Finds contacts that share their distance with another one; nearly none, but in flat contact.
  void find_ties() {
    LMDBENCH_EXPECTS(std::ranges::is_sorted(contacts_, {}, &Contact::distance),
                     "contacts appended after they were sorted");
    ties_.clear();
    // Least distance at which a contact may be one with some farther contact.
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = contacts_.size(); i-- > 0;) {
      const double own = contacts_[i].distance - tolerance_.widest_tie(contacts_[i].distance);
      if (lowest <= contacts_[i].distance || (i > 0 && own <= contacts_[i - 1].distance)) ties_.push_back(i);
      lowest = std::min(lowest, own);
    }
    std::ranges::reverse(ties_);
  }

  /// Features that carry a contact, looked up at the first call. Valid until the next call.
  std::span<const std::int32_t> carriers(std::size_t i, bool of_moving) {
    Carriers& own = of_moving ? carriers_moving_ : carriers_fixed_;
    auto& [first, count] = own.rows[i];
    if (first == NOT_KNOWN) {
      first = own.items.size();
      const ShapeSide& side = of_moving ? pair_.moving : pair_.fixed;
      side.shape.append_carriers(side.surface, of_moving ? contacts_[i].moving : contacts_[i].fixed,
                                 own.items);
      count = own.items.size() - first;
    }
    return std::span(own.items).subspan(first, count);
  }

  bool lie_on_one_pair(std::size_t i, std::size_t j) {
    const auto share_one = [&](bool of_moving) {
      carriers(i, of_moving);
      const auto of_j = carriers(j, of_moving);
      return intersect(carriers(i, of_moving), of_j);
    };
    return share_one(true) && share_one(false);
  }

  /// Whether two regions or chains are the same or their closures share a corner.
  static bool are_neighbours(const ShapeSide& side, const FeatureId& a, const FeatureId& b) {
    const auto corners_of = [&](const FeatureId& feature) {
      std::vector<std::int32_t> corners;
      side.shape.append_corners(side.surface, side.shape.lead_of(feature), corners);
      std::ranges::sort(corners);
      return corners;
    };
    return a == b || intersect(corners_of(a), corners_of(b));
  }

  // --- joining

  /// An edge along an edge that touches it has one distance and one direction with all that it
  /// meets: what knows its direction is joined first, so the order of contacts does not matter.
  void join_ties() {
    const auto knows = [&](std::size_t i) { return knows_direction(i); };
    if (std::ranges::all_of(ties_, knows)) return join_pairs();
    const std::pmr::vector<std::size_t> all = ties_;
    std::erase_if(ties_, std::not_fn(knows));
    join_pairs();
    ties_ = all;
    is_for_unknown_ = true;
    join_pairs();
    is_for_unknown_ = false;
    join_through_unknown();
  }

  void join_pairs() {
    join_what_meets();
    const auto root_of = [&](std::size_t i) { return sets_.find_set(i); };
    if (std::ranges::adjacent_find(ties_, std::ranges::not_equal_to(), root_of) != ties_.end())
      join_over_level_ways();
  }

  /// Minima are joined first, alone: they become the LMDs that they are without other critical
  /// pairs. Then pairs on an extended LMD join it, as does the lowest pair at an LMD's place, which
  /// differs in name only. Saddles beside LMDs of points stay: they tell which minima meet.
  void join_signed_ties() {
    const std::pmr::vector<std::size_t> all = ties_;
    std::erase_if(ties_, [&](std::size_t i) { return !contacts_[i].is_minimum; });
    join_ties();
    has_minimum_.resize(contacts_.size());
    is_extended_.resize(contacts_.size());
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (!contacts_[i].is_minimum) continue;
      has_minimum_[sets_.find_set(i)] = true;
      if (contacts_[i].dimension > 0) is_extended_[sets_.find_set(i)] = true;
    }
    ties_ = all;
    join_pairs();
  }

  bool knows_direction(std::size_t i) const { return contacts_[i].knows_direction(tolerance_.rounding); }

  /// Whether a pair is not joined, nor known to touch, and is tried now.
  bool is_open(std::size_t i, std::size_t j) {
    if (sets_.find_set(i) == sets_.find_set(j)) return false;
    if (!is_for_unknown_) return true;
    if (knows_direction(i)) std::swap(i, j);
    return !knows_direction(i) && (!knows_direction(j) || !touching_.contains({i, sets_.find_set(j)}));
  }

  bool has_plane(std::size_t i) const {
    const Contact& contact = contacts_[i];
    return contact.dimension > 0 &&
           (contact.moving.kind == FeatureKind::FACE || contact.fixed.kind == FeatureKind::FACE);
  }
  bool are_at_an_angle(std::size_t i, std::size_t j) const {
    return (contacts_[i].direction - contacts_[j].direction).norm() > LARGEST_ANGLE;
  }

  /// Contacts of unknown direction make one of the sets that they touch, but of those at an angle:
  /// they give their points to each of these.
  void join_through_unknown() {
    // What tells a set's direction must not depend on what this joins.
    const std::pmr::vector<std::size_t> best = best_known();
    const auto are_apart = [&](std::size_t a, std::size_t b) {
      const std::size_t i = best[a], j = best[b];
      return are_at_an_angle(i, j) &&
             ((has_plane(i) && has_plane(j)) || !places_.have_one_direction(contacts_[i], contacts_[j]));
    };
    std::pmr::vector<std::pair<std::size_t, std::size_t>> touching(&memory_);
    for (const auto& [unknown, known] : touching_) touching.emplace_back(sets_.find_set(unknown), known);
    std::ranges::sort(touching);
    touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
    for (std::size_t i = 0; i < touching.size(); ++i)
      for (std::size_t j = i + 1; j < touching.size() && touching[j].first == touching[i].first; ++j)
        if (!are_apart(touching[i].second, touching[j].second))
          sets_.union_set(touching[i].second, touching[j].second);
    for (auto begin = touching.begin(); begin != touching.end();) {
      const auto end = std::ranges::find_if(begin, touching.end(),
                                            [&](const auto& pair) { return pair.first != begin->first; });
      const std::size_t set = sets_.find_set(begin->second);
      if (std::all_of(begin, end, [&](const auto& pair) { return sets_.find_set(pair.second) == set; }))
        sets_.union_set(begin->first, set);
      else
        shared_.insert(shared_.end(), begin, end);
      begin = end;
    }
  }

  /// Of each root of contacts of known direction: a plane's if there is one, then the one that
  /// knows it best.
  std::pmr::vector<std::size_t> best_known() {
    std::pmr::vector<std::size_t> best(contacts_.size(), NOT_KNOWN, &memory_);
    const auto rank = [&](std::size_t i) { return std::pair(!has_plane(i), contacts_[i].direction_error); };
    for (const std::size_t i : ties_) {
      std::size_t& own = best[sets_.find_set(i)];
      if (knows_direction(i) && (own == NOT_KNOWN || rank(i) < rank(own))) own = i;
    }
    return best;
  }

  void join(std::size_t i, std::size_t j) {
    LMDBENCH_EXPECTS(std::abs(contacts_[i].distance - contacts_[j].distance) <=
                         tolerance_.widest_tie(std::max(contacts_[i].distance, contacts_[j].distance)),
                     "contacts at unlike distances: no tolerance grows as a distance shrinks");
    if (is_for_unknown_ && knows_direction(i) != knows_direction(j)) {
      if (knows_direction(i)) std::swap(i, j);
      touching_.emplace(i, sets_.find_set(j));
      return;
    }
    const std::size_t a = sets_.find_set(i), b = sets_.find_set(j);
    const std::size_t of_a = plane_of_[a], of_b = plane_of_[b];
    // Faces that have one direction are one, and so all of a bearing of facets.
    const bool are_planes = has_plane(i) && has_plane(j);
    if (!are_planes && of_a != NOT_KNOWN && of_b != NOT_KNOWN && are_at_an_angle(of_a, of_b)) return;
    link(a, b);
    if (sets_.find_set(a) == sets_.find_set(b))
      plane_of_[sets_.find_set(a)] = of_a != NOT_KNOWN ? of_a : of_b;
  }

  void link(std::size_t a, std::size_t b) {
    if (has_minimum_.empty()) return sets_.link(a, b);
    if (has_minimum_[a] == has_minimum_[b]) return;
    const std::size_t minimum = has_minimum_[a] ? a : b, other = minimum == a ? b : a;
    if (!is_extended_[minimum] && !contacts_[other].is_basin) return;
    const bool is_extended = is_extended_[minimum];
    sets_.link(a, b);
    const std::size_t both = sets_.find_set(a);
    has_minimum_[both] = true;
    is_extended_[both] = is_extended;
  }

  /// Joins contacts whose places meet, by a sweep over their boxes along x.
  void join_what_meets() {
    struct Entry {
      Eigen::AlignedBox3d box;
      std::size_t contact;
    };
    std::pmr::vector<Entry> entries(&memory_), open(&memory_);
    entries.reserve(ties_.size());
    for (const std::size_t i : ties_) entries.push_back({places_.box_of(contacts_[i], tolerance_.known), i});
    std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
      return std::pair(a.box.min().x(), a.contact) < std::pair(b.box.min().x(), b.contact);
    });
    for (const Entry& entry : entries) {
      const std::size_t i = entry.contact;
      const Contact& a = contacts_[i];
      std::erase_if(open, [&](const Entry& o) { return o.box.max().x() < entry.box.min().x(); });
      for (const Entry& o : open) {
        if (!o.box.intersects(entry.box) || !is_open(o.contact, i)) continue;
        const Contact& b = contacts_[o.contact];
        if (std::abs(a.distance - b.distance) <= places_.granted(a, b) && are_one_place(o.contact, i))
          join(o.contact, i);
      }
      open.push_back(entry);
    }
  }

  bool are_one_place(std::size_t i, std::size_t j) {
    const Contact &a = contacts_[i], &b = contacts_[j];
    const bool both_extended = a.dimension > 0 && b.dimension > 0;
    // Parts of the overlap of one pair of features are apart.
    if (both_extended && name_of(a) == name_of(b)) return false;
    return places_.have_one_direction(a, b) && places_.meet(a, b) &&
           (lie_on_one_pair(i, j) || (both_extended && are_neighbours(pair_.moving, a.moving, b.moving) &&
                                      are_neighbours(pair_.fixed, a.fixed, b.fixed)));
  }

  /// Joins points and segments that are apart, with an equal distance all the way between them:
  /// next to touch both ends of a chain over another one may seem to be minima.
  void join_over_level_ways() {
    // What lies on which part of an overlap must not depend on the ways found before.
    met_.resize(contacts_.size());
    for (const std::size_t i : ties_) met_[i] = sets_.find_set(i);
    std::pmr::vector<OnCarriers> entries(&memory_), parts(&memory_);
    for (const std::size_t i : ties_) {
      if (contacts_[i].dimension == 2) {
        parts.push_back({contacts_[i].moving.index, contacts_[i].fixed.index, i});
        continue;
      }
      const auto of_moving = carriers(i, true), of_fixed = carriers(i, false);
      if (of_moving.size() * of_fixed.size() > MOST_CARRIER_PAIRS) continue;
      for (const std::int32_t f : of_moving)
        for (const std::int32_t g : of_fixed) entries.push_back({f, g, i});
    }
    std::ranges::sort(entries);
    std::ranges::sort(parts);
    const auto carriers_of = [](const OnCarriers& entry) { return std::pair(entry.moving, entry.fixed); };
    const auto distance_of = [&](const OnCarriers& entry) { return contacts_[entry.contact].distance; };
    for (std::size_t begin = 0; begin < entries.size();) {
      std::size_t end = begin;
      while (end < entries.size() && entries[end].moving == entries[begin].moving &&
             entries[end].fixed == entries[begin].fixed)
        ++end;
      // Not std::ranges::equal_range, which clang 14 cannot read.
      const auto first = std::ranges::lower_bound(parts, carriers_of(entries[begin]), {}, carriers_of);
      const auto last = std::ranges::upper_bound(parts, carriers_of(entries[begin]), {}, carriers_of);
      // Clearly farther contacts form a bucket of their own.
      for (std::size_t at = begin; at < end;) {
        std::size_t next = at + 1;
        while (next < end && distance_of(entries[next]) - distance_of(entries[next - 1]) <=
                                 tolerance_.widest_tie(distance_of(entries[next])))
          ++next;
        join_in_bucket(std::span(entries).subspan(at, next - at), std::span(first, last));
        at = next;
      }
      begin = end;
    }
  }

  /// Most contacts on one pair of features are joined already: of a face on a face by the thousand.
  /// Those of different parts of two regions' overlap are apart.
  /// @param parts  polygons of that pair
  void join_in_bucket(std::span<const OnCarriers> bucket, std::span<const OnCarriers> parts) {
    std::pmr::vector<std::size_t> roots(&memory_), met_parts(&memory_);
    roots.reserve(bucket.size());
    for (const OnCarriers& entry : bucket) roots.push_back(sets_.find_set(entry.contact));
    if (std::ranges::count(roots, roots.front()) == std::ssize(roots)) return;
    for (const OnCarriers& part : parts) met_parts.push_back(met_[part.contact]);
    std::ranges::sort(met_parts);
    std::vector<bool> is_of_part;
    for (const OnCarriers& entry : bucket)
      is_of_part.push_back(std::ranges::binary_search(met_parts, met_[entry.contact]));
    if (std::ranges::find(is_of_part, false) == is_of_part.end()) return;
    const auto try_way = [&](std::size_t k, std::size_t m) {
      const std::size_t i = bucket[k].contact, j = bucket[m].contact;
      if (!is_open(i, j) || (is_of_part[k] && is_of_part[m])) return;
      if (is_level_way(bucket.front(), contacts_[i], contacts_[j])) join(i, j);
    };
    if (const auto order = order_along_line(bucket); !order.empty()) {
      // Teeth of crossed combs: the way between two places leads over those between them.
      for (std::size_t k = 1; k < order.size(); ++k) try_way(order[k - 1], order[k]);
      return;
    }
    for (std::size_t k = 0; k < bucket.size(); ++k) {
      if (is_of_part[k]) continue;
      for (std::size_t m = 0; m < bucket.size(); ++m)
        if (roots[k] != roots[m]) try_way(k, m);
    }
  }

  /// A bucket's order along a line, if its places are on one line of either mesh at one distance.
  std::pmr::vector<std::size_t> order_along_line(std::span<const OnCarriers> bucket) {
    using Vec6 = Eigen::Matrix<double, 6, 1>;
    std::pmr::vector<std::size_t> order(&memory_);
    if (contacts_[bucket.back().contact].distance - contacts_[bucket.front().contact].distance >
        tolerance_.known)
      return order;
    const auto ends = [&](const OnCarriers& entry) {
      const Contact& c = contacts_[entry.contact];
      return c.dimension == 0 ? std::array{(Vec6() << c.point_moving, c.point_fixed).finished(),
                                           (Vec6() << c.point_moving, c.point_fixed).finished()}
                              : std::array{(Vec6() << c.ends_moving[0], c.ends_fixed[0]).finished(),
                                           (Vec6() << c.ends_moving[1], c.ends_fixed[1]).finished()};
    };
    const Vec6 origin = ends(bucket.front())[0];
    const auto from_origin = [&](const OnCarriers& entry) {
      const auto [begin, end] = ends(entry);
      return std::max((begin - origin).squaredNorm(), (end - origin).squaredNorm());
    };
    const auto far_ends = ends(*std::ranges::max_element(bucket, {}, from_origin));
    Vec6 along = far_ends[0] - origin;
    if (along.squaredNorm() < (far_ends[1] - origin).squaredNorm()) along = far_ends[1] - origin;
    along.normalize();
    std::pmr::vector<double> places(&memory_);
    for (const OnCarriers& entry : bucket) {
      const auto both = ends(entry);
      for (const Vec6& end : both)
        if ((end - origin - (end - origin).dot(along) * along).norm() > tolerance_.known) return order;
      places.push_back(0.5 * (both[0] + both[1] - 2.0 * origin).dot(along));
    }
    order.resize(bucket.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t k) { return std::pair(places[k], k); });
    return order;
  }

  bool is_level_way(const OnCarriers& on, const Contact& a, const Contact& b) const {
    if (a.dimension > 0 && b.dimension > 0 && name_of(a) == name_of(b)) return false;
    const auto nearest = [](const Contact& contact, const std::array<Vec3, 2>& ends, const Vec3& point,
                            const Vec3& to) {
      return contact.dimension == 0 ? point : point_segment_distance(to, {ends[0], ends[1]}).point;
    };
    const Vec3 p_a = nearest(a, a.ends_moving, a.point_moving, b.point_moving);
    const Vec3 q_a = nearest(a, a.ends_fixed, a.point_fixed, b.point_fixed);
    const Vec3 p_b = nearest(b, b.ends_moving, b.point_moving, p_a);
    const Vec3 q_b = nearest(b, b.ends_fixed, b.point_fixed, q_a);
    const double way = (p_a - p_b).norm() + (q_a - q_b).norm();
    // The way is square to the direction: nothing on it is nearer to first order.
    const Contact& farther = a.distance < b.distance ? b : a;
    const auto is_square = [&](const Vec3& step) {
      return std::abs(step.dot(farther.direction)) <=
             tolerance_.known + (2.0 * tolerance_.largest_tilt + farther.direction_error) * step.norm();
    };
    return is_square(p_b - p_a) && is_square(q_b - q_a) &&
           std::abs(a.distance - b.distance) <= places_.granted(a, b, way) &&
           places_.have_one_direction(a, b, way) && !is_beside(pair_.moving, on.moving, 0.5 * (p_a + p_b)) &&
           !is_beside(pair_.fixed, on.fixed, 0.5 * (q_a + q_b)) &&
           holds_segment(pair_.moving, on.moving, p_a, p_b) && holds_segment(pair_.fixed, on.fixed, q_a, q_b);
  }

  /// Whether a point is too far from a carrier for a segment through it to stay there. Between
  /// places of a long outline it nearly always is, and the test is cheaper than a segment's.
  bool is_beside(const ShapeSide& side, std::int32_t carrier, const Vec3& p) const {
    const RegionShape* shape = carrier < 0 ? nullptr : side.shape.shapes.of_region(carrier);
    return shape != nullptr && shape->clearly_holds(shape->frame.flat(side.point_to_surface(p)),
                                                    BESIDE * tolerance_.known) == false;
  }

  /// Whether a segment between two points of a carrier stays on it, to the tolerance.
  bool holds_segment(const ShapeSide& side, std::int32_t carrier, const Vec3& begin, const Vec3& end) const {
    if ((end - begin).norm() <= tolerance_.known) return true;
    // Triangles, chains and convex faces are convex.
    const RegionShape* shape = carrier < 0 ? nullptr : side.shape.shapes.of_region(carrier);
    if (shape == nullptr || shape->pieces.size() == 1) return true;
    const auto parts = parts_over_region(side.point_to_surface(begin), side.point_to_surface(end), side,
                                         carrier, tolerance_.known);
    double covered = 0.0;
    for (const SegmentPart& part : parts) covered += part.end - part.begin;
    return (1.0 - covered) * (end - begin).norm() <= 2.0 * tolerance_.known;
  }

  // --- what is reported

  void report_all() {
    if (ties_.empty()) {
      for (std::size_t i = 0; i < contacts_.size(); ++i)
        if (contacts_[i].dimension > 0)
          report_set({&i, 1});
        else if (contacts_[i].is_minimum || contacts_[i].index != 0)
          report(contacts_[i], contacts_[i], {&i, 1}, contacts_[i].is_minimum);
      return;
    }
    std::pmr::vector<std::size_t> order(contacts_.size(), &memory_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    sets_.compress_sets(order.begin(), order.end());
    std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(parents_[i], i); });
    for (std::size_t begin = 0; begin < order.size();) {
      std::size_t end = begin;
      while (end < order.size() && parents_[order[end]] == parents_[order[begin]]) ++end;
      report_set(std::span(order).subspan(begin, end - begin));
      begin = end;
    }
  }

  /// @param set  indices of contacts of one LMD, nearest first
  void report_set(std::span<const std::size_t> set) {
    ContactPointers minima(&memory_);
    bool has_points = false;
    for (const std::size_t i : set) {
      if (!contacts_[i].is_minimum) continue;
      minima.push_back(&contacts_[i]);
      has_points = has_points || contacts_[i].dimension == 0 || contacts_[i].covers_point;
    }
    for (const auto& [unknown, known] : shared_) {
      const std::size_t root = sets_.find_set(set.front());
      if (sets_.find_set(unknown) == root) {  // These are of the LMDs that they touch.
        reported_.insert(reported_.end(), set.begin(), set.end());
        return;
      }
      if (sets_.find_set(known) == root) has_points = has_points || has_point(sets_.find_set(unknown));
    }
    if (has_points) {
      const Representative whole = represent_contacts(pair_, places_, minima);
      report(whole.contact(), *whole.namesake, set, true);
    } else if (sum_of(set) != 0) {  // Rule S: no minimum.
      // By the point that is the saddle where indices are taken: descents begin there.
      const auto saddle = std::ranges::find_if(set, [&](std::size_t i) { return contacts_[i].index < 0; });
      const Contact& named = contacts_[saddle == set.end() ? set.front() : *saddle];
      report(named, named, set, false);
    }
  }

  bool has_point(std::size_t root) {
    return std::ranges::any_of(ties_, [&](std::size_t i) {
      return contacts_[i].is_minimum && contacts_[i].dimension == 0 && sets_.find_set(i) == root;
    });
  }

  int sum_of(std::span<const std::size_t> set) const {
    int sum = 0;
    for (const std::size_t i : set) sum += contacts_[i].index;
    return sum;
  }

  void report(const Contact& contact, const Contact& namesake, std::span<const std::size_t> set,
              bool is_minimum) {
    LMDBENCH_EXPECTS(contact.distance >= 0.0 && is_unit(contact.direction),
                     "a contact that nobody gave a direction");
    if (contact.distance > tolerance_.cutoff) return;
    if (contact.distance <= tolerance_.known) reported_.insert(reported_.end(), set.begin(), set.end());
    const Lmd lmd = make_lmd(pair_, places_, contact, namesake, body_);
    if (signs_ == nullptr) return lmds_->push_back(lmd);
    const bool has_index = std::ranges::all_of(set, [&](std::size_t i) {
      return signs_->moving.has_index(contacts_[i].moving) && signs_->fixed.has_index(contacts_[i].fixed);
    });
    const int index = has_index ? sum_of(set) : 1;
    const auto any = [&](const auto& is) {
      return std::ranges::any_of(set, [&](std::size_t i) { return is(contacts_[i]); });
    };
    // A way down begins where a saddle is and no minimum: a birth. Saddles at minima are round a
    // hole of the overlap of two faces, as under a washer; corners are minima only without a tilt.
    const bool has_overlap = any([](const Contact& c) { return c.dimension == 2; });
    const auto is_way_down = [&](const Contact& saddle) {
      return saddle.index < 0 && !any([&](const Contact& c) {
               const bool same_moving = c.moving == saddle.moving, same_fixed = c.fixed == saddle.fixed;
               return c.is_minimum &&
                      ((same_moving && (same_fixed || saddle.fixed.kind == FeatureKind::VERTEX)) ||
                       (same_fixed && saddle.moving.kind == FeatureKind::VERTEX));
             });
    };
    const bool is_basin = has_index ? (index > 0 || (is_minimum && has_overlap && !any(is_way_down))) &&
                                          any([](const Contact& c) { return c.is_basin; })
                                    : is_minimum;
    signs_->critical.push_back({lmd, index, is_minimum, has_index, is_basin});
  }

  const ShapePair& pair_;
  const ContactTolerance& tolerance_;
  std::int32_t body_;
  std::vector<Contact>& contacts_;
  /// Room for a few hundred contacts without an allocation.
  std::array<std::byte, 1 << 15> room_;
  std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
  ContactPlaces places_;
  LmdSet* lmds_;
  const Signs* signs_;
  /// Of the roots, set while critical pairs that are no minima are joined.
  std::vector<bool> has_minimum_, is_extended_;
  std::pmr::vector<std::size_t> ties_{&memory_}, ranks_{&memory_}, parents_{&memory_};
  /// Of the roots: an extended contact whose direction is a plane's, or NOT_KNOWN.
  std::pmr::vector<std::size_t> plane_of_{&memory_};
  /// Roots before ways between places that are apart.
  std::pmr::vector<std::size_t> met_{&memory_};
  bool is_for_unknown_ = false;  ///< Pairs of two contacts of known direction were tried.
  /// Contacts of unknown direction and roots of known ones that they are one with.
  std::pmr::set<std::pair<std::size_t, std::size_t>> touching_{&memory_};
  /// A contact of a set of unknown direction, and one of each set at an angle that it touches.
  std::pmr::vector<std::pair<std::size_t, std::size_t>> shared_{&memory_};
  std::pmr::vector<std::size_t> reported_{&memory_};  ///< Of LMDs no farther than the tolerance.
  boost::disjoint_sets<std::size_t*, std::size_t*> sets_{nullptr, nullptr};
  Carriers carriers_moving_{{}, Rows(&memory_)}, carriers_fixed_{{}, Rows(&memory_)};
};

}  // namespace

void join_contacts(const ShapePair& pair, std::int32_t fixed_body, ContactSet& contacts,
                   std::vector<Intersection>& intersections, LmdSet& lmds, const AtRest& at_rest) {
  Joining(pair, fixed_body, contacts, &lmds, nullptr).run(intersections, at_rest);
}

void join_critical(const ShapePair& pair, const SignedFeatures& moving, const SignedFeatures& fixed,
                   std::int32_t fixed_body, ContactSet& contacts, std::vector<Intersection>& intersections,
                   CriticalSet& critical, const AtRest& at_rest) {
  const Joining::Signs signs{moving, fixed, critical};
  Joining(pair, fixed_body, contacts, nullptr, &signs).run(intersections, at_rest);
}

}  // namespace lmdbench
