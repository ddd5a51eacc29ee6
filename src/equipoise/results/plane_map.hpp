// A plane of starts or parameters with the outcome of one start at every pixel.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/statistics/share.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

inline constexpr int most_map_pixels = 20000;  ///< along one side

/// A quantity that varies along one side of a map.
struct MapAxis {
  std::string key;  ///< of rotor, balancer, speed or initial that takes a number; initial.phi_1 for one ball's angle,
                    ///< initial.phi_dot_1 for its rate
  double low = 0.0, high = 1.0;  ///< where the outermost pixels end
  int pixels = 1;

  /// Whether it is a ball's initial angle.
  bool angle() const { return key.starts_with("initial.phi_") && !key.starts_with("initial.phi_dot"); }
  double step() const { return (high - low) / pixels; }
  double centre(int pixel) const { return low + (pixel + 0.5) * step(); }
};

/// phi_ball = phi_of + offset in the initial state; balls count from 1.
struct AngleLink {
  int ball = 2, of = 1;
  double offset = 0.0;
};

/// What a code of a map stands for, and how much of the map has it.
struct MapCode {
  short code = 0;           ///< attractor's identifier, or undecided_code and its like
  std::string name, alias;  ///< alias: V1 to V4 of Wright and Peng (2019)
  Share share;              ///< of the computed pixels. They form a grid: the interval describes random ones
};

/// Marks pixels that a stopped run did not come to.
inline constexpr short not_computed_code = -32768;

/// Rows follow y, pixels within a row x.
struct PlaneMap {
  Study study;  ///< as given; the values of the two keys in it play no part
  MapAxis x, y;
  std::vector<AngleLink> links;
  std::vector<short> code;
  std::vector<double> time;            ///< study time at which the outcome was known
  std::vector<double> r_max;           ///< of the final motion; not a number where there is none
  std::vector<double> balance_margin;  ///< lambda + sum mu_i - 2 max(lambda, mu_i): balance exists where >= 0
  std::vector<double> balance_growth;  ///< largest real part of an eigenvalue at the more stable of the isolated
                                       ///< balanced states; not a number where there are none
  std::vector<MapCode> codes;          ///< attractors by identifier, then undecided, diverged, failed
  bool complete = true;
  int threads = 1;
  double seconds = 0.0, cpu_seconds = 0.0;
  std::string cpu_target;  ///< instruction set used

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(x.pixels) + static_cast<std::size_t>(column);
  }
};

}  // namespace equipoise
