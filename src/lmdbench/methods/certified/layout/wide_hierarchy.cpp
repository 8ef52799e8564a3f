// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/deform/wide_refit.h>
#include <lmdbench/methods/certified/layout/wide_hierarchy.h>
#include <lmdbench/shape/shape_complex.h>

#include <limits>

namespace lmdbench {

double WideHierarchy::rounding() const {
  return 4.0 * std::numeric_limits<double>::epsilon() * (radius + origin.norm());
}

void WideHierarchy::follow(const Body& body, const SurfaceChange& change) {
  const auto& shape = body.prepared<ShapeComplex>();
  ++changes.now;
  if (refit_ && shape.times_made_anew() == shape_times_ &&
      refit_->refit(*this, body.surface(), shape, change))
    return;
  if (!change.moved.empty()) {
    const std::uint32_t now = changes.now, times = times_built_anew_ + 1;
    *this = of(body);
    times_built_anew_ = times;
    changes.now = changes.frame = now;
  }
  widths.clear();  // No refit keeps them.
  changes.bounds.assign(nodes.size(), changes.now);
  changes.lanes = changes.bounds;
  shape_times_ = shape.times_made_anew();
  refit_ = std::make_shared<WideRefit>(*this, body.surface(), shape);
}

WideHierarchy WideHierarchy::of(const Body& body) {
  return build_wide_hierarchy(body.surface(), &body.prepared<ShapeComplex>());
}

}  // namespace lmdbench
