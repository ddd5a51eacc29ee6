// The members of a fate, for search logs and messages.
#pragma once

#include "equipoise/core/base/bytes.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise {

constexpr Outcome last_of(Outcome) { return Outcome::stalled; }
constexpr DecidedBy last_of(DecidedBy) { return DecidedBy::followed; }

template <class Bytes, Like<Fate> T>
void members(Bytes& b, T& f) {
  b(f.outcome, f.by, f.attractor, f.time, f.mean_speed, f.unbalance, f.radius, f.met);
}

}  // namespace equipoise
