// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/extent.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/lmd/join_contacts.h>
#include <lmdbench/lmd/overlap.h>

#include <Eigen/Geometry>
#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace lmdbench {

namespace {

/// Pairs of features that a contact lies on, beyond which it is not looked for in buckets: hubs of fans.
constexpr std::size_t MOST_CARRIER_PAIRS = 256;
/// Angle [rad] up to which two contacts have one direction: far above what rounding does to it, far below an angle between faces.
constexpr double SAME_DIRECTION = 0.1;
/// Polygons of more pieces get a grid of them.
constexpr std::size_t PIECES_WITHOUT_GRID = 8;
/// Relative difference within which two pieces are equally near to a centroid: rounding must not choose the name of a
/// symmetric contact.
constexpr double EQUALLY_NEAR = 1e-9;

auto name_of(const Contact& contact) {
  return std::tie(contact.moving, contact.fixed);
}

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

/// A contact and one feature of either mesh that it lies on.
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
/// Carriers of contacts, row after row in the order in which they were asked for.
struct Carriers {
  std::vector<std::int32_t> items;
  Rows rows;  ///< First and count, a contact.
};
constexpr std::size_t NOT_KNOWN = std::numeric_limits<std::size_t>::max();

class Joining {
 public:
  /// Of every LMD that is reported, where it is wanted.
  struct Sign {
    int index;
    bool is_minimum, has_index, is_basin;
  };
  struct Signs {
    const SignedFeatures &moving, &fixed;
    std::vector<Sign> of_lmds;
  };

  Joining(const ShapePair& pair, std::int32_t body, ContactSet& set, Signs* signs = nullptr)
      : pair_(pair),
        tolerance_(pair.tolerance),
        body_(body),
        set_(set),
        contacts_(set.contacts),
        signs_(signs) {}

  void run(std::span<const Intersection> intersections, LmdSet& lmds) {
    drop_intersecting(intersections);
    sort_contacts();
    // The same pair of features may have been asked for twice.
    contacts_.erase(std::unique(contacts_.begin(), contacts_.end(),
                                [](const Contact& a, const Contact& b) {
                                  return a.dimension == b.dimension && name_of(a) == name_of(b) &&
                                         a.distance == b.distance && a.is_minimum == b.is_minimum &&
                                         a.point_moving == b.point_moving;
                                }),
                    contacts_.end());
    find_company();
    if (company_.empty()) {
      for (std::size_t i = 0; i < contacts_.size(); ++i)
        if (contacts_[i].dimension == 0 && (contacts_[i].is_minimum || contacts_[i].index != 0))
          report_signed(contacts_[i], contacts_[i], {&i, 1}, contacts_[i].is_minimum, lmds);
      return;
    }
    ranks_.assign(contacts_.size(), 0);
    parents_.resize(contacts_.size());
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    sets_ = {ranks_.data(), parents_.data()};
    for (Carriers* carriers : {&carriers_moving_, &carriers_fixed_})
      carriers->rows.assign(contacts_.size(), {NOT_KNOWN, 0});
    grids_.resize(set_.frames.size());
    if (signs_ == nullptr) {
      join_company();
    } else {
      join_signed_company();
    }
    report_all(lmds);
  }

 private:
  using Pieces = std::pmr::vector<const Contact*>;

  /// Contacts are large: they move once.
  void sort_contacts() {
    Pieces order(&memory_);
    order.reserve(contacts_.size());
    for (const Contact& contact : contacts_) order.push_back(&contact);
    std::ranges::sort(order, [](const Contact* a, const Contact* b) { return contact_less(*a, *b); });
    std::pmr::vector<Contact> sorted(&memory_);
    sorted.reserve(order.size());
    for (const Contact* contact : order) sorted.push_back(*contact);
    std::ranges::copy(sorted, contacts_.begin());
  }

  // --- contacts whose triangles intersect

