// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/build/wide_partition.h>
#include <lmdbench/shape/shape_complex.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace lmdbench {

namespace {

/// Most bins of a selection.
constexpr std::size_t BINS = 256;

/// Sets up to this size try all turns: most node tests are of those. Larger ones take the first
/// (`scripts/tuned_constants.py --only LARGEST_TURNED`).
constexpr std::size_t LARGEST_TURNED = 512;

/// Cost of a set's cone of directions, where they are parallel; 1 more where they are all
/// (`scripts/tuned_constants.py --only PARALLEL_COST`).
constexpr float PARALLEL_COST = 0.2F;

/// Cosine and sine of the turns of a division's direction: 0, 45 and -45 degrees.
constexpr std::array<std::array<float, 2>, 3> TURNS{
    {{1.0F, 0.0F}, {0.70711F, 0.70711F}, {0.70711F, -0.70711F}}};

using Vec3f = Eigen::Vector3f;

/// An item while sets are divided: small, as it is moved once a level.
struct Place {
  Vec3f centre;        ///< in the hierarchy's frame
  Vec3f axis;          ///< of its cap
  std::uint32_t item;  ///< index, in the order of features
};

/// The two directions in which places spread most, widest first.
struct Spread {
  Vec3f widest, second;

  explicit Spread(std::span<const Place> places) {
    Vec3f mean = Vec3f::Zero();
    for (const Place& place : places) mean += place.centre;
    mean /= static_cast<float>(places.size());
    // Six sums in registers; a matrix in memory waits for its last store at every place.
    Vec3f squares = Vec3f::Zero(), products = Vec3f::Zero();
    for (const Place& place : places) {
      const Vec3f d = place.centre - mean;
      squares += d.cwiseProduct(d);
      products += d.cwiseProduct(Vec3f(d.y(), d.z(), d.x()));
    }
    Eigen::Matrix3f covariance;
    covariance << squares.x(), products.x(), products.z(),  //
        products.x(), squares.y(), products.y(),            //
        products.z(), products.y(), squares.z();
    // Not computeDirect: its axes of a round set lie askew in the frame, and a search through gears
    // tests a twentieth more nodes.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(covariance);
    widest = axes.eigenvectors().col(2);
    second = axes.eigenvectors().col(1);
  }
};

/// Where a place is along a direction.
struct Key {
  float at;
  std::uint32_t place;  ///< Index in its set.
};

/// Of places as one child: its tests grow with the squares of its radius and of its cone, which the
/// mean of the axes tells of.
float cost_of(std::span<const Place> places, std::span<const Key> keys) {
  Eigen::Array3f low = places[keys[0].place].centre, high = low;
  Vec3f axes = Vec3f::Zero();
  for (const Key& key : keys) {
    const Place& place = places[key.place];
    low = low.min(place.centre.array());
    high = high.max(place.centre.array());
    axes += place.axis;
  }
  const Vec3f middle = 0.5F * (low + high);
  float squared_radius = 0.0F;
  for (const Key& key : keys)
    squared_radius = std::max(squared_radius, (places[key.place].centre - middle).squaredNorm());
  axes /= static_cast<float>(keys.size());
  const float turned = PARALLEL_COST + std::sqrt(std::max(0.0F, 1.0F - axes.squaredNorm()));
  return squared_radius * turned * turned;
}

Place make_place(const Surface& surface, const ShapeComplex* shape, const Vec3& origin, const WideItem& item,
                 std::size_t index) {
  constexpr double INFINITE = std::numeric_limits<double>::infinity();
  const FeatureCorners corners(surface, item.ref.feature_id());
  std::span<const std::int32_t> vertices = corners.view();
  std::vector<std::int32_t> of_joined;
  if (shape != nullptr && shape->is_lead_of_several(item.ref.feature_id())) {
    shape->append_corners(surface, item.ref.feature_id(), of_joined);
    vertices = of_joined;
  }
  Vec3 low = Vec3::Constant(INFINITE), high = -low;
  for (const std::int32_t vertex : vertices) {
    const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(vertex)];
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {(0.5 * (low + high) - origin).cast<float>(), item.cap.axis.cast<float>(),
          static_cast<std::uint32_t>(index)};
}

class Partition {
 public:
  explicit Partition(std::vector<Place>& places)
      : places_(places),
        spare_(places.size()),
        keys_(places.size()),
        halves_(places.size()),
        bins_(places.size()) {}

  void run() { divide(places_); }

 private:
  using Places = std::span<Place>;

