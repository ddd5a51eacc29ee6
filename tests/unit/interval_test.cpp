// Outward rounding: intervals, affine forms and what is built on them contain the exact result, in 400-bit arithmetic.
#include "equipoise/core/math/interval.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/affine_form.hpp"
#include "equipoise/core/math/expansion.hpp"
#include "equipoise/core/math/gradient.hpp"
#include "equipoise/core/math/krawczyk.hpp"
#include "equipoise/core/math/positive_definite.hpp"

namespace interval_test {

using equipoise::AffineForm;
using equipoise::Constant;
using equipoise::Interval;
using Exact =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<400, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

bool holds(const Interval& a, const Exact& v) { return Exact(a.low) <= v && v <= Exact(a.high); }

class Random {
 public:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  // Either sign, any size between 1e-20 and 1e20.
  double wide() { return (uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0) * std::pow(10.0, uniform(-20.0, 20.0)); }
  // A neighbour of the number within a few ulps, or the number itself.
  double nudged(double v) {
    for (int k = static_cast<int>(uniform(0.0, 4.0)); k > 0; --k) v = std::nextafter(v, uniform(-1.0, 1.0) * 1e300);
    return v;
  }
  double inside(const Interval& a) { return std::min(a.high, std::max(a.low, uniform(a.low, a.high))); }

 private:
  std::mt19937_64 engine_{1};
};

TEST(Interval, ArithmeticHoldsTheExactResultAndLittleMore) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const double a = random.wide(), b = i % 2 ? random.wide() : random.nudged(-a);
    const Exact x(a), y(b);
    const auto check = [&](const Interval& r, const Exact& exact) {
      EXPECT_TRUE(holds(r, exact)) << a << " " << b;
      EXPECT_LE(r.high - r.low, 0x1p-50 * r.magnitude() + 1e-300);  // two steps of at most two ulps each
    };
    check(Interval(a) + Interval(b), x + y);
    check(Interval(a) - Interval(b), x - y);
    check(Interval(a) * Interval(b), x * y);
    check(Interval(a) / Interval(b), x / y);
    check(equipoise::square(Interval(a)), x * x);
    check(equipoise::square_root(Interval(std::fabs(a))), sqrt(abs(x)));
  }
}

TEST(Interval, ArithmeticHoldsTheResultsOfAllPoints) {
  Random random;
  for (int i = 0; i < 5000; ++i) {
    Interval a(random.uniform(-2.0, 2.0)), b(random.uniform(-2.0, 2.0));
    a.high += random.uniform(0.0, 1.0);
    b.high += random.uniform(0.0, 1.0);
    for (int k = 0; k < 10; ++k) {
      const double x = random.inside(a), y = random.inside(b);
      EXPECT_TRUE(holds(a * b, Exact(x) * Exact(y)));
      EXPECT_TRUE(holds(a / b, y == 0.0 ? Exact(0) : Exact(x) / Exact(y)));
      EXPECT_TRUE(holds(equipoise::square(a), Exact(x) * Exact(x)));
      EXPECT_TRUE(holds(a + b, Exact(x) + Exact(y)));
      EXPECT_TRUE(holds(a - b, Exact(x) - Exact(y)));
      EXPECT_TRUE(holds(-a, -Exact(x)));
    }
    EXPECT_GE(a.radius(), a.high - a.middle());
    EXPECT_GE(a.radius(), a.middle() - a.low);
  }
}

TEST(Interval, KnowsNoBoundRatherThanAWrongOne) {
  const Interval whole = Interval::whole(), zero(0.0), huge(1e308);
  for (const Interval& r : {Interval(1.0) / zero, Interval(1.0) / Interval(-1.0, 1.0), whole * zero, whole - whole,
                            Interval(0.0, 1.0) * whole, Interval(std::nan("")) + Interval(1.0)})
    EXPECT_FALSE(r.low > -INFINITY || r.high < INFINITY);
  EXPECT_EQ((huge * huge).high, INFINITY);
  EXPECT_EQ((huge + huge).high, INFINITY);
  EXPECT_TRUE(holds(Interval(5e-324) * Interval(0.5), Exact(5e-324) / 2));
}

void expect_sin_cos(Random& random, const Interval& a) {
  Interval s, c;
  equipoise::sin_cos(a, s, c);
  EXPECT_TRUE(s.low >= -1.0 && s.high <= 1.0 && c.low >= -1.0 && c.high <= 1.0);
  for (int k = 0; k < 4; ++k) {
    const double x = k == 0 ? a.low : k == 1 ? a.high : random.inside(a);
    EXPECT_TRUE(holds(s, sin(Exact(x)))) << x;
    EXPECT_TRUE(holds(c, cos(Exact(x)))) << x;
  }
  if (a.low == a.high) {
    EXPECT_LE(s.high - s.low, 0x1p-49);
    EXPECT_LE(c.high - c.low, 0x1p-49);
  }
}

TEST(Interval, SineAndCosineHoldTheValuesOfNumbers) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    expect_sin_cos(random, Interval(random.uniform(-10.0, 10.0)));
    expect_sin_cos(random, Interval(random.uniform(-1e6, 1e6)));
  }
}

