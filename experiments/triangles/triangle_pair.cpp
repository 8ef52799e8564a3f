// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <triangles/triangle_pair.h>

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>
#include <utility>

namespace lmdbench::testing {

TrianglePair transformed(const TrianglePair& pair, double scale, const Mat3& rotation, const Vec3& offset) {
  TrianglePair result;
  for (int i = 0; i < 3; ++i) {
    result.a[i] = rotation * (scale * pair.a[i]) + offset;
    result.b[i] = rotation * (scale * pair.b[i]) + offset;
  }
  return result;
}

TrianglePair reordered(const TrianglePair& pair, int order) {
  constexpr std::array<std::array<int, 3>, 6> ORDERS{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  const auto& of_a = ORDERS[order % 6];
  const auto& of_b = ORDERS[order / 6 % 6];
  TrianglePair result{{pair.a[of_a[0]], pair.a[of_a[1]], pair.a[of_a[2]]},
                      {pair.b[of_b[0]], pair.b[of_b[1]], pair.b[of_b[2]]}};
  if (order >= 36) std::swap(result.a, result.b);
  return result;
}

double magnitude(const TrianglePair& pair) {
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    largest = std::max({largest, pair.a[i].cwiseAbs().maxCoeff(), pair.b[i].cwiseAbs().maxCoeff()});
  }
  return largest;
}

std::string paste(const TrianglePair& pair) {
  std::ostringstream text;
  text << std::setprecision(17) << "\n";
  for (const Triangle* t : {&pair.a, &pair.b}) {
    text << "Triangle{";
    for (const Vec3& p : *t) text << "Vec3(" << p[0] << ", " << p[1] << ", " << p[2] << "), ";
    text << "}\n";
  }
  return text.str();
}

}  // namespace lmdbench::testing