  void drop_intersecting(std::span<const Intersection> intersections) {
    if (intersections.empty()) return;
    std::erase_if(contacts_, [&](const Contact& contact) {
      if (contact.least_gap > tolerance_.rounding) return false;
      return std::ranges::any_of(intersections, [&](const Intersection& crossing) {
        return crossing.fixed_body == body_ && is_over(contact, crossing) &&
               is_in_star(pair_.moving, contact.moving, crossing.triangle_moving) &&
               is_in_star(pair_.fixed, contact.fixed, crossing.triangle_fixed);
      });
    });
  }

  /// Whether a triangle has a corner on a feature.
  static bool is_in_star(const ShapeSide& side, const FeatureId& feature, std::int32_t triangle) {
    const auto& corners = side.surface.mesh.triangles[static_cast<std::size_t>(triangle)];
    return std::ranges::any_of(corners, [&](std::int32_t v) {
      if (feature.kind == FeatureKind::VERTEX) return v == feature.index;
      return std::ranges::any_of(side.surface.adjacency.vertex_triangles[v], [&](std::int32_t t) {
        if (feature.kind == FeatureKind::FACE) return side.shape.region_of(t) == feature.index;
        return std::ranges::any_of(
            side.surface.adjacency.triangle_edges[static_cast<std::size_t>(t)], [&](std::int32_t e) {
              const auto& ends = side.surface.adjacency.edges[static_cast<std::size_t>(e)];
              return (ends[0] == v || ends[1] == v) && side.shape.chain_of(e) == feature.index;
            });
      });
    });
  }

  /// Whether what two triangles share comes to the place of a contact.
  bool is_over(const Contact& contact, const Intersection& crossing) const {
    const double reach = tolerance_.known + (crossing.dimension == 1   ? 0.5 * crossing.measure
                                             : crossing.dimension == 2 ? crossing_reach(crossing)
                                                                       : 0.0);
    return box_of(contact, reach).contains(crossing.point);
  }
  /// How far what two triangles share reaches from its centroid: a polygon's measure is an area and says little.
  double crossing_reach(const Intersection& crossing) const {
    const Triangle t = pair_.fixed.surface.mesh.triangle(crossing.triangle_fixed);
    return std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
  }

  // --- which contacts may be one

  /// Contacts of which another one has the same distance: next to none but in flat contact.
  void find_company() {
    const double spread = 2.0 * tolerance_.known;  // of the distance over two extended contacts
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const double granted = tolerance_.same_distance(contacts_[i].distance) + spread;
      const bool below = i > 0 && contacts_[i].distance - contacts_[i - 1].distance <= last_granted_;
      const bool above =
          i + 1 < contacts_.size() && contacts_[i + 1].distance - contacts_[i].distance <= granted;
      if (below || above) company_.push_back(i);
      last_granted_ = granted;
    }
  }

  double granted(const Contact& a, const Contact& b) const {
    const int extended = (a.dimension > 0) + (b.dimension > 0);
    return tolerance_.same_distance(std::min(a.distance, b.distance)) + extended * tolerance_.known;
  }