// At an extremum and around it, also where the interval ends next to it.
// What proofs take for granted: the error stated in core/math/interval.hpp, near multiples of pi/2 too, where little
// is left.
TEST(ProvenSine, KeepsItsStatedError) {
  Random random;
  const auto check = [](double a) {
    const equipoise::ProvenSine p = equipoise::proven_sine(a);
    EXPECT_LE(abs(sin(Exact(a)) - p.sine), 0x1p-52 * std::fabs(p.sine) + p.absolute) << a;
    EXPECT_LE(abs(cos(Exact(a)) - p.cosine), 0x1p-52 * std::fabs(p.cosine) + p.absolute) << a;
  };
  for (double a : {0.0, 0x1p20, -0x1p20, 5e-324, 0x1p-27, 0.78539816339744828, 0.78539816339744839}) check(a);
  for (int i = 0; i < 1000; ++i) {
    check(random.uniform(-4.0, 4.0));
    check(random.uniform(-0x1p20, 0x1p20));
    check(std::pow(10.0, random.uniform(-300.0, 0.0)));
    const double top = std::floor(random.uniform(-667543.0, 667543.0)) * 0.5 * equipoise::pi;
    for (const double a : {top, std::nextafter(top, 1e9), std::nextafter(top, -1e9)}) check(a);
  }
}

TEST(Interval, SineAndCosineHoldAllValuesAroundExtrema) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const double top = std::floor(random.uniform(-1e5, 1e5)) * 0.5 * equipoise::pi;
    expect_sin_cos(random, Interval(random.nudged(top)));
    const double low = random.nudged(top), width = std::pow(10.0, random.uniform(-16.0, 0.9));
    expect_sin_cos(random, Interval(low, low + width));
    expect_sin_cos(random, Interval(low - width, low));
    expect_sin_cos(random, Interval(low - width, low + 0.5 * width));
  }
}

TEST(Interval, SineAndCosineOfWhatIsTooWideAreFromMinusOneToOne) {
  for (const Interval& a :
       {Interval(1e300), Interval(1.05e6), Interval(0.0, 7.0), Interval::whole(), Interval(std::nan(""))}) {
    Interval s, c;
    equipoise::sin_cos(a, s, c);
    EXPECT_EQ(s.low, -1.0);
    EXPECT_EQ(c.high, 1.0);
  }
}

void sin_cos(const Exact& a, Exact& s, Exact& c) {
  s = sin(a);
  c = cos(a);
}

// A function with every operation the equations use, bounded away from poles on the boxes below.
template <class T>
T sample_function(const T& x, const T& y) {
  T s, c, s2, c2;
  sin_cos(x, s, c);
  sin_cos(y * x - y, s2, c2);
  return (s * c2 - x * y * y) / (T(3.0) + c * c - s2 * y) - (-c) * y;
}

TEST(AffineForm, HoldsTheFunctionOnTheBoxAndItsRemainderIsOfSecondOrder) {
  Random random;
  using Form = AffineForm<2>;
  for (int i = 0; i < 200; ++i) {
    const std::array<double, 2> middle{random.uniform(-2.0, 2.0), random.uniform(-1.0, 1.0)};
    double earlier = 0.0;
    for (double half : {0.1, 0.01, 0.001, 1e-12, 0.0}) {
      Form x(middle[0]), y(middle[1]);
      x.slope[0] = y.slope[1] = half;
      const Form f = sample_function(x, y);
      for (int k = 0; k < 8; ++k) {
        const double tx = k < 4 ? (k & 1 ? 1 : -1) : random.uniform(-1.0, 1.0);
        const double ty = k < 4 ? (k & 2 ? 1 : -1) : random.uniform(-1.0, 1.0);
        const Exact exact =
            sample_function(Exact(Exact(middle[0]) + Exact(half) * tx), Exact(Exact(middle[1]) + Exact(half) * ty));
        const Exact linear = Exact(f.centre) + Exact(f.slope[0]) * tx + Exact(f.slope[1]) * ty;
        EXPECT_LE(abs(exact - linear), Exact(f.radius)) << half;
      }
      if (half == 0.01) {
        EXPECT_LT(f.radius, 0.05 * earlier);  // a hundredth, as h^2, and higher orders
      }
      if (half == 0.0) {
        EXPECT_LT(f.radius, 1e-13);
      }
      earlier = f.radius;
    }
  }
}

TEST(AffineForm, KeepsTheErrorOfWhatGoesIn) {
  const Interval third = Interval(1.0) / Interval(3.0);
  const AffineForm<1> f =
      AffineForm<1>(Constant(third)) * Constant(third) * AffineForm<1>(Constant(Interval(2.0, 2.5)));
  EXPECT_LE(f.centre - f.radius, 2.0 / 9.0);
  EXPECT_GE(f.centre + f.radius, 2.5 / 9.0);
  const AffineForm<1> pole = AffineForm<1>(1.0) / AffineForm<1>(Constant(0.1, 0.2));
  EXPECT_FALSE(pole.radius < INFINITY);
}

