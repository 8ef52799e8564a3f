// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>

#include <fmt/format.h>
#include <support/parts/chances.h>
#include <support/parts/placement.h>
#include <support/parts/prism_complex.h>
#include <support/parts/recut.h>
#include <support/parts/rest_drawing.h>
#include <support/parts/rest_fits.h>
#include <support/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace lmdbench::parts {
namespace {

using experiments::Random;

constexpr RestFit FITS[] = {
    {"box in corner", "B../BA./BBB"},
    {"box in channel", "B.B/BAB/BBB"},
    {"hook over box", "AAA/ABB/.BB"},
    {"hook with long leg", "AAA/ABB/ABB/A.."},
    {"U on rail", "AAA/ABA/.B./BBB"},
    {"U on rail and base", "AAAAA/.ABA./BBBBB"},
    {"stairs on stairs", "AAAA/AAAB/AABB/ABBB/BBBB"},
    {"peg in slot", "BBB/BAB/BBB"},
    {"T-nut in T-slot", "BBABB/BAAAB/BBBBB"},
    {"T-nut with head", "AAAAA/BBABB/BAAAB/BBBBB"},
    {"dovetail in groove", "BAB/BBB", "|/\\|"},
    {"dovetail with shoulders", "AAA/BAB/BBB", "|/\\|"},
    {"prism in V block", "BAB/B.B/BBB", "|\\/|"},
    {"wedge in notch", "BAB/BBB", "|\\/|"},
    {"rack on rack", "AAAAA/ABABA/BBBBB", "|\\/\\/|"},
    {"pin between plates", "BBB/.A./BBB"},
    {"flush stack", "A/B"},
    {"stack of three", "B/A/B"},
    {"tongue and groove", "AAA/BAB/BBB"},
    {"comb in comb", "AAAAAAA/ABABABA/BBBBBBB"},
    {"plus in plus", "BBBBB/BBABB/BAAAB/BBABB/BBBBB"},
    {"lap joint", "AAAB/AABB"},
    {"hook on hook", "AAA./ABAB/.BBB"},
    {"box on ledges", "BAAAB/BB.BB/BBBBB"},
    {"bracket over edge", "AAA./ABBB/AAA."},
    {"key between shaft and hub", "BBB/BAB/.A./BAB/BBB"},
    {"drawer in frame", "BBBBB/BA.AB/BAAAB/BBBBB"},
    {"cross halving", ".B./.B.;AAA/ABA;.B./.B."},
    {"bolt with head", "BBB/BAB/BBB;AAA/AAA/AAA"},
    {"stepped peg in counterbore", "BBBBB/BBBBB/BBABB/BBBBB/BBBBB;BBBBB/BAAAB/BAAAB/BAAAB/BBBBB"},
    {"lid on box", "AAA/AAA;AAA/ABA;AAA/AAA"},
    {"frustum in funnel", "BBB/BBB;BAB/BBB;BBB/BBB", "|\\/|", "|\\/|"},
    {"box in a box's pit on a step", "BBBB/BBBB/BBBB;BAAB/BABB/BBBB;B..B/B.BB/BBBB"},
    {"box over a box's corner", "AA./...;AA./.BB;.../.BB"},
    {"bar across bar", ".A./...;.A./BBB;.A./..."},
    {"edge past edge", "A./.B"},
    {"corner past corner", "A./..;../.B"},
};

/// Gaps over the size; 0 and 1e-16 are below the last digit of most coordinates.
constexpr double ROUNDED = 512.0 * std::numeric_limits<double>::epsilon();
constexpr std::array GAPS = {0.0, 1e-16, 1e-15, 1e-14, 1e-13, ROUNDED, 1e-12, 1e-11, 1e-10, 1e-9, 1e-6, 1e-3};
/// Shares of the size: the cutoff; the narrowest cell, which must exceed a few gaps.
constexpr double CUTOFF_SHARE = 0.1, NARROWEST = 0.25;
/// Over the size: parts of up to seven cells, up to three sizes from the origin.
constexpr double LARGEST_COORDINATE = 12.0;
/// A foot nearer to a reflex edge than so many roundings may be on either side of it.
constexpr double FOOT_ROUNDINGS = 4.0;

/// Planes of both parts: line l of axis a is normal . x = position, plus the offset for part A.
struct CellPlanes {
  std::array<std::vector<double>, 3> positions, slopes, gaps, offsets;

