// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/snch/hierarchy.h>
#include <lmdbench/snch/wide_hierarchy.h>

#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace lmdbench {

/// A mesh prepared for proximity queries: immutable, shared between methods, instances and threads. What only
/// some methods need (the hierarchy) is built when the first of them asks for it, once.
class Body {
 public:
  Body(std::string name, Surface surface) : name_(std::move(name)), surface_(std::move(surface)) {}
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  const std::string& name() const { return name_; }
  const Surface& surface() const { return surface_; }
  const Hierarchy& hierarchy() const {
    std::call_once(hierarchy_once_, [this] { hierarchy_ = build_hierarchy(surface_); });
    return hierarchy_;
  }
  const WideHierarchy& wide_hierarchy() const {
    std::call_once(wide_hierarchy_once_, [this] { wide_hierarchy_ = build_wide_hierarchy(surface_); });
    return wide_hierarchy_;
  }

 private:
  std::string name_;
  Surface surface_;
  mutable std::once_flag hierarchy_once_;
  mutable Hierarchy hierarchy_;
  mutable std::once_flag wide_hierarchy_once_;
  mutable WideHierarchy wide_hierarchy_;
};

}  // namespace lmdbench
