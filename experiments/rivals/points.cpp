// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause

// Points against a signed distance field (Barbic and James 2008): samples of A are pushed out of B
// along the field's gradient, by depth below the cutoff times the sample's area. Force and torque
// only: points are on no pair of triangles. OpenVDB's meshToSignedDistanceField, floats, band a
// cutoff wide. Our decisions: depth counts from the cutoff (force begins where an LMD's does); A's
// samples, B's field; samples are middles of n^2 equal cuts of triangles; trilinear values, central
// differences over a voxel, both continuous; areas in squared cutoffs, 1 N a cutoff. Instead of the
// nested point tree, bounding spheres of blocks of samples ask a coarse field.
#include "closest.h"
#include "plugin.hpp"
#include <nlohmann/json.hpp>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>

#include <stdexcept>

namespace {

using namespace rivals;

class Field {
 public:
  /// @param band distances are known within it [m]
  Field(const Mesh& mesh, double voxel, double band) : voxel_(voxel) {
    openvdb::initialize();
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    for (const Point& p : mesh.vertices) points.emplace_back(p[0], p[1], p[2]);
    for (const auto& t : mesh.triangles)
      triangles.emplace_back(static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]),
                             static_cast<unsigned>(t[2]));
    const double width = band / voxel + 3.0;
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      area += 0.5 * norm(cross(mesh.corner(t, 1) - mesh.corner(t, 0), mesh.corner(t, 2) - mesh.corner(t, 0)));
    constexpr double MOST = 2e8;
    if (2.0 * width * area / (voxel * voxel) > MOST)
      throw std::runtime_error("a field of more than 200 million voxels: enlarge voxel_cutoffs");
    grid_ = openvdb::tools::meshToSignedDistanceField<openvdb::FloatGrid>(
        *openvdb::math::Transform::createLinearTransform(voxel), points, triangles, {},
        static_cast<float>(width), static_cast<float>(width));
  }

  /// Reads values; keeps its path through the tree.
  class Reader {
   public:
    explicit Reader(const Field& field) : voxel_(field.voxel_), accessor_(field.grid_->getConstAccessor()) {}
    double distance(const Point& p) const {
      return openvdb::tools::BoxSampler::sample(accessor_,
                                                openvdb::Vec3d(p[0] / voxel_, p[1] / voxel_, p[2] / voxel_));
    }
    /// Not a unit vector where the field bends.
    Point gradient(const Point& p) const {
      Point g{};
      for (std::size_t k = 0; k < 3; ++k) {
        Point low = p, high = p;
        low[k] -= 0.5 * voxel_;
        high[k] += 0.5 * voxel_;
        g[k] = (distance(high) - distance(low)) / voxel_;
      }
      return g;
    }

   private:
    double voxel_;
    openvdb::FloatGrid::ConstAccessor accessor_;
  };
  double voxel() const { return voxel_; }

 private:
  double voxel_;
  openvdb::FloatGrid::Ptr grid_;
};

struct Sample {
  Point p;
  double area;
};

class Points {
 public:
  Points(const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff, const std::string& options)
      : cutoff_(cutoff),
        asked_(nlohmann::json::parse(options)),
        fine_(Mesh(b), asked_.at("voxel_cutoffs").get<double>() * cutoff, cutoff),
        coarse_(coarse_field(Mesh(a), Mesh(b))) {
    sample(Mesh(a), asked_.at("spacing_cutoffs").get<double>() * cutoff);
    make_blocks(0, samples_.size());
  }

  void search(const double* X_BA, std::vector<lmdbench_contact>& /*contacts*/) {
    const Transform X{X_BA};
    wrench_ = {X.origin(), {}, {}};
    const Field::Reader fine(fine_), coarse(coarse_);
    const double rounding = 2.0 * coarse_.voxel();
    for (const Block& block : blocks_) {
      if (coarse.distance(X(block.centre)) - rounding > block.radius + cutoff_) continue;
      for (std::size_t i = block.begin; i < block.end; ++i) {
        const Point p = X(samples_[i].p);
        const double depth = cutoff_ - fine.distance(p);
        if (!(depth > 0.0)) continue;
        const double push = samples_[i].area * depth / cutoff_;
        wrench_.push(p, push * fine.gradient(p));
      }
    }
  }

  void force(double* wrench) const { wrench_.to(wrench); }

 private:
  struct Block {
    std::size_t begin, end;
    Point centre{};
    double radius = 0.0;
  };

  /// 64 voxels along B; its band includes all of A.
  static Field coarse_field(const Mesh& a, const Mesh& b) {
    return Field(b, b.diagonal / 64.0, 0.5 * std::min(a.diagonal, b.diagonal));
  }

  void sample(const Mesh& mesh, double spacing) {
    constexpr double MOST = 2e7;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Point &a = mesh.corner(t, 0), ab = mesh.corner(t, 1) - a, ac = mesh.corner(t, 2) - a;
      const double longest = std::max({norm(ab), norm(ac), norm(ac - ab)});
      const double cuts = std::max(1.0, std::ceil(longest / spacing));
      if (static_cast<double>(samples_.size()) + cuts * cuts > MOST)
        throw std::runtime_error("more than 20 million samples: enlarge spacing_cutoffs");
      const double area = 0.5 * norm(cross(ab, ac)) / (cuts * cuts * cutoff_ * cutoff_);
      const auto n = static_cast<int>(cuts);
      for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
          samples_.push_back({a + ((i + 1.0 / 3.0) / n) * ab + ((j + 1.0 / 3.0) / n) * ac, area});
          if (i + j + 1 < n)
            samples_.push_back({a + ((i + 2.0 / 3.0) / n) * ab + ((j + 2.0 / 3.0) / n) * ac, area});
        }
    }
  }

  void make_blocks(std::size_t begin, std::size_t end) {
    constexpr std::size_t MOST = 64;
    Point low = samples_[begin].p, high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], samples_[i].p[k]);
        high[k] = std::max(high[k], samples_[i].p[k]);
      }
    if (end - begin <= MOST) {
      blocks_.push_back({begin, end, 0.5 * (low + high), 0.5 * distance(low, high)});
      return;
    }
    const Point size = high - low;
    const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    const auto first = samples_.begin();
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                     first + static_cast<std::ptrdiff_t>(end),
                     [axis](const Sample& x, const Sample& y) { return x.p[axis] < y.p[axis]; });
    make_blocks(begin, middle);
    make_blocks(middle, end);
  }

  double cutoff_;
  nlohmann::json asked_;
  Field fine_, coarse_;
  std::vector<Sample> samples_;
  std::vector<Block> blocks_;
  Wrench wrench_;
};

constexpr lmdbench_method METHOD = plugin::Functions<Points>::with_force(plugin::Functions<Points>::described(
    "points", "1", "surface samples of the moving mesh against a signed distance field of the other",
    LMDBENCH_PROMISE_FORCE_ONLY,
    R"({"spacing_cutoffs": {"type": "number", "exclusiveMinimum": 0, "default": 0.5,
        "description": "longest side of the triangle that a sample stands for, in cutoffs"},
        "voxel_cutoffs": {"type": "number", "exclusiveMinimum": 0, "default": 0.25,
        "description": "side of a voxel, in cutoffs"}})"));

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = plugin::entry_of<METHOD>();