  /// What a contact lies on, looked up when it is first asked for. Valid until the next contact is.
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
      const std::int32_t lead = feature.kind == FeatureKind::FACE ? side.shape.lead_of_region(feature.index)
                                                                  : side.shape.lead_of_chain(feature.index);
      std::vector<std::int32_t> corners;
      side.shape.append_corners(side.surface, {feature.kind, lead}, corners);
      std::ranges::sort(corners);
      return corners;
    };
    return a == b || intersect(corners_of(a), corners_of(b));
  }

  // --- joining

  void join_company() {
    join_what_meets();
    join_over_level_ways();
  }

  /// First the minima alone, so that they become the same LMDs as without the other critical pairs. Of these those that lie on an
  /// extended LMD are of it, and a lowest pair in the place of an LMD is it, under another name at the pose at which indices are taken.
  /// A saddle beside an LMD of points stays what it is, however near: it tells which minima meet there.
  void join_signed_company() {
    const std::pmr::vector<std::size_t> all = company_;
    std::erase_if(company_, [&](std::size_t i) { return !contacts_[i].is_minimum; });
    join_company();
    has_minimum_.resize(contacts_.size());
    is_extended_.resize(contacts_.size());
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (!contacts_[i].is_minimum) continue;
      has_minimum_[sets_.find_set(i)] = true;
      if (contacts_[i].dimension > 0) is_extended_[sets_.find_set(i)] = true;
    }
    company_ = all;
    join_company();
  }

  void join(std::size_t i, std::size_t j) {
    const std::size_t a = sets_.find_set(i), b = sets_.find_set(j);
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

  Eigen::AlignedBox3d box_of(const Contact& contact, double reach) const {
    Eigen::AlignedBox3d box;
    if (contact.dimension == 0) {
      box.extend(contact.point_fixed);
    } else if (contact.dimension == 1) {
      for (const Vec3& end : contact.ends_fixed) box.extend(end);
    } else {
      const PlanarFrame& frame = set_.frames[contact.frame];
      const Vec3 n = frame.u.cross(frame.v), lift = n.dot(contact.point_fixed - frame.origin) * n;
      for (const ConvexPolygon& piece : set_.pieces_of(contact))
        for (const Vec2& corner : piece.corners) box.extend(Vec3(frame.lifted(corner) + lift));
    }
    const Vec3 margin = Vec3::Constant(reach);
    return {box.min() - margin, box.max() + margin};
  }

  /// Joins contacts whose places meet: sweeps over their boxes along x.
  void join_what_meets() {
    struct Entry {
      Eigen::AlignedBox3d box;
      std::size_t contact;
    };
    std::pmr::vector<Entry> entries(&memory_);
    entries.reserve(company_.size());
    for (const std::size_t i : company_) entries.push_back({box_of(contacts_[i], tolerance_.known), i});
    std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
      return std::pair(a.box.min().x(), a.contact) < std::pair(b.box.min().x(), b.contact);
    });
    std::pmr::vector<std::size_t> open(&memory_);
    for (std::size_t k = 0; k < entries.size(); ++k) {
      std::erase_if(open, [&](std::size_t o) { return entries[o].box.max().x() < entries[k].box.min().x(); });
      for (const std::size_t o : open) {
        if (!entries[o].box.intersects(entries[k].box)) continue;
        const std::size_t i = entries[o].contact, j = entries[k].contact;
        const Contact &a = contacts_[i], &b = contacts_[j];
        if (sets_.find_set(i) == sets_.find_set(j) || std::abs(a.distance - b.distance) > granted(a, b))
          continue;
        if (are_one_place(i, j)) join(i, j);
      }
      open.push_back(k);
    }
  }

  bool are_one_place(std::size_t i, std::size_t j) {
    const Contact &a = contacts_[i], &b = contacts_[j];
    const bool both_extended = a.dimension > 0 && b.dimension > 0;
    // The parts of what one pair of features shares are known to be apart.
    if (both_extended && name_of(a) == name_of(b)) return false;
    return have_one_direction(a, b) && meet(a, b) &&
           (lie_on_one_pair(i, j) || (both_extended && are_neighbours(pair_.moving, a.moving, b.moving) &&
                                      are_neighbours(pair_.fixed, a.fixed, b.fixed)));
  }

  /// Whether two contacts have one direction. A nut at its seat is as far from the floor of its slot as from the wall, and on the
  /// nut the two places meet.
  bool have_one_direction(const Contact& a, const Contact& b) const {
    const Vec3 difference = a.distance * a.direction - b.distance * b.direction;
    return difference.norm() <= granted(a, b) + SAME_DIRECTION * a.distance;
  }

  /// Whether the places of two contacts come within the tolerance of each other.
  bool meet(const Contact& a, const Contact& b) {
    if (a.dimension < b.dimension) return meet(b, a);
    const double reach = tolerance_.known;
    if (a.dimension == 0)
      return (a.point_moving - b.point_moving).norm() <= reach &&
             (a.point_fixed - b.point_fixed).norm() <= reach;
    if (a.dimension == 1) {
      const auto are_near = [&](const std::array<Vec3, 2>& own, const std::array<Vec3, 2>& ends,
                                const Vec3& point) {
        const Segment segment{own[0], own[1]};
        return b.dimension == 0
                   ? (point_segment_distance(point, segment).point - point).norm() <= reach
                   : segment_distance(segment, {ends[0], ends[1]}).squared_distance <= reach * reach;
      };
      return are_near(a.ends_moving, b.ends_moving, b.point_moving) &&
             are_near(a.ends_fixed, b.ends_fixed, b.point_fixed);
    }
    const PlanarFrame& frame = set_.frames[a.frame];
    const auto touches = [&](const ConvexPolygon& other) {
      return any_piece_near(a, other.box(), reach,
                            [&](const ConvexPolygon& piece) { return piece.touches(other, reach); });
    };
    if (b.dimension == 0) {
      Box2 box;
      const Vec2 x = frame.flat(b.point_fixed);
      box.add(x);
      return any_piece_near(a, box, reach, [&](const ConvexPolygon& piece) { return piece.holds(x, reach); });
    }
    if (b.dimension == 1)
      return touches(ConvexPolygon({frame.flat(b.ends_fixed[0]), frame.flat(b.ends_fixed[1])}));
    const PlanarFrame& other = set_.frames[b.frame];
    return std::ranges::any_of(set_.pieces_of(b), [&](ConvexPolygon piece) {
      for (Vec2& corner : piece.corners) corner = frame.flat(other.lifted(corner));
      return touches(piece);
    });
  }

  /// Whether a piece of a polygon that may come within reach of a box fits.
  template <class Fits>
  bool any_piece_near(const Contact& contact, const Box2& box, double reach, Fits&& fits) {
    const auto pieces = set_.pieces_of(contact);
    if (pieces.size() <= PIECES_WITHOUT_GRID) return std::ranges::any_of(pieces, fits);
    // Asked for by each corner and chain of a large contact.
    std::optional<BoxGrid>& grid = grids_[contact.frame];
    if (!grid) {
      std::vector<Box2> boxes;
      for (const ConvexPolygon& piece : pieces) boxes.push_back(piece.box());
      grid.emplace(boxes);
    }
    return !grid->for_each_near(box, reach,
                                [&](std::int32_t i) { return !fits(pieces[static_cast<std::size_t>(i)]); });
  }

  /// Joins points and segments apart from each other between which the distance stays the same: next to touch, where the ends of
  /// one chain over another one may both seem to be minima.
  void join_over_level_ways() {
    std::pmr::vector<OnCarriers> entries(&memory_), parts(&memory_);
    for (const std::size_t i : company_) {
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
    for (std::size_t begin = 0; begin < entries.size();) {
      std::size_t end = begin;
      while (end < entries.size() && entries[end].moving == entries[begin].moving &&
             entries[end].fixed == entries[begin].fixed)
        ++end;
      // Not std::ranges::equal_range, which clang 14 cannot read.
      const auto first = std::ranges::lower_bound(parts, carriers_of(entries[begin]), {}, carriers_of);
      const auto last = std::ranges::upper_bound(parts, carriers_of(entries[begin]), {}, carriers_of);
      join_in_bucket(std::span(entries).subspan(begin, end - begin), std::span(first, last));
      begin = end;
    }
  }

  /// Of contacts on one pair of features nearly all are one already, those of a face that lies on another one by the thousand:
  /// only the others look for a way.
  /// Those that belong to parts of what a pair of regions shares are apart as the parts are.
  /// @param parts  polygons of that pair
  void join_in_bucket(std::span<const OnCarriers> bucket, std::span<const OnCarriers> parts) {
    std::pmr::vector<std::size_t> roots(&memory_), roots_of_parts(&memory_);
    roots.reserve(bucket.size());
    for (const OnCarriers& entry : bucket) roots.push_back(sets_.find_set(entry.contact));
    if (std::ranges::count(roots, roots.front()) == std::ssize(roots)) return;
    for (const OnCarriers& part : parts) roots_of_parts.push_back(sets_.find_set(part.contact));
    std::ranges::sort(roots_of_parts);
    const auto is_of_part = [&](std::size_t k) {
      return std::ranges::binary_search(roots_of_parts, roots[k]);
    };
    std::pmr::vector<std::size_t> sorted(roots, &memory_);
    std::ranges::sort(sorted);
    std::size_t most = sorted.front(), count = 0;
    for (std::size_t i = 0, run = 0; i < sorted.size(); ++i) {
      run = i > 0 && sorted[i] == sorted[i - 1] ? run + 1 : 1;
      if (run > count) {
        count = run;
        most = sorted[i];
      }
    }
    for (std::size_t k = 0; k < bucket.size(); ++k) {
      if (roots[k] == most) continue;
      const std::size_t i = bucket[k].contact;
      const bool of_part = is_of_part(k);
      for (std::size_t m = 0; m < bucket.size(); ++m) {
        if (of_part && is_of_part(m)) continue;
        const OnCarriers& other = bucket[m];
        const Contact &a = contacts_[i], &b = contacts_[other.contact];
        if (sets_.find_set(i) == sets_.find_set(other.contact) ||
            std::abs(a.distance - b.distance) > granted(a, b))
          continue;
        if (is_level_way(bucket.front(), a, b)) join(i, other.contact);
      }
    }
  }

  bool is_level_way(const OnCarriers& on, const Contact& a, const Contact& b) const {
    if (a.dimension > 0 && b.dimension > 0 && name_of(a) == name_of(b)) return false;
    if (!have_one_direction(a, b)) return false;
    const auto nearest = [](const Contact& contact, const std::array<Vec3, 2>& ends, const Vec3& point,
                            const Vec3& to) {
      return contact.dimension == 0 ? point : point_segment_distance(to, {ends[0], ends[1]}).point;
    };
    const Vec3 p = nearest(a, a.ends_moving, a.point_moving, b.point_moving);
    const Vec3 q = nearest(a, a.ends_fixed, a.point_fixed, b.point_fixed);
    return holds_segment(pair_.moving, on.moving, p, nearest(b, b.ends_moving, b.point_moving, p)) &&
           holds_segment(pair_.fixed, on.fixed, q, nearest(b, b.ends_fixed, b.point_fixed, q));
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

  void report_all(LmdSet& lmds) {
    std::pmr::vector<std::size_t> order(contacts_.size(), &memory_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    sets_.compress_sets(order.begin(), order.end());
    std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(parents_[i], i); });
    for (std::size_t begin = 0; begin < order.size();) {
      std::size_t end = begin;
      while (end < order.size() && parents_[order[end]] == parents_[order[begin]]) ++end;
      report_set(std::span(order).subspan(begin, end - begin), lmds);
      begin = end;
    }
  }

  /// @param set  indices of contacts of one LMD, nearest first
  void report_set(std::span<const std::size_t> set, LmdSet& lmds) {
    const auto is_point = [&](std::size_t i) {
      return contacts_[i].dimension == 0 && contacts_[i].is_minimum;
    };
    if (std::ranges::none_of(set, is_point)) {
      if (sum_of(set) != 0) report_signed(contacts_[set.front()], contacts_[set.front()], set, false, lmds);
      return;
    }
    const auto first = std::ranges::find_if(set, [&](std::size_t i) { return contacts_[i].is_minimum; });
    const double least = contacts_[*first].distance;
    const double highest = least + tolerance_.same_distance(least);
    int dimension = 0;
    for (const std::size_t i : set)
      if (contacts_[i].distance <= highest && contacts_[i].is_minimum)
        dimension = std::max(dimension, contacts_[i].dimension);
    Pieces pieces(&memory_), points(&memory_);
    for (const std::size_t i : set) {
      if (contacts_[i].distance > highest || !contacts_[i].is_minimum) continue;
      if (contacts_[i].dimension == dimension) pieces.push_back(&contacts_[i]);
      if (contacts_[i].dimension == 0) points.push_back(&contacts_[i]);
    }
    std::optional<Contact> whole;
    if (dimension == 2) whole = middle_of_polygons(pieces);
    if (dimension == 1) whole = middle_of_segments(pieces);
    if (!whole) {
      const Contact& nearest = nearest_contact(points.empty() ? pieces : points);
      report_signed(nearest, nearest, set, true, lmds);
      return;
    }
    const Contact* namesake = nullptr;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Contact* piece : pieces) {
      const double apart = (nearest_place(*piece, whole->point_fixed) - whole->point_fixed).norm();
      const double spare = EQUALLY_NEAR * nearest + tolerance_.rounding;
      if (namesake != nullptr && !(apart < nearest - spare) &&
          !(apart <= nearest + spare && name_of(*piece) < name_of(*namesake)))
        continue;
      nearest = namesake == nullptr ? apart : std::min(apart, nearest);
      namesake = piece;
    }
    report_signed(*whole, *namesake, set, true, lmds);
  }

  int sum_of(std::span<const std::size_t> set) const {
    int sum = 0;
    for (const std::size_t i : set) sum += contacts_[i].index;
    return sum;
  }

  /// Reports an LMD, or a critical pair that is none, and the sign of its set.
  void report_signed(const Contact& contact, const Contact& namesake, std::span<const std::size_t> set,
                     bool is_minimum, LmdSet& lmds) const {
    const std::size_t before = lmds.size();
    report(contact, namesake, lmds);
    if (signs_ == nullptr || lmds.size() == before) return;
    const bool has_index = std::ranges::all_of(set, [&](std::size_t i) {
      return signs_->moving.has_index(contacts_[i].moving) && signs_->fixed.has_index(contacts_[i].fixed);
    });
    const bool is_basin =
        sum_of(set) > 0 && std::ranges::any_of(set, [&](std::size_t i) { return contacts_[i].is_basin; });
    signs_->of_lmds.push_back(
        {has_index ? sum_of(set) : 1, is_minimum, has_index, has_index ? is_basin : is_minimum});
  }

  static Contact middle_of_polygons(const Pieces& pieces) {
    Contact whole = *pieces.front();
    if (pieces.size() == 1) return whole;
    double total = 0.0;
    whole.point_moving = whole.point_fixed = whole.direction = Vec3::Zero();
    whole.distance = 0.0;
    for (const Contact* piece : pieces) {
      total += piece->measure;
      whole.point_moving += piece->measure * piece->point_moving;
      whole.point_fixed += piece->measure * piece->point_fixed;
      whole.direction += piece->measure * piece->direction;
      whole.distance += piece->measure * piece->distance;
    }
    whole.point_moving /= total;
    whole.point_fixed /= total;
    whole.distance /= total;
    whole.direction.normalize();
    return whole;
  }

  /// The longest. Borders that lie over each other have one length, but for rounding, with each other and with the faces behind
  /// them: of these the first by kind and then by place, so that neither rounding nor the cut into triangles chooses.
  const Contact& longest_segment(const Pieces& pieces) const {
    const double length =
        (*std::ranges::max_element(pieces, {}, &Contact::measure))->measure - tolerance_.known;
    const auto kinds = [](const Contact& c) { return std::pair(c.moving.kind, c.fixed.kind); };
    const Contact* longest = nullptr;
    for (const Contact* piece : pieces)
      if (piece->measure >= length && (longest == nullptr || kinds(*piece) < kinds(*longest) ||
                                       (kinds(*piece) == kinds(*longest) && lies_before(*piece, *longest))))
        longest = piece;
    return *longest;
  }

  /// The centroid of what segments on one line cover, each part once; nothing where they are on several lines or it is on none
  /// of them.
  std::optional<Contact> middle_of_segments(const Pieces& pieces) const {
    const Contact& longest = longest_segment(pieces);
    if (pieces.size() == 1) return longest;
    const Vec3 origin = longest.ends_fixed[0], along = (longest.ends_fixed[1] - origin).normalized();
    std::vector<std::pair<double, double>> parts;
    for (const Contact* piece : pieces) {
      Extent part;
      for (const Vec3& end : piece->ends_fixed) {
        const double place = along.dot(end - origin);
        if ((origin + place * along - end).norm() > tolerance_.known) return std::nullopt;
        part.add(place);
      }
      parts.emplace_back(part.least, part.greatest);
    }
    std::ranges::sort(parts);
    double covered = 0.0, moment = 0.0, reached = parts.front().first;
    for (const auto& [begin, end] : parts) {
      const double from = std::max(begin, reached);
      if (end <= from) continue;
      covered += end - from;
      moment += 0.5 * (end + from) * (end - from);
      reached = end;
    }
    const double middle = moment / covered;
    if (std::ranges::none_of(parts, [&](const auto& part) {
          return part.first - tolerance_.known <= middle && middle <= part.second + tolerance_.known;
        }))
      return std::nullopt;
    Contact whole = longest;
    const double share = middle / longest.measure;
    whole.point_fixed = origin + middle * along;
    whole.point_moving = longest.ends_moving[0] + share * (longest.ends_moving[1] - longest.ends_moving[0]);
    whole.distance = (whole.point_fixed - whole.point_moving).norm();
    return whole;
  }

  /// An order of places that depends neither on the pose nor on how the meshes are cut: by coordinates in the moving mesh's frame,
  /// where they differ by more than the tolerance.
  bool lies_before(const Contact& a, const Contact& b) const {
    const Vec3 p = pair_.moving.point_to_surface(a.point_moving),
               q = pair_.moving.point_to_surface(b.point_moving);
    for (int k = 0; k < 3; ++k)
      if (std::abs(p[k] - q[k]) > tolerance_.known) return p[k] < q[k];
    return false;
  }

  /// The nearest. Of several at one distance that are apart, one between features of the highest kind, which is where the
  /// minimum stays when the meshes are tilted further, and of those the first by place; of those in one place the first by name.
  const Contact& nearest_contact(Pieces& contacts) {
    const double least =
        (*std::ranges::min_element(contacts, {}, [](const Contact* c) { return c->distance; }))->distance;
    std::erase_if(contacts,
                  [&](const Contact* contact) { return contact->distance > least + tolerance_.rounding; });
    const auto kinds = [](const Contact* contact) {
      return static_cast<int>(contact->moving.kind) + static_cast<int>(contact->fixed.kind);
    };
    const Contact* place = contacts.front();
    for (const Contact* contact : contacts)
      if (kinds(contact) > kinds(place) || (kinds(contact) == kinds(place) && lies_before(*contact, *place)))
        place = contact;
    std::erase_if(contacts,
                  [&](const Contact* contact) { return contact->dimension == 0 && !meet(*contact, *place); });
    return **std::ranges::min_element(
        contacts, {}, [](const Contact* contact) { return std::pair(contact->moving, contact->fixed); });
  }

  /// The point of a piece's place that is nearest to a point of the fixed mesh. It lies on the piece's features, as a centroid need
  /// not; and the parts of one overlap are convex where they lie on one pair of triangles, so that no two have one name.
  Vec3 nearest_place(const Contact& piece, const Vec3& q) const {
    if (piece.dimension == 0) return piece.point_fixed;
    if (piece.dimension == 1)
      return point_segment_distance(q, {piece.ends_fixed[0], piece.ends_fixed[1]}).point;
    const PlanarFrame& frame = set_.frames[piece.frame];
    const Vec2 x = frame.flat(q);
    Vec2 nearest = x;
    double least = std::numeric_limits<double>::infinity();
    for (const ConvexPolygon& polygon : set_.pieces_of(piece)) {
      if (polygon.holds(x, 0.0)) return q;
      for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
        const Vec2 &from = polygon.corners[k],
                   side = polygon.corners[(k + 1) % polygon.corners.size()] - from;
        const Vec2 on_side = from + std::clamp((x - from).dot(side) / side.squaredNorm(), 0.0, 1.0) * side;
        if ((on_side - x).norm() >= least) continue;
        least = (on_side - x).norm();
        nearest = on_side;
      }
    }
    return q + frame.lifted(nearest) - frame.lifted(x);
  }

  /// @param namesake  the contact whose features name the LMD
  void report(const Contact& contact, const Contact& namesake, LmdSet& lmds) const {
    if (contact.distance > tolerance_.cutoff) return;
    Lmd& lmd = lmds.emplace_back();
    lmd.distance = contact.distance;
    lmd.point_moving = contact.point_moving;
    lmd.point_fixed = contact.point_fixed;
    lmd.direction = contact.direction;
    lmd.fixed_body = body_;
    const Vec3 q = nearest_place(namesake, contact.point_fixed);
    const Vec3 p = contact.point_moving + (q - contact.point_fixed);
    std::tie(lmd.feature_moving, lmd.triangle_moving) = name_at(pair_.moving, namesake.moving, p);
    std::tie(lmd.feature_fixed, lmd.triangle_fixed) = name_at(pair_.fixed, namesake.fixed, q);
  }

  /// The face, edge or vertex that names a point of a feature, and a triangle with it.
  static std::pair<FeatureId, std::int32_t> name_at(const ShapeSide& side, const FeatureId& feature,
                                                    const Vec3& p_W) {
    if (feature.kind == FeatureKind::VERTEX)
      return {feature, side.surface.adjacency.vertex_triangles[feature.index].front()};
    const Vec3 p_S = side.point_to_surface(p_W);
    if (feature.kind == FeatureKind::FACE) {
      const std::int32_t face = side.shape.face_at(side.surface, feature.index, p_S);
      return {{FeatureKind::FACE, face}, face};
    }
    const std::int32_t edge = side.shape.regions.edge_at(side.surface, feature.index, p_S);
    return {{FeatureKind::EDGE, edge}, side.surface.adjacency.edge_triangles[edge].front()};
  }

  const ShapePair& pair_;
  const ContactTolerance& tolerance_;
  std::int32_t body_;
  ContactSet& set_;
  std::vector<Contact>& contacts_;
  Signs* signs_;
  /// Of the roots, while critical pairs that are no minima are joined.
  std::vector<bool> has_minimum_, is_extended_;
  double last_granted_ = 0.0;
  /// Where a few hundred contacts find room without an allocation.
  std::array<std::byte, 1 << 15> room_;
  std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
  std::pmr::vector<std::size_t> company_{&memory_}, ranks_{&memory_}, parents_{&memory_};
  boost::disjoint_sets<std::size_t*, std::size_t*> sets_{nullptr, nullptr};
  std::pmr::vector<std::optional<BoxGrid>> grids_{
      &memory_};  ///< Of the polygons of many pieces, one a frame.
  Carriers carriers_moving_{{}, Rows(&memory_)}, carriers_fixed_{{}, Rows(&memory_)};
};

}  // namespace