  void divide(Places places) {
    LMDBENCH_EXPECTS(!places.empty(), "a division that leaves a child empty");
    const WideDivision division(places.size());
    if (division.unit == 1) {
      std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.item < b.item; });
      return;
    }
    bisect(places, division.unit, division.children);
  }

  /// Halves at multiples of the unit until one is left, and divides that.
  void bisect(Places places, std::size_t unit, std::size_t units) {
    if (units <= 1) {
      divide(places);
      return;
    }
    const std::size_t left_units = (units + 1) / 2;
    const std::size_t middle = left_units * unit;
    LMDBENCH_EXPECTS(middle < places.size(), "units that were not counted from this set");
    select(places, middle);
    const auto left = [&] { bisect(places.first(middle), unit, left_units); };
    const auto right = [&] { bisect(places.subspan(middle), unit, units - left_units); };
    if (places.size() > SMALLEST_PARALLEL_SET) {
      parallel_invoke(left, right);
    } else {
      left();
      right();
    }
  }

  /// Moves the least `count` places to the front, along the direction with the cheaper halves.
  void select(Places places, std::size_t count) {
    const Spread spread(places);
    const Places chosen = range_of(spare_, places);
    const std::size_t turns = places.size() > LARGEST_TURNED ? 1 : TURNS.size();
    std::optional<float> least;
    for (const auto& [cosine, sine] : std::span(TURNS).first(turns)) {
      const Vec3f along = cosine * spread.widest + sine * spread.second;
      const std::span<const Key> keys = halves_along(places, along, count);
      if (turns > 1) {
        const float cost = cost_of(places, keys.first(count)) + cost_of(places, keys.subspan(count));
        if (least && !(cost < *least)) continue;
        least = cost;
      }
      for (std::size_t i = 0; i < keys.size(); ++i) chosen[i] = places[keys[i].place];
    }
    std::copy(chosen.begin(), chosen.end(), places.begin());
  }

  /// Keys of the least `count` places along the direction, and then of the others. By one count and
  /// one move: the library's selection mispredicts a branch a comparison; here it has one bin left.
  std::span<const Key> halves_along(Places places, const Vec3f& along, std::size_t count) {
    const std::span keys = range_of(keys_, places), halves = range_of(halves_, places);
    const std::span bins = range_of(bins_, places);
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const float at = along.dot(places[i].centre);
      keys[i] = {at, static_cast<std::uint32_t>(i)};
      low = std::min(low, at);
      high = std::max(high, at);
    }
    const std::size_t last = std::min(BINS, keys.size()) - 1;
    const float bins_per_metre = static_cast<float>(last + 1) / (high - low);
    std::array<std::uint32_t, BINS> sizes{};
    for (std::size_t i = 0; i < keys.size(); ++i) {
      // Of a set without extent no number, or infinite: the last bin.
      const float bin = std::min(static_cast<float>(last), (keys[i].at - low) * bins_per_metre);
      bins[i] = static_cast<std::uint8_t>(bin);
      ++sizes[bins[i]];
    }
    std::size_t before = 0, bin = 0;
    while (before + sizes[bin] <= count) before += sizes[bin++];

    const std::span same = halves.subspan(before, sizes[bin]);
    std::array<Key*, 3> next{halves.data(), same.data(), same.data() + same.size()};
    for (std::size_t i = 0; i < keys.size(); ++i)
      *next[(bins[i] >= bin ? 1u : 0u) + (bins[i] > bin ? 1u : 0u)]++ = keys[i];
    const auto least = [&](const Key& a, const Key& b) {
      return a.at != b.at ? a.at < b.at : places[a.place].item < places[b.place].item;
    };
    std::nth_element(same.begin(), same.begin() + static_cast<std::ptrdiff_t>(count - before), same.end(),
                     least);
    return halves;
  }

  /// Of an array beside the places, what belongs to these.
  template <class T>
  std::span<T> range_of(std::vector<T>& array, Places places) const {
    return std::span(array).subspan(static_cast<std::size_t>(places.data() - places_.data()), places.size());
  }

  std::vector<Place>& places_;
  // Each task uses the ranges of its places.
  std::vector<Place> spare_;
  std::vector<Key> keys_, halves_;
  std::vector<std::uint8_t> bins_;
};

}  // namespace

WideDivision::WideDivision(std::size_t size) : unit(1) {
  while (unit * WIDE_WIDTH < size) unit *= WIDE_WIDTH;
  children = (size + unit - 1) / unit;
}

std::size_t count_wide_nodes(std::size_t size) {
  if (size <= 1) return 0;
  const WideDivision division(size);
  const std::size_t full = division.children - 1;
  std::size_t count = 1 + count_wide_nodes(size - full * division.unit);
  if (full > 0) count += full * count_wide_nodes(division.unit);
  return count;
}

void partition_wide_items(const Surface& surface, const ShapeComplex* shape, const Vec3& origin,
                          std::vector<WideItem>& items) {
  std::vector<Place> places(items.size());
  parallel_ranges(items.size(), SMALLEST_PARALLEL_SET, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) places[i] = make_place(surface, shape, origin, items[i], i);
  });
  Partition(places).run();
  std::vector<WideItem> ordered(items.size());
  parallel_ranges(items.size(), SMALLEST_PARALLEL_SET, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ordered[i] = items[places[i].item];
  });
  items.swap(ordered);
}

}  // namespace lmdbench
