// Sizes of steel balls that are kept in stock.
#pragma once

#include <array>

namespace equipoise::model {

/// Diameters in mm of a maker's stock list of balls to ISO 3290, metric and inch sizes together [Techno].
inline constexpr std::array<double, 42> stock_ball_diameters{
    1.5,      1.5875,  2.0,      2.38125,  2.5,  2.778125, 3.0,     3.175,  3.5,      3.96875, 4.0,
    4.5,      4.7625,  5.0,      5.55625,  6.0,  6.35,     7.14375, 7.9375, 8.73125,  9.525,   10.0,
    10.31875, 11.1125, 11.90625, 12.0,     12.7, 13.49375, 14.2875, 15.0,   15.08125, 15.875,  16.0,
    16.66875, 17.4625, 19.05,    19.84375, 20.0, 20.6375,  23.8125, 25.0,   25.4};

}  // namespace equipoise::model
