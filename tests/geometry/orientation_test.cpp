// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/expansion.h>
#include <lmdbench/geometry/orientation.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lmdbench {
namespace {

using Rational = boost::multiprecision::cpp_rational;

int rational_orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Rational m[3][3];
  for (int i = 0; i < 3; ++i) {
    m[0][i] = Rational(b[i]) - Rational(a[i]);
    m[1][i] = Rational(c[i]) - Rational(a[i]);
    m[2][i] = Rational(d[i]) - Rational(a[i]);
  }
  const Rational determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return determinant.sign();
}

TEST(Orientation, KnowsTheSides) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(orientation_3d(a, b, c, Vec3(0, 0, 1)), 1);
  EXPECT_EQ(orientation_3d(a, b, c, Vec3(0, 0, -1)), -1);
  EXPECT_EQ(orientation_3d(a, b, c, Vec3(5, 7, 0)), 0);
  EXPECT_EQ(orientation_2d(a, b, c, 2), 1);
  EXPECT_EQ(orientation_2d(a, c, b, 2), -1);
  EXPECT_EQ(orientation_2d(a, b, Vec3(3, 0, 9), 2), 0);
}

TEST(Orientation, AgreesWithRationalsWhereRoundingDecidesNothing) {
  // Nearly coplanar: a point in the plane up to rounding, moved by some units in the last place.
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::uniform_int_distribution<int> steps(-3, 3);
  const auto point = [&] {
    const double x = coordinate(random);
    const double y = coordinate(random);
    return Vec3(x, y, coordinate(random));
  };
  int zeros = 0;
  for (int round = 0; round < 20000; ++round) {
    const double scale = std::ldexp(1.0, round % 41 - 20);
    Vec3 a = point() * scale, b = point() * scale, c = point() * scale;
    if (round % 4 == 0) {
      for (Vec3* corner : {&a, &b, &c})
        *corner = corner->unaryExpr([scale](double x) { return std::round(8.0 * x / scale) * scale; });
    }
    const double u = coordinate(random), v = coordinate(random);
    Vec3 d = a + (round % 4 == 0 ? std::round(4 * u) : u) * (b - a) + (round % 4 == 0 ? 2.0 : v) * (c - a);
    for (int step = d[2] == 0.0 ? 0 : steps(random); step != 0; step += step > 0 ? -1 : 1) {
      d[2] = std::nextafter(d[2], step > 0 ? HUGE_VAL : -HUGE_VAL);
    }
    const int truth = rational_orientation_3d(a, b, c, d);
    zeros += truth == 0;
    ASSERT_EQ(orientation_3d(a, b, c, d), truth) << "round " << round;
    ASSERT_EQ(orientation_3d(b, a, c, d), -truth) << "round " << round;
  }
  EXPECT_GT(zeros, 100) << "the generator no longer makes exactly coplanar points";
}

TEST(Orientation, TwoDimensionsAgreeWithRationals) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::uniform_int_distribution<int> steps(-2, 2);
  int zeros = 0;
  for (int round = 0; round < 20000; ++round) {
    // Three points on a line, on a lattice or up to rounding; some units in the last place move the
    // last one.
    const bool on_lattice = round % 2 == 0;
    const auto point = [&] {
      const double first = coordinate(random);
      const double second = coordinate(random);
      const Vec3 p(first, second, coordinate(random));
      return on_lattice ? Vec3(p.unaryExpr([](double x) { return std::round(8.0 * x); })) : p;
    };
    const Vec3 a = point(), b = point();
    Vec3 c = a + (on_lattice ? 3.0 : coordinate(random)) * (b - a);
    for (int step = steps(random); step != 0; step += step > 0 ? -1 : 1) {
      c[1] = std::nextafter(c[1], step > 0 ? HUGE_VAL : -HUGE_VAL);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int x = (axis + 1) % 3, y = (axis + 2) % 3;
      const Rational determinant = (Rational(b[x]) - Rational(a[x])) * (Rational(c[y]) - Rational(a[y])) -
                                   (Rational(b[y]) - Rational(a[y])) * (Rational(c[x]) - Rational(a[x]));
      zeros += determinant.sign() == 0;
      ASSERT_EQ(orientation_2d(a, b, c, axis), determinant.sign()) << "round " << round;
    }
  }
  EXPECT_GT(zeros, 1000) << "the generator no longer makes exactly collinear points";
}

TEST(Orientation, DoesNotTakeAnUnderflowForZero) {
  // Products of two coordinates vanish in doubles; the points are not collinear.
  const double tiny = 0x1p-600;
  EXPECT_EQ(orientation_3d(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, tiny, 0), Vec3(0, 0, 0x1p-500)), 1);
}

TEST(Expansion, IsExactWhereDoublesAreNot) {
  // 1e30 + 1 - 1e30 is 0 in doubles.
  Expansion<3> sum;
  sum.add(1e30);
  sum.add(1.0);
  sum.add(-1e30);
  EXPECT_EQ(sum.sign(), 1);
  const auto tiny = exact_difference(1.0 + 0x1p-52, 1.0);
  const auto one = exact_difference(1.0, 0.0);
  EXPECT_EQ((tiny * tiny - tiny * tiny).sign(), 0);
  EXPECT_EQ(((one + tiny) * (one - tiny) - one).sign(), -1);
}

}  // namespace
}  // namespace lmdbench
