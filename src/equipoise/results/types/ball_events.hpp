// What balls do to each other and to the race where they touch or stick: between events, and at them.
#pragma once

#include <string>
#include <vector>

#include "equipoise/machine/model/ball_mode.hpp"

namespace equipoise {

bool any_held(const model::BallMode& mode, int balls);
bool all_held(const model::BallMode& mode, int balls);
bool any_joined(const model::BallMode& mode, int balls);

enum class BallEventKind {
  strike,  ///< two balls rebound
  press,   ///< two balls touch and stay together
  part,    ///< they part
  stick,   ///< a ball comes to rest and stays
  slip,    ///< it starts
  turn,    ///< it turns round without staying
};

struct BallEvent {
  double time = 0.0;
  BallEventKind kind = BallEventKind::strike;
  int ball = 0, other = -1;  ///< from 0; `other` of pairs only

  /// The same event but for its time.
  bool is_like(const BallEvent& e) const { return kind == e.kind && ball == e.ball && other == e.other; }
};

/// Events in a row, "1|2 strike (3 times), 2 sticks"; the balls count from 1.
std::string text_of(const std::vector<BallEvent>& events);
/// What lasts: "1|2 touch, 3 sticks"; empty if nothing does.
std::string text_of(const model::BallMode& mode, int balls);

}  // namespace equipoise