  Vec3 normal(std::size_t axis, int line) const {
    Vec3 n = Vec3::Unit(static_cast<Eigen::Index>(axis));
    if (axis < 2) n.z() = -slopes[axis][static_cast<std::size_t>(line)];
    return n.normalized();
  }
  Vec3 vertex(const Cell& at, char part) const {
    const auto place = [&](std::size_t axis, double z) {
      const auto line = static_cast<std::size_t>(at[axis]);
      const double slope = slopes[axis][line];
      const double offset = part == 'A' ? offsets[axis][line] * std::sqrt(1.0 + slope * slope) : 0.0;
      return positions[axis][line] + slope * z + offset;
    };
    const double z = place(2, 0.0);
    return {place(0, z), place(1, z), z};
  }
  double gap(std::size_t axis, int line) const { return gaps[axis][static_cast<std::size_t>(line)]; }
};

/// Mesh frames: the design's, a common one that vertices are turned into, or one for each mesh.
enum class Frames : std::uint8_t { DESIGN, BAKED, POSED };

/// Ends of a profile, at its first and last layer.
enum class End : std::uint8_t { FLUSH, SHORT, LONG, WALL_OF_B, WALL_OF_A };

std::string end_layer(std::string profile, End end) {
  for (char& cell : profile) {
    if (cell != 'A' && cell != 'B') continue;
    if (end == End::WALL_OF_A || end == End::WALL_OF_B) cell = end == End::WALL_OF_A ? 'A' : 'B';
    if (cell == (end == End::SHORT ? 'A' : end == End::LONG ? 'B' : '.')) cell = '.';
  }
  return profile;
}

RestDrawing draw(const RestFit& fit, Random& random) {
  const std::string profile = fit.drawing;
  if (profile.find(';') != std::string::npos) return RestDrawing(profile);
  for (;;) {
    std::string drawing = profile;
    for (const bool first : {true, false}) {
      const End end = static_cast<End>(random.index(5));
      if (end == End::FLUSH) continue;
      const std::string layer = end_layer(profile, end);
      drawing = first ? layer + ';' + drawing : drawing + ';' + layer;
    }
    RestDrawing result(drawing);
    if (result.is_sound()) return result;
  }
}

/// Whether all cells are wide enough at every height.
bool is_wide(const CellPlanes& lines, double least) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i + 1 < lines.positions[axis].size(); ++i)
      for (const double z : {lines.positions[2].front(), lines.positions[2].back()})
        if (lines.positions[axis][i + 1] - lines.positions[axis][i] +
                (lines.slopes[axis][i + 1] - lines.slopes[axis][i]) * z <
            least)
          return false;
  return true;
}

CellPlanes draw_lines(const RestFit& fit, const RestDrawing& drawing, double size, Random& random) {
  CellPlanes lines;
  const double shear = chance(0.25, random) ? random.uniform(-0.4, 0.4) : 0.0;
  const std::array<std::string_view, 3> leans = {fit.leans_x, fit.leans_y, ""};
  do {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto count = static_cast<std::size_t>(drawing.count(axis)) + 1;
      std::vector<double>&positions = lines.positions[axis], &slopes = lines.slopes[axis];
      positions.assign(1, -size * random.uniform());
      while (positions.size() < count)
        positions.push_back(positions.back() + size * random.uniform(0.4, 1.6));
      slopes.assign(count, axis == 0 && leans[0].empty() && leans[1].empty() ? shear : 0.0);
      for (std::size_t i = 0; i < leans[axis].size(); ++i)
        if (leans[axis][i] != '|')
          slopes[i] = (leans[axis][i] == '/' ? 1.0 : -1.0) * random.uniform(0.1, 0.6);
    }
  } while (!is_wide(lines, NARROWEST * size));
  const std::size_t least = random.index(GAPS.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t count = lines.positions[axis].size();
    lines.gaps[axis].resize(count);
    lines.offsets[axis].resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double gap = lines.gaps[axis][i] = size * GAPS[least + random.index(GAPS.size() - least)];
      const int side = drawing.side_of_a(axis, static_cast<int>(i));
      // A line where nothing meets: flush, or off by some gap.
      lines.offsets[axis][i] = side != 0 ? side * gap : gap * std::round(random.uniform(-1.49, 1.49));
    }
  }
  return lines;
}

