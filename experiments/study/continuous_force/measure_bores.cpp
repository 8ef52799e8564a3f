// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/sleeve.h>

#include <study/continuous_force/measures.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace lmdbench::continuous_force {

namespace {

constexpr double ROD = 0.010, BORE = 0.0103, BORE_CUTOFF = 0.001;
constexpr double OFF = 0.15 * BORE_CUTOFF;

/// Corner radius of a regular polygon with the circle's area: the gap does not depend on `corners`.
double corner_radius(double circle, int corners) {
  const double angle = 2.0 * std::numbers::pi / corners;
  return circle * std::sqrt(angle / std::sin(angle));
}

Scene rod_in_bore(int rod, int bore) {
  const auto body = [](TriangleMesh mesh) {
    return std::make_shared<const Body>("mesh", build_surface(std::move(mesh)));
  };
  // Squares as high as they are wide.
  const auto layers = [](double height, double radius, int around) {
    return std::max(1, static_cast<int>(std::lround(height * around / (2.0 * std::numbers::pi * radius))));
  };
  return {body(make_sleeve(circle_outline(corner_radius(ROD, rod)), nullptr,
                           {.height = ROD, .around = rod, .layers = layers(ROD, ROD, rod)})),
          {body(make_sleeve(circle_outline(2.0 * ROD), circle_outline(corner_radius(BORE, bore)),
                            {.height = 3.0 * ROD, .around = bore, .layers = layers(3.0 * ROD, BORE, bore)}))},
          BORE_CUTOFF};
}

}  // namespace

std::vector<BoreRow> measure_bores(std::size_t rolls, std::size_t slope_steps, const LayeredChoice& layered) {
  const ForceProfile profile = {
      .law = ForceLaw::LINEAR, .cutoff = BORE_CUTOFF, .saturation_distance = 0.0, .maximum_force = 1.0};
  std::vector<BoreRow> rows;
  for (const auto& [rod, bore] : {std::pair{24, 32}, {32, 48}, {64, 64}, {96, 128}, {128, 96}, {200, 200}}) {
    BoreRow row{rod, bore, {}, {}, {}};
    Renderer renderer(rod_in_bore(rod, bore), profile, layered);
    const auto pose_at = [](double x, double y, double roll) {
      return Pose{Vec3(x, y, 0.03 * ROD), Eigen::Quaterniond(Eigen::AngleAxisd(roll, Vec3::UnitZ()))};
    };
    std::array<std::vector<double>, LAWS> lengths;
    for (std::size_t k = 0; k < rolls; ++k) {
      const double angle = 0.1 + 1.7 * static_cast<double>(k);
      const Forces force =
          renderer.at(pose_at(OFF * std::cos(angle), OFF * std::sin(angle), 0.37 * static_cast<double>(k)))
              .force;
      for (std::size_t law = 0; law < LAWS; ++law) lengths[law].push_back(force[law].norm());
    }
    for (std::size_t law = 0; law < LAWS; ++law) {
      double mean = 0.0, spread = 0.0;
      for (const double length : lengths[law]) mean += length / static_cast<double>(rolls);
      for (const double length : lengths[law]) spread += (length - mean) * (length - mean);
      row.mean[law] = mean;
      row.deviation[law] = std::sqrt(spread / static_cast<double>(rolls));
    }
    // Across the bore's axis, just beside it.
    const double step = 0.04 * BORE_CUTOFF / static_cast<double>(slope_steps);
    std::optional<Forces> before;
    for (std::size_t k = 0; k <= slope_steps; ++k) {
      const double x = -0.02 * BORE_CUTOFF + static_cast<double>(k) * step;
      const Forces here = renderer.at(pose_at(x, 0.001 * BORE_CUTOFF, 0.1)).force;
      for (std::size_t law = 0; before && law < LAWS; ++law)
        row.slope[law] = std::max(row.slope[law], (here[law] - (*before)[law]).norm() / (step / BORE_CUTOFF));
      before = here;
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lmdbench::continuous_force
