// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Parts at rest in each other whose contacts are known: concave fits drawn cell by cell, gaps of every direction from 0 over rounding to
/// what is seen, in turned frames.
namespace lmdbench::parts {

/// A fit as a drawing: 'A' and 'B' are cells of the two parts, '.' is empty. Columns go along x, rows along z from the highest down with
/// '/' between them, layers along y with ';'. A drawing of one layer is a profile, whose ends are drawn by lot (rest_fits.cpp).
struct RestFit {
  const char* name;
  const char* drawing;
  /// How lines of x and of y lean as they go up, one character a line: '/' towards more, '\' towards less, '|' not at all; empty: none
  /// does, or all of x do by one slope, by lot.
  const char* leans_x = "";
  const char* leans_y = "";
};

std::span<const RestFit> rest_fits();
/// @throws UsageError for an unknown name
const RestFit& rest_fit(std::string_view name);

/// Where the parts are near each other: an LMD at `gap` by construction, but for tolerances.
struct RestPlace {
  int dimension = 2;  ///< Of faces, 2; of edges that pass each other, 1; of corners, 0.
  double gap = 0.0;   ///< [m]
  Vec3 direction;     ///< From the moving part to the fixed one, unit vector in the frame of the design.
  Eigen::AlignedBox3d box;  ///< Of both parts' features there, frame of the design.
  /// False where definition and rounding leave open whether it is a minimum: ways lead down from it within rounding.
  bool demanded = true;
};

struct RestScene {
  Scene scene;  ///< With its cutoff, below which there is nothing but the places.
  Pose X_WM;
  Pose X_WD;  ///< The design in the world.
  std::vector<RestPlace> places;
  double size = 0.0;              ///< Mean width of a cell [m]; gaps are shares of it.
  bool single_precision = false;  ///< Vertices were rounded to floats and put back into planes.
  std::string text;               ///< What was drawn by lot, for messages.
};

/// Depends on nothing but the arguments.
RestScene make_rest_scene(const RestFit& fit, std::uint64_t seed, std::size_t index);

}  // namespace lmdbench::parts
