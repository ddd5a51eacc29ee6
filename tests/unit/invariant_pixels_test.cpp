// Pixels on which alike balls move as one.
#include "equipoise/analyses/basin_slices/start_pixels.hpp"

#include <string>

#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace invariant_pixels_test {

BasinSlice plane(const std::string& study, const SliceAxis& x, const SliceAxis& y) {
  BasinSlice map;
  map.study = parse_study(study, "rotor");
  map.x = x;
  map.y = y;
  return map;
}

const SliceAxis first{"initial.phi_1", 0.0, two_pi, 8}, second{"initial.phi_2", 0.0, two_pi, 8};
const std::string three = with(constant_speed, "balls = 2", "balls = 3") + "[initial]\nphi = [0.0, 1.0, 1.0]\n";

TEST(InvariantPixels, AreTheDiagonalOfASquareOverTwoAngles) {
  const InvariantPixels pixels(plane(constant_speed, first, second));
  EXPECT_EQ(pixels.count(), 8u);
  for (int column = 0; column < 8; ++column)
    for (int row = 0; row < 8; ++row) EXPECT_EQ(pixels.holds(column, row), column == row);
  // A turn further on they are the same places.
  EXPECT_EQ(InvariantPixels(plane(constant_speed, first, {"initial.phi_2", -pi, pi, 8})).count(), 8u);
  // Centres of 8 and of 12 pixels never agree.
  EXPECT_EQ(InvariantPixels(plane(constant_speed, first, {"initial.phi_2", 0.0, two_pi, 12})).count(), 0u);
}

TEST(InvariantPixels, NeedBallsThatAreAlikeInMassDragAndRate) {
  EXPECT_EQ(InvariantPixels(plane(with(constant_speed, "mass = 0.05", "mass = [0.05, 0.051]"), first, second)).count(),
            0u);
  EXPECT_EQ(InvariantPixels(plane(constant_speed + "[initial]\nphi_dot = [0.0, 0.1]\n", first, second)).count(), 0u);
  EXPECT_EQ(InvariantPixels(plane(constant_speed + "[initial]\nphi = [1.0, 1.0]\n", {"initial.phi_dot_1", -1.0, 1.0, 8},
                                  {"initial.phi_dot_2", -1.0, 1.0, 8}))
                .count(),
            8u);
}

// Balls 2 and 3 start as one in the whole plane; that is what the study says.
TEST(InvariantPixels, LeaveOutNothingThatHoldsForTheWholePlane) {
  EXPECT_EQ(InvariantPixels(plane(three, first, {"rotor.eccentricity", 0.01, 0.02, 4})).count(), 0u);
  EXPECT_TRUE(InvariantPixels(plane(three, first, {"rotor.eccentricity", 0.01, 0.02, 4})).everywhere());
  EXPECT_FALSE(InvariantPixels(plane(constant_speed, first, second)).everywhere());
  BasinSlice tied = plane(constant_speed, first, {"rotor.eccentricity", 0.01, 0.02, 4});
  tied.links = {{2, 1, 0.0}};
  EXPECT_EQ(InvariantPixels(tied).count(), 0u);
  EXPECT_TRUE(InvariantPixels(tied).everywhere());
  EXPECT_EQ(InvariantPixels(plane(constant_speed, {"initial.phi_1", 0.0, two_pi, 1}, {"initial.phi_2", 0.0, two_pi, 1}))
                .count(),
            0u);
}

// A line of the plane: ball 1 at the place of balls 2 and 3.
TEST(InvariantPixels, AreALineWhereOneAxisIsAParameter) {
  const InvariantPixels pixels(plane(three, {"initial.phi_1", 0.5, 1.5, 5}, {"rotor.eccentricity", 0.01, 0.02, 4}));
  EXPECT_EQ(pixels.count(), 4u);
  EXPECT_TRUE(pixels.holds(2, 0) && pixels.holds(2, 3));
}

// 8 pixels per turn are 0.79 rad apart. Balls that collide are no start if they overlap, alike or not.
TEST(InvariantPixels, AreThoseOnWhichCollidingBallsOverlap) {
  const std::string colliding = with(constant_speed, "mass = 0.05", "mass = [0.05, 0.051]\ncontact_angle = 0.8");
  const InvariantPixels pixels(plane(colliding, first, second));
  EXPECT_EQ(pixels.count(), 24u);
  EXPECT_TRUE(pixels.holds(3, 4) && pixels.holds(0, 7));
  EXPECT_FALSE(pixels.holds(3, 5));
}

// Over two parameters every pixel draws its own angles.
TEST(InvariantPixels, AreNoneWhereStartsAreDrawn) {
  EXPECT_EQ(
      InvariantPixels(plane(constant_speed, {"rotor.eccentricity", 0.01, 0.02, 4}, {"balancer.drag", 0.1, 0.2, 4}))
          .count(),
      0u);
}

}  // namespace invariant_pixels_test
}  // namespace equipoise
