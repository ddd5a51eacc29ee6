// Sentences about starts.
#include "equipoise/report/answers/start_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/machine/balance/coincident_balls.hpp"
#include "equipoise/report/text/quantities.hpp"

namespace equipoise {

namespace {

const char* held_by_default(Profile profile) {
  if (profile == Profile::trapezoid) return "the end of the rise";
  if (profile == Profile::hill) return "the end of the run-up";
  return profile == Profile::points ? "the last point of the speed" : "the end of the ramp";
}

}  // namespace

std::string release_text(const Study& study) {
  const double until = study.release_time();
  if (!(until > 0.0)) return "";
  const auto speed = [&] { return engineering(study.scales, *study.release.speed, study::Dimension::speed); };
  if (std::isinf(until)) return "balls held until the rotor comes to " + speed();
  std::string text = "balls held until t = " + engineering(study.scales, until, study::Dimension::time);
  if (study.release.speed) return text + ", at speed " + speed();
  return study.release.time ? text : fmt::format("{}, {}", text, held_by_default(study.speed.profile));
}

std::vector<std::string> drawn_instead(const Study& study) {
  std::vector<std::string> keys;
  const InitialState& s = study.initial;
  const SamplingBox& box = study.sampling.box;
  if (states_angles(study)) keys.emplace_back("initial.phi");
  const auto add = [&](const char* key, const auto& side, double value) {
    if (side && value != 0.0) keys.emplace_back(key);
  };
  add("initial.x", box.x, s.x);
  add("initial.y", box.y, s.y);
  add("initial.x_dot", box.x_dot, s.x_dot);
  add("initial.y_dot", box.y_dot, s.y_dot);
  const bool turning = std::any_of(s.phi_dot.begin(), s.phi_dot.end(), [](double rate) { return rate != 0.0; });
  add("initial.phi_dot", box.phi_dot, turning);
  return keys;
}

std::string drawn_instead_text(const Study& study) {
  const std::vector<std::string> keys = drawn_instead(study);
  if (keys.empty()) return "";
  return fmt::format("drawn with each start, not taken from the study: {}; simulate starts from there\n",
                     fmt::join(keys, ", "));
}

std::string coincident_text(const Study& study) {
  const model::Parameters& p = study.parameters;
  const InitialState& s = study.initial;
  std::string pairs;
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k)
      if (model::coincide(p, i, k, s.phi.data(), s.phi_dot.data()))
        pairs += fmt::format("{}balls {} and {}", pairs.empty() ? "" : ", ", k + 1, i + 1);
  if (pairs.empty()) return "";
  return pairs +
         " are alike and start in one place; computed exactly they would stay together, and real ones part: they are "
         "set about 1e-9 rad apart";
}

}  // namespace equipoise
