// How many balls templates are compiled for.
#pragma once

#include <type_traits>
#include <utility>

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// A template over balls has room for some number of them. With room for `any_count` it runs over as many as a number
/// says that is known at run time; with less room, over exactly that many, in loops that unroll.
inline constexpr int any_count = max_balls;

/// The least number of state variables that code with such room is taken for by with_ball_count().
template <int room>
inline constexpr int least_dimension = dimension(room == any_count ? 5 : room);

/// The count itself: a constant where it is compiled in.
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

/// Calls `f(std::integral_constant<int, room>{})` with the room that kernels take for `balls`, 1 to max_balls (checked
/// where a study is read): the same number up to `most`, any_count above, where one loop serves nearly as well as
/// unrolled code and all other counts are compiled at once.
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
