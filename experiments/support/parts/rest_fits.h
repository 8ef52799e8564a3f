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

/// Parts at rest in each other with known contacts: fits drawn cell by cell, with gaps in
/// all directions from 0 over rounding to visible ones, in turned frames.
namespace lmdbench::parts {

/// A fit as a drawing: 'A' and 'B' are cells of the parts, '.' is empty. Columns go along x, rows
/// along z from the top, split by '/', layers along y by ';'. One layer is a profile: random ends.
struct RestFit {
  const char* name;
  const char* drawing;
  /// How x lines and y lines lean going up, a character a line: '/' towards larger values, '\'
  /// towards smaller, '|' upright; empty: all upright, or all of x by one random slope.
  const char* leans_x = "";
  const char* leans_y = "";
};

std::span<const RestFit> rest_fits();
/// @throws UsageError for an unknown name
const RestFit& rest_fit(std::string_view name);

/// A place where the parts are near each other: an LMD at `gap` by construction, up to tolerances.
struct RestPlace {
  int dimension = 2;        ///< Of faces 2; of edges that pass each other 1; of corners 0.
  double gap = 0.0;         ///< [m]
  Vec3 direction;           ///< From the moving to the fixed part, unit vector, design frame.
  Eigen::AlignedBox3d box;  ///< Of both parts' features there, design frame.
  /// False if rounding decides whether it is a minimum: ways lead down from it within rounding.
  bool demanded = true;
};

struct RestScene {
  Scene scene;  ///< With its cutoff, below which only the places are.
  Pose X_WM;
  Pose X_WD;  ///< The design in the world.
  std::vector<RestPlace> places;
  double size = 0.0;              ///< Mean width of a cell [m]; gaps are shares of it.
  bool single_precision = false;  ///< Vertices were rounded to floats and put back into planes.
  std::string text;               ///< The random draws, for messages.
};

/// Depends on its arguments alone.
RestScene make_rest_scene(const RestFit& fit, std::uint64_t seed, std::size_t index);

}  // namespace lmdbench::parts
