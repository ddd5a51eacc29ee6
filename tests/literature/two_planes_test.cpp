// Four balls in two planes as other groups published their equations: the mapping of symbols in studies/publications.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/study/contents/study.hpp"

namespace two_planes_test {

using namespace equipoise;

// The rotor of Rodrigues and others (2008), section 2: four balls in two planes at +z and -z, with tilt; its equations
// in turning axes at constant speed, without couple unbalance. Both planes' balls start alike.
TEST(TwoPlanes, OfFourBallsThatMoveAlikeAreTwoBallsOfTwiceTheMass) {
  const Study study = read_study(EQUIPOISE_SOURCE_DIR "/studies/publications/rodrigues-2008.toml");
  constexpr double w = 2.0, lambda = 0.01, mu = 0.025, beta = 0.01, c11 = 0.02, c22 = 0.18, k22 = 9.0;  // m/M and so on
  constexpr double jt = 3.25, jp = 0.5;
  constexpr double z[] = {2.0, 2.0, -2.0, -2.0};
  ASSERT_EQ(study.parameters.mass[0], 2.0 * mu);
  ASSERT_EQ(study.parameters.eccentricity, lambda);
  ASSERT_EQ(study.parameters.damping[0], c11);
  ASSERT_EQ(study.parameters.drag[0], beta);
  ASSERT_EQ(study.speed.speed, w);
  using State = Eigen::Matrix<double, 16, 1>;  // centre, slope, their inertial velocities; angles, rates
  const auto flow = [&](const State& s) {
    Eigen::Matrix4d mass = Eigen::Vector4d(1.0, 1.0, jt, jt).asDiagonal();
    Eigen::Vector4d force(lambda * w * w - c11 * s[4] - s[0], -c11 * s[5] - s[1],
                          -w * jp * s[7] - c22 * s[6] - k22 * s[2], w * jp * s[6] - c22 * s[7] - k22 * s[3]);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d e(std::cos(s[8 + i]), std::sin(s[8 + i])), t(-e[1], e[0]);
      const double q = s[12 + i];
      const Eigen::Matrix2d radial = mu * e * e.transpose();
      mass.topLeftCorner<2, 2>() += radial;
      mass.topRightCorner<2, 2>() += z[i] * radial;
      mass.bottomLeftCorner<2, 2>() += z[i] * radial;
      mass.bottomRightCorner<2, 2>() += z[i] * z[i] * radial;
      const Eigen::Vector2d pull = mu * ((w + q) * (w + q) * e + beta * q * t);
      force.head<2>() += pull;
      force.tail<2>() += z[i] * pull;
    }
    const Eigen::Vector4d a = mass.partialPivLu().solve(force);
    State d;
    for (int k = 0; k < 4; k += 2) {
      d[k] = s[4 + k] + w * s[k + 1];
      d[k + 1] = s[5 + k] - w * s[k];
      d[4 + k] = a[k] + w * s[5 + k];
      d[5 + k] = a[k + 1] - w * s[4 + k];
    }
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d t(-std::sin(s[8 + i]), std::cos(s[8 + i]));
      d[8 + i] = s[12 + i];
      d[12 + i] = -beta * s[12 + i] - t.dot(a.head<2>() + z[i] * a.tail<2>());
    }
    return d;
  };
  State s = State::Zero();
  for (int i = 0; i < 4; ++i) s[8 + i] = study.initial.phi[static_cast<std::size_t>(i % 2)];
  constexpr double h = 1e-3;
  for (int k = 0; k < 20000; ++k) {
    const State a = flow(s), b = flow(s + 0.5 * h * a), c = flow(s + 0.5 * h * b), d = flow(s + h * c);
    s += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  const Trajectory ours = simulate(study, {20.0});
  EXPECT_NEAR(ours.radial.back(), std::hypot(s[0], s[1]), 1e-10);
  EXPECT_NEAR(ours.phi[0].back(), s[8], 1e-9);
  EXPECT_NEAR(ours.phi[1].back(), s[11], 1e-9);
  EXPECT_LT(std::hypot(s[2], s[3]), 1e-10);  // no tilt
}

}  // namespace two_planes_test
