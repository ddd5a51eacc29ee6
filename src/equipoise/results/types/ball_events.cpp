// Modes and events in words.
#include "equipoise/results/types/ball_events.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include <fmt/format.h>

namespace equipoise {

namespace {
using Flags = std::array<bool, model::max_balls>;
bool among(const Flags& flags, int balls, bool value) {
  return std::find(flags.begin(), flags.begin() + balls, value) != flags.begin() + balls;
}
}  // namespace

bool any_held(const model::BallMode& mode, int balls) { return among(mode.held, balls, true); }
bool all_held(const model::BallMode& mode, int balls) { return !among(mode.held, balls, false); }
bool any_joined(const model::BallMode& mode, int balls) { return among(mode.joined, balls, true); }

namespace {

std::string text_of(const BallEvent& e) {
  constexpr std::array<const char*, 6> words{"strike", "touch and stay", "part", "sticks", "starts", "turns round"};
  const std::string who = e.other < 0
                              ? fmt::format("{}", e.ball + 1)
                              : fmt::format("{}|{}", std::min(e.ball, e.other) + 1, std::max(e.ball, e.other) + 1);
  return fmt::format("{} {}", who, words[static_cast<std::size_t>(e.kind)]);
}

void append(std::string& text, const std::string& part) { text += (text.empty() ? "" : ", ") + part; }

}  // namespace

std::string text_of(const std::vector<BallEvent>& events) {
  std::string text;
  for (std::size_t k = 0; k < events.size();) {
    std::size_t next = k + 1;
    while (next < events.size() && events[next].is_like(events[k])) ++next;
    append(text, text_of(events[k]) + (next - k > 1 ? fmt::format(" ({} times)", next - k) : ""));
    k = next;
  }
  return text;
}

std::string text_of(const model::BallMode& mode, int balls) {
  std::string text;
  for (int k = 0; k < balls; ++k) {
    if (!mode.joined[k]) continue;
    const int a = mode.order[k], b = mode.order[(k + 1) % balls];
    append(text, fmt::format("{}|{} touch", std::min(a, b) + 1, std::max(a, b) + 1));
  }
  if (all_held(mode, balls)) return "all stick";
  for (int i = 0; i < balls; ++i)
    if (mode.held[i]) append(text, fmt::format("{} sticks", i + 1));
  return text;
}

}  // namespace equipoise