TriangleMesh mesh_of(const RestDrawing& drawing, const CellPlanes& lines, char part) {
  const auto steps = [&](std::size_t axis) {
    std::vector<double> result;
    for (int i = 0; i <= drawing.count(axis); ++i) result.push_back(i);
    return result;
  };
  PrismComplex solid(steps(2));
  solid.add_grid(steps(0), steps(1), [&](std::size_t i, std::size_t j) {
    Layers layers = NO_LAYER;
    for (int k = 0; k < drawing.count(2); ++k)
      if (drawing.at({static_cast<int>(i), static_cast<int>(j), k}) == part) layers |= Layers{1} << k;
    return layers;
  });
  return solid.mesh([&](const Vec3& p) {
    return lines.vertex({static_cast<int>(p.x()), static_cast<int>(p.y()), static_cast<int>(p.z())}, part);
  });
}

/// The shortest vector that has each gap along its normal, at least: between two corners (edges,
/// faces) with parallel planes. All sets of planes that may determine it are tried.
/// @param margin receives by how much that set is the right one [m]
Vec3 shortest_between(const Eigen::Matrix3Xd& normals, const Eigen::VectorXd& gaps, double& margin) {
  const Eigen::Index count = gaps.size();
  Vec3 result = Vec3::Zero();
  margin = -std::numeric_limits<double>::infinity();
  for (int set = 1; set < 1 << count; ++set) {
    std::vector<Eigen::Index> on, off;
    for (Eigen::Index i = 0; i < count; ++i) (set >> i & 1 ? on : off).push_back(i);
    const Eigen::Matrix3Xd n = normals(Eigen::all, on);
    const Eigen::VectorXd weights = (n.transpose() * n).ldlt().solve(gaps(on).eval());
    const Vec3 d = n * weights;
    double least = weights.minCoeff();
    for (const Eigen::Index i : off) least = std::min(least, normals.col(i).dot(d) - gaps[i]);
    if (!(least > margin)) continue;
    margin = least;
    result = d;
  }
  return result;
}

/// A place with its numbers; its features are on A's side of each line.
RestPlace place_of(const RestDrawing::Meeting& meeting, const RestDrawing& drawing, const CellPlanes& lines,
                   double rounding, bool in_floats) {
  const auto towards_b = [&](std::size_t axis, int line) {
    return Vec3(-drawing.side_of_a(axis, line) * lines.normal(axis, line));
  };
  const auto count = static_cast<Eigen::Index>(meeting.axes.size());
  Eigen::Matrix3Xd normals(3, count);
  Eigen::VectorXd gaps(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [axis, line] = meeting.axes[static_cast<std::size_t>(i)];
    normals.col(i) = towards_b(axis, line);
    // The direction is defined at gaps of 0, too.
    gaps[i] = std::max(lines.gap(axis, line), std::numeric_limits<double>::min());
  }
  RestPlace place;
  place.dimension = 3 - static_cast<int>(count);
  double margin = 0.0;
  const Vec3 d = shortest_between(normals, gaps, margin);
  place.gap = gaps.maxCoeff() > std::numeric_limits<double>::min() ? d.stableNorm() : 0.0;
  place.direction = d.stableNormalized();
  for (const Cell& corner : meeting.corners)
    for (const char part : {'A', 'B'}) place.box.extend(lines.vertex(corner, part));
  if (place.dimension < 2) {
    place.demanded = !meeting.leads_down && margin > FOOT_ROUNDINGS * rounding;
    return place;
  }
  // A corner of the contact is a minimum unless the foot may fall beyond a reflex edge beside it.
  const auto holds = [&](const RestDrawing::Border& border) {
    return (!border.is_reflex && !in_floats) ||
           lines.gap(border.axis, border.line) -
                   place.gap * place.direction.dot(towards_b(border.axis, border.line)) >
               FOOT_ROUNDINGS * rounding;
  };
  // Float planes are tilted by more than rounding: any corner may be lowest and lead along a wall.
  const auto both_hold = [&](const auto& pair) { return holds(pair[0]) && holds(pair[1]); };
  place.demanded = in_floats ? std::ranges::all_of(meeting.border_pairs, both_hold)
                             : std::ranges::any_of(meeting.border_pairs, both_hold);
  return place;
}

}  // namespace

