// From a ball count known at run time to one known at compile time.
#pragma once

#include <type_traits>
#include <utility>

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Calls `f(std::integral_constant<int, n>{})` for n = `balls`, 1 to max_balls (checked where a study is read).
template <class F>
decltype(auto) with_ball_count(int balls, F&& f) {
  switch (balls) {
    case 1:
      return f(std::integral_constant<int, 1>{});
    case 2:
      return f(std::integral_constant<int, 2>{});
    case 3:
      return f(std::integral_constant<int, 3>{});
    case 4:
      return f(std::integral_constant<int, 4>{});
    case 5:
      return f(std::integral_constant<int, 5>{});
    case 6:
      return f(std::integral_constant<int, 6>{});
    case 7:
      return f(std::integral_constant<int, 7>{});
    default:
      return f(std::integral_constant<int, 8>{});
  }
}

}  // namespace equipoise::model
