// What balls do to each other and to the race where they touch or stick: between events, and at them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// What is constant between two events.
struct BallMode {
  std::array<bool, model::max_balls> held{};    ///< by stiction
  std::array<bool, model::max_balls> joined{};  ///< the ball in place k around the race presses on the next one
  std::array<int, model::max_balls> order{};    ///< of the balls around the race

  bool any_held(int balls) const;
  bool all_held(int balls) const;
  bool any_joined(int balls) const;
  bool operator==(const BallMode&) const = default;
};

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
std::string text_of(const BallMode& mode, int balls);

}  // namespace equipoise
