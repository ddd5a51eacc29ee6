// How motions change within a part of a family: rotors all over it are started on one rotor's motion.
#include "equipoise/classification/attractor_search/search.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "equipoise/simulation/rule/window_features.hpp"

namespace equipoise {

namespace {

// Rotors to start: more of them if more values differ.
std::vector<const OwnRotor*> tried(const Search& s) {
  constexpr std::size_t most = 128;
  const std::size_t wanted = std::size_t{24} << std::min<std::size_t>(s.rotors.front().coordinates.size(), 3);
  std::vector<const OwnRotor*> own = pointers_to(s.rotors);
  own.resize(std::min({most, wanted, own.size()}));
  return own;
}

// Chaos has ended if the rotor ends in another motion; chaos that becomes regular keeps its name.
std::vector<FeatureTrends::Lasting> lasting(Search& s, int attractor, const Eigen::VectorXd& state) {
  const std::vector<const OwnRotor*> own = tried(s);
  std::vector<double> states;
  for (std::size_t k = 0; k < own.size(); ++k) states.insert(states.end(), state.begin(), state.end());
  const ClassificationRule& rule = s.result.rule;
  const std::vector<Outcome> outcomes = s.outcomes_of(states, own, rule, rule.chaos_lasts / rule.first_long_window);
  std::vector<FeatureTrends::Lasting> result;
  for (std::size_t k = 0; k < own.size(); ++k)
    result.push_back({own[k]->coordinates, outcomes[k].attractor == attractor ||
                                               outcomes[k].kind == OutcomeKind::undecided ||
                                               outcomes[k].time >= 0.9 * rule.chaos_lasts});
  return result;
}

}  // namespace

bool add_trend(Search& s, Candidate& c) {
  if (!s.drawn || is_dear(s.system)) return !s.is_stopped();
  const std::vector<const OwnRotor*> own = tried(s);
  const std::vector<PilotRecord> windows = s.windows_of({own.size(), &*c.motion}, own);
  if (s.is_stopped()) return false;
  std::vector<ShownFeatures> others;
  for (std::size_t k = 0; k < windows.size(); ++k)
    if (windows[k].finished_window) others.push_back({own[k]->coordinates, windows[k].features});
  const OwnRotor& first = c.own ? *c.own : s.rotors.front();
  c.trend =
      s.result.trends.add(s.balls(), agreement(c.motion->kind), {first.coordinates, c.features}, std::move(others));
  if (c.trend < 0) return true;
  for (OwnRotor& rotor : s.rotors) s.result.trends.place(rotor);
  for (OwnRotor& rotor : s.pilot.rotors()) s.result.trends.place(rotor);
  return true;
}

bool follow_chaos(Search& s, const std::map<int, Eigen::VectorXd>& chaos) {
  std::map<int, int> numbers;
  for (const auto& [attractor, state] : chaos) {
    if (is_dear(s.system)) continue;
    numbers[attractor] = s.result.trends.add_chaos(lasting(s, attractor, state));
    if (s.is_stopped()) return false;
  }
  const int unknown = static_cast<int>(numbers.size());
  for (KnownFeatures& known : s.result.rule.known)
    if (known.chaos >= 0) known.chaos = numbers.contains(known.attractor) ? numbers[known.attractor] : unknown;
  for (FeatureBox& box : s.result.rule.boxes)
    if (numbers.contains(box.attractor)) box.chaos = numbers[box.attractor];
  return true;
}

Features of_middle(const Search& s, const Candidate& c, const Features& f, const OwnRotor* own) {
  return brought_back(f, c.trend, shifts_of(own), s.balls());
}

}  // namespace equipoise