void join_contacts(const ShapePair& pair, std::int32_t fixed_body, ContactSet& contacts,
                   std::span<const Intersection> intersections, LmdSet& lmds) {
  Joining(pair, fixed_body, contacts).run(intersections, lmds);
}

void join_critical(const ShapePair& pair, const SignedFeatures& moving, const SignedFeatures& fixed,
                   std::int32_t fixed_body, ContactSet& contacts, std::span<const Intersection> intersections,
                   CriticalSet& critical) {
  Joining::Signs signs{moving, fixed, {}};
  LmdSet lmds;
  Joining(pair, fixed_body, contacts, &signs).run(intersections, lmds);
  for (std::size_t i = 0; i < lmds.size(); ++i)
    critical.push_back({lmds[i], signs.of_lmds[i].index, signs.of_lmds[i].is_minimum,
                        signs.of_lmds[i].has_index, signs.of_lmds[i].is_basin});
}

void decide_critical(const ShapePair& pair, const SignedPair& signs, const FeatureId& on_moving,
                     const FeatureId& on_fixed, ContactSet& found) {
  const std::size_t before = found.contacts.size();
  decide(pair, on_moving, on_fixed, found);
  const std::size_t between = found.contacts.size();
  signs.append(on_moving, on_fixed, found);
  if (found.contacts.size() == between || between != before + 1 || found.contacts[before].dimension != 0 ||
      !found.contacts.back().is_basin)
    return;
  found.contacts[before].index = found.contacts.back().index;
  found.contacts[before].is_basin = found.contacts.back().is_basin;
  found.contacts.pop_back();
}

void append_touching(const LmdSet& lmds, CriticalSet& critical) {
  for (const Lmd& lmd : lmds) critical.push_back({lmd, 1, true, true, true});
}

}  // namespace lmdbench
