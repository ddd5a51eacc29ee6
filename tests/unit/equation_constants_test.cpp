// What the equations derive from parameters before the first evaluation, all of it in their number type.
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace equation_constants_test {

// Doubles passed to the number type.
std::set<double> given;

struct Noted {
  double value = 0.0;
  Noted() = default;
  Noted(double v) : value(v) { given.insert(v); }
  static Noted of(double v) {
    Noted n;
    n.value = v;
    return n;
  }
  friend Noted operator+(const Noted& a, const Noted& b) { return of(a.value + b.value); }
  friend Noted operator-(const Noted& a, const Noted& b) { return of(a.value - b.value); }
  [[maybe_unused]] friend Noted operator-(const Noted& a) { return of(-a.value); }
  friend Noted operator*(const Noted& a, const Noted& b) { return of(a.value * b.value); }
  friend Noted operator/(const Noted& a, const Noted& b) { return of(a.value / b.value); }
};
void sin_cos(const Noted& a, Noted& sine, Noted& cosine) {
  sine = Noted::of(std::sin(a.value));
  cosine = Noted::of(std::cos(a.value));
}

}  // namespace equation_constants_test

#include "equipoise/machine/model/flow-inl.hpp"

namespace equipoise {
namespace equation_constants_test {

using namespace ::equation_constants_test;

// A proof encloses what follows from the parameters, which are doubles. A product or sum of them rounded before it
// became an interval would be treated as exact.
TEST(EquationConstants, AreFormedInTheNumberType) {
  constexpr int n = 3;
  model::Parameters p;
  p.balls = n;
  p.eccentricity = 0.0123;
  p.damping = {0.37, 0.37};
  p.mass = {0.051, 0.043, 0.037};
  p.drag = {0.071, 0.019, 0.033};
  constexpr double speed = 2.43;
  given.clear();
  p.rolls = true;
  p.ball_radius = {0.17, 0.19, 0.23};
  const HWY_NAMESPACE::FreeFlow<Noted, n, HWY_NAMESPACE::Terms{false, false, false}> flow(
      p, {0.0, 0.0, 0.0, speed, 0.0, false});
  Noted z[model::dimension(n)], rate[model::dimension(n)];
  for (int i = 0; i < model::dimension(n); ++i) z[i] = Noted::of(0.1 * i);
  flow(Noted::of(0.0), z, rate);
  // Parameters (zeta and kappa as means of two equal numbers are exact), and numbers in the equations.
  std::set<double> exact{0.0, 0.5, 1.0, 2.0, 5.0, p.eccentricity, p.damping[0], p.stiffness[0], speed};
  for (int i = 0; i < n; ++i) exact.insert({p.mass[i], p.drag[i], p.ball_radius[i]});
  for (const double v : given) EXPECT_TRUE(exact.count(v)) << v << " was rounded in doubles";
}

}  // namespace equation_constants_test
}  // namespace equipoise