TEST(Gradient, OfIntervalsHoldsTheDerivativesOverABox) {
  Random random;
  using Slope = equipoise::Gradient<Interval, 2>;
  for (int i = 0; i < 500; ++i) {
    const Interval x(random.uniform(-2.0, 2.0)), y(random.uniform(-1.0, 1.0));
    const Interval wide_x(x.low, x.low + 0.01), wide_y(y.low, y.low + 0.01);
    const Slope f = sample_function(Slope(wide_x, 0), Slope(wide_y, 1));
    const Exact px(random.inside(wide_x)), py(random.inside(wide_y)), h(1e-30);
    const Exact value = sample_function(px, py);
    EXPECT_TRUE(holds(f.value, value));
    // The difference quotient's own error is 1e-30.
    EXPECT_TRUE(holds(f.slope[0], (sample_function(Exact(px + h), py) - value) / h));
    EXPECT_TRUE(holds(f.slope[1], (sample_function(px, Exact(py + h)) - value) / h));
  }
}

TEST(Expansion, MultipliesPolynomialsAndReportsThoseBeyondItsReach) {
  using E = equipoise::Expansion<equipoise::Gradient<double, 2>, 2>;
  const E q1 = E::variable(4), q2 = E::variable(5), x = E::variable(0);
  const E f = (E(3.0) + q1) * (E(2.0) * q1 - E(1.0)) + x * E(5.0) - q2 / E(4.0);
  EXPECT_FALSE(f.beyond);
  EXPECT_EQ(f.coefficient[0].value, -3.0);
  EXPECT_EQ(f.coefficient[1].value, 5.0);
  EXPECT_EQ(f.coefficient[1 + 4].value, 5.0);
  EXPECT_EQ(f.coefficient[1 + 5].value, -0.25);
  EXPECT_EQ(f.coefficient[E::square_of(0)].value, 2.0);
  EXPECT_EQ(f.coefficient[E::square_of(1)].value, 0.0);
  EXPECT_TRUE((q1 * q2).beyond);
  EXPECT_TRUE((x * x).beyond);
  EXPECT_TRUE((q1 * q1 * q1).beyond);
  EXPECT_TRUE((E(1.0) / q1).beyond);
  EXPECT_TRUE((E(1.0) + (q1 * q2) * E(2.0)).beyond);
}

TEST(Krawczyk, FindsTheOneZeroNearAndNoneWhereThereIsNone) {
  using P = equipoise::PlaneGradient;
  const auto circle_and_line = [](const std::array<P, 2>& x) {
    return std::array<P, 2>{x[0] * x[0] + x[1] * x[1] - P(2.0), x[0] - P(2.0) * x[1]};
  };
  std::array<Interval, 2> zero;
  const double exact = std::sqrt(0.4);
  EXPECT_TRUE(equipoise::enclose_zero(circle_and_line, {2.0 * exact, exact}, 1e-10, zero));
  EXPECT_TRUE(holds(zero[0], 2 * sqrt(Exact(2) / 5)));
  EXPECT_TRUE(holds(zero[1], sqrt(Exact(2) / 5)));
  EXPECT_FALSE(equipoise::enclose_zero(circle_and_line, {2.0 * exact + 1e-6, exact}, 1e-10, zero));
  const auto nowhere = [](const std::array<P, 2>& x) { return std::array<P, 2>{x[0] * x[0] + P(1e-25), x[1]}; };
  EXPECT_FALSE(equipoise::enclose_zero(nowhere, {0.0, 0.0}, 1e-10, zero));
}

TEST(PositiveDefinite, IsNeverSaidOfAMatrixThatIsNot) {
  using Matrix = std::array<std::array<Interval, 3>, 3>;
  const auto matrix = [](double shift, double radius) {  // eigenvalues 0, 0, 3 moved by shift
    Matrix a;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double v = i == j ? 1.0 + shift : 1.0;
        a[i][j] = {v - radius, v + radius};
      }
    return a;
  };
  EXPECT_TRUE(equipoise::certainly_positive(matrix(1e-3, 0.0), 0.0));
  EXPECT_TRUE(equipoise::certainly_positive(matrix(1e-12, 0.0), 0.0));
  EXPECT_TRUE(equipoise::certainly_positive(matrix(1e-3, 2e-4), 0.0));
  EXPECT_FALSE(equipoise::certainly_positive(matrix(1e-3, 4e-4), 0.0));  // its worst member has eigenvalue -2e-4
  EXPECT_FALSE(equipoise::certainly_positive(matrix(0.0, 0.0), 0.0));
  EXPECT_FALSE(equipoise::certainly_positive(matrix(-1e-15, 0.0), 0.0));
  EXPECT_FALSE(equipoise::certainly_positive(matrix(1e-3, 0.0), 1e-3));
  EXPECT_FALSE(equipoise::certainly_positive(matrix(1e-3, INFINITY), 0.0));
}

}  // namespace interval_test
