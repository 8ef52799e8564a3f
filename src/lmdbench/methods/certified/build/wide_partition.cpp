// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/methods/certified/build/wide_partition.h>
#include <lmdbench/shape/shape_complex.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace lmdbench {

namespace {

/// Bins of a selection; the library selects from smaller sets.
constexpr std::size_t BINS = 256;

/// An item while sets are divided: small, as it is moved once a level.
struct Place {
  Eigen::Vector3f centre;  ///< in the hierarchy's frame
  std::uint32_t item;      ///< index, in the order of features
};

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
  return {(0.5 * (low + high) - origin).cast<float>(), static_cast<std::uint32_t>(index)};
}

class Partition {
 public:
  explicit Partition(std::vector<Place>& places) : places_(places), spare_(places.size()) {}

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

  /// Moves the least `count` places to the front, along the longest side of the box.
  void select(Places places, std::size_t count) {
    Eigen::Array3f low = places[0].centre, high = low;
    for (const Place& place : places) {
      low = low.min(place.centre.array());
      high = high.max(place.centre.array());
    }
    int axis = 0;
    const float extent = (high - low).maxCoeff(&axis);
    if (places.size() > BINS) {
      select_by_bins(places, count, axis, low[axis], static_cast<float>(BINS) / extent);
    } else {
      select_by_axis(places, count, axis);
    }
  }

  /// As select_by_axis, by one count and one move: the library's way mispredicts a branch a
  /// comparison.
  void select_by_bins(Places places, std::size_t count, int axis, float low, float bins_per_metre) {
    const auto bin_of = [=](const Place& place) {
      // No number, or infinite, in a set without extent: the last bin.
      const float bin = (place.centre[axis] - low) * bins_per_metre;
      return bin < static_cast<float>(BINS - 1) ? static_cast<std::size_t>(bin) : BINS - 1;
    };
    std::array<std::uint32_t, BINS> sizes{};
    for (const Place& place : places) ++sizes[bin_of(place)];
    std::size_t before = 0, bin = 0;
    while (before + sizes[bin] <= count) before += sizes[bin++];

    const auto sorted =
        std::span(spare_).subspan(static_cast<std::size_t>(places.data() - places_.data()), places.size());
    std::array<Place*, 3> next{sorted.data(), sorted.data() + before, sorted.data() + before + sizes[bin]};
    for (const Place& place : places) {
      const std::size_t own = bin_of(place);
      *next[(own >= bin ? 1u : 0u) + (own > bin ? 1u : 0u)]++ = place;
    }
    std::copy(sorted.begin(), sorted.end(), places.begin());
    select_by_axis(places.subspan(before, sizes[bin]), count - before, axis);
  }

  static void select_by_axis(Places places, std::size_t count, int axis) {
    std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count), places.end(),
                     [axis](const Place& a, const Place& b) {
                       const float at_a = a.centre[axis], at_b = b.centre[axis];
                       return at_a != at_b ? at_a < at_b : a.item < b.item;
                     });
  }

  std::vector<Place>& places_;
  std::vector<Place> spare_;  ///< Each task uses the range of its places.
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
