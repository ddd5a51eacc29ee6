// What starts come to that come to no attractor: one line each, by which everything that tells of them goes.
#pragma once

#include <array>

#include "equipoise/results/types/fate.hpp"

namespace equipoise {

struct NoAttractor {
  Outcome outcome;
  short code;        ///< in files and arrays, where an attractor has its identifier
  const char* name;  ///< its one word
};
inline constexpr std::array<NoAttractor, 4> no_attractors{{
    {Outcome::undecided, undecided_code, "undecided"},
    {Outcome::diverged, diverged_code, "diverged"},
    {Outcome::failed, failed_code, "failed"},
    {Outcome::stalled, stalled_code, "stalled"},
}};
constexpr const NoAttractor& told_of(Outcome outcome) {
  for (const NoAttractor& n : no_attractors)
    if (n.outcome == outcome) return n;
  return no_attractors[2];
}

}  // namespace equipoise
