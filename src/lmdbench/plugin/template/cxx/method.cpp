// SPDX-License-Identifier: 0BSD
// METHOD_NAME: each vertex of A with the nearest one of B. Replace it (see lmdbench_method.h).
#include "plugin.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace {

using Point = std::array<double, 3>;

double distance(const Point& p, const Point& q) {
  return std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
}

/// Vertices, each with a triangle that has it as a corner.
struct Sites {
  struct Site {
    Point p{};
    int32_t triangle = -1, corner = 0;
  };
  std::vector<Site> all;

  explicit Sites(const lmdbench_mesh& mesh) : all(mesh.vertex_count) {
    for (uint64_t i = 0; i < 3 * mesh.triangle_count; ++i) {
      const int32_t v = mesh.triangles[i];
      const double* p = mesh.vertices + 3 * v;
      all[v] = {{p[0], p[1], p[2]}, static_cast<int32_t>(i / 3), static_cast<int32_t>(i % 3)};
    }
    all.erase(std::remove_if(all.begin(), all.end(), [](const Site& site) { return site.triangle < 0; }),
              all.end());
  }
};

class Method {
 public:
  Method(const lmdbench_mesh& a, const lmdbench_mesh& b, double cutoff, const std::string& /*options: JSON*/)
      : a_(a), b_(b), cutoff_(cutoff) {}

  void search(const double* X, std::vector<lmdbench_contact>& contacts) const {
    std::vector<std::pair<double, lmdbench_contact>> found;
    for (const auto& a : a_.all) {
      Point p{};
      for (int r = 0; r < 3; ++r)
        p[r] = X[4 * r] * a.p[0] + X[4 * r + 1] * a.p[1] + X[4 * r + 2] * a.p[2] + X[4 * r + 3];
      const Sites::Site* nearest = nullptr;
      double best = cutoff_;
      for (const auto& b : b_.all)
        if (const double d = distance(p, b.p); d <= best) best = d, nearest = &b;
      if (nearest == nullptr) continue;
      const Point& q = nearest->p;
      found.push_back({best,
                       {{p[0], p[1], p[2]},
                        {q[0], q[1], q[2]},
                        a.triangle,
                        nearest->triangle,
                        LMDBENCH_CORNER_0 + a.corner,
                        LMDBENCH_CORNER_0 + nearest->corner}});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& x, const auto& y) { return x.first < y.first; });
    for (const auto& entry : found) contacts.push_back(entry.second);
  }

 private:
  Sites a_, b_;
  double cutoff_;
};

constexpr lmdbench_method METHOD = plugin::Functions<Method>::described(
    "METHOD_NAME", "0.1", "each vertex of the moving mesh with the nearest vertex of the fixed one",
    LMDBENCH_PROMISE_APPROXIMATION);

}  // namespace

const lmdbench_method_entry_type lmdbench_method_entry = plugin::entry_of<METHOD>();