std::span<const RestFit> rest_fits() {
  return FITS;
}

const RestFit& rest_fit(std::string_view name) {
  std::string names;
  for (const RestFit& fit : FITS) {
    if (name == fit.name) return fit;
    names += (names.empty() ? "" : ", ") + std::string(fit.name);
  }
  throw UsageError("", "--fit", "there is no fit '" + std::string(name) + "'", "one of: " + names);
}

RestScene make_rest_scene(const RestFit& fit, std::uint64_t seed, std::size_t index) {
  const auto number = static_cast<std::uint64_t>(&fit - std::begin(FITS));
  Random random((seed * 1000 + number) * 0x9E3779B97F4A7C15ULL + index);
  const RestDrawing drawing = draw(fit, random);
  RestScene result;
  result.size = std::pow(10.0, random.uniform(-2.0, 1.0));
  const CellPlanes lines = draw_lines(fit, drawing, result.size, random);

  const auto frames = static_cast<Frames>(std::min<std::size_t>(2, random.index(5)));
  result.single_precision = chance(0.2, random);
  const bool swapped = chance(0.5, random), cut = chance(0.3, random);
  // Of the largest coordinates that the draws allow.
  const double rounding = LARGEST_COORDINATE * result.size *
                          (result.single_precision ? 2.0 * std::numeric_limits<float>::epsilon()
                                                   : 128.0 * std::numeric_limits<double>::epsilon());
  for (const RestDrawing::Meeting& meeting : drawing.meetings())
    result.places.push_back(place_of(meeting, drawing, lines, rounding, result.single_precision));
  std::array<TriangleMesh, 2> meshes = {mesh_of(drawing, lines, 'A'), mesh_of(drawing, lines, 'B')};
  if (cut)
    for (TriangleMesh& mesh : meshes) mesh = recut(std::move(mesh), random);
  if (frames != Frames::DESIGN) result.X_WD = random_placement(3.0 * result.size, random);
  const Pose X_MD = frames == Frames::POSED ? random_placement(3.0 * result.size, random) : result.X_WD;
  if (frames == Frames::POSED) result.X_WM = result.X_WD * X_MD.inverse();
  if (swapped) {
    std::swap(meshes[0], meshes[1]);
    for (RestPlace& place : result.places) place.direction = -place.direction;
  }
  result.scene = {placed_body("moving", std::move(meshes[0]), X_MD, result.single_precision),
                  {placed_body("fixed", std::move(meshes[1]), result.X_WD, result.single_precision)},
                  CUTOFF_SHARE * result.size};
  constexpr std::array FRAMES = {"as designed", "both turned", "each turned"};
  result.text =
      fmt::format("{}: seed {}, scene {}: {}{}{}{}, size {:.3g}, gaps", fit.name, seed, index,
                  FRAMES[static_cast<std::size_t>(frames)], result.single_precision ? ", floats" : "",
                  swapped ? ", B moves" : "", cut ? ", cut otherwise" : "", result.size);
  for (const RestPlace& place : result.places)
    result.text += fmt::format(" {:.3g}{}", place.gap, place.demanded ? "" : "?");
  return result;
}

}  // namespace lmdbench::parts
