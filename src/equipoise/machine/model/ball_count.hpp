// The numbers of balls that templates are compiled for. Raising the counts below lengthens the build of every kernel.
#pragma once

#include <type_traits>
#include <utility>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Templates take the number of balls, `room`, as a parameter, so that loops over balls unroll. With room for
/// `any_count` the number is known only at run time.
inline constexpr int any_count = max_balls;

/// The fewest state variables for which with_ball_count() picks code with this room.
template <int room>
inline constexpr int least_dimension = dimension(room == any_count ? 5 : room);

/// The number of balls: a constant unless `room` is any_count.
template <int room>
class BallCount {
 public:
  constexpr explicit BallCount(int) {}
  constexpr operator int() const { return room; }
  /// Number of state variables.
  constexpr auto size() const { return std::integral_constant<int, dimension(room)>{}; }
};

template <>
class BallCount<any_count> {
 public:
  constexpr explicit BallCount(int balls) : balls_(balls) {}
  constexpr operator int() const { return balls_; }
  constexpr int size() const { return dimension(balls_); }

 private:
  int balls_;
};

/// Calls `f(std::integral_constant<int, room>{})` for `balls` from 1 to max_balls (checked when a study is read):
/// `room` is `balls` up to `most` and any_count above, where a loop is nearly as fast and one kernel serves all counts.
template <int most = 4, class F>
decltype(auto) with_ball_count(int balls, F&& f) {
  if constexpr (most == 0) {
    return f(std::integral_constant<int, any_count>{});
  } else {
    if (balls == most) return f(std::integral_constant<int, most>{});
    return with_ball_count<most - 1>(balls, std::forward<F>(f));
  }
}

}  // namespace equipoise::model
