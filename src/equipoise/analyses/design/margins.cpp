// One number at a time.
#include "equipoise/analyses/design/race.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/analyses/design/settings.hpp"

namespace equipoise {

namespace {

// Changes of a number to either side, relative to its range.
constexpr std::array margin_parts{0.02, 0.05, 0.1, 0.2, 0.4};
constexpr double near_part = 0.1;  // range within which the effect is measured

// One number of a candidate that can be changed.
struct Movable {
  DesignVariable variable;  // for a point of a spin-up, its time or speed
  std::size_t setting = 0;
  StudyValue at;                 // the chosen value
  const char* member = nullptr;  // for a spin-up: times or speeds
  std::size_t entry = 0;
  double value = allowed_number(variable, at);

  bool ordered() const { return variable.choices.empty() || !variable.numbers.empty(); }
  StudyValue moved_value(double part) const {
    const std::vector<double>& numbers = variable.numbers;
    if (numbers.empty()) return value_of(moved(part), variable.unit, variable.whole);
    const std::size_t here = nearest_allowed(numbers, value), to = nearest_allowed(numbers, moved(part));
    return variable.choices[part > 0.0 ? std::max(to, std::min(here + 1, numbers.size() - 1))
                                       : std::min(to, here > 0 ? here - 1 : 0)];
  }

  // The number changed by a part of the range; unchanged if that leads out of the range.
  double moved(double part) const {
    const DesignVariable& v = variable;
    const double to = v.logarithmic ? value * std::pow(v.high / v.low, part) : value + part * (v.high - v.low);
    const double inside = std::clamp(to, v.low, v.high);
    return v.whole ? std::round(part > 0.0 ? std::max(inside, std::min(value + 1.0, v.high))
                                           : std::min(inside, std::max(value - 1.0, v.low)))
                   : inside;
  }
};

// A point keeps a tenth of the time to its neighbours, so that pieces do not vanish.
void add_points(const DesignVariable& v, std::size_t setting, const StudyValue& table, std::vector<Movable>& movables) {
  const StudyValue::Array &times = *table.find("times")->array(), &speeds = *table.find("speeds")->array();
  const auto last = times.size() - 1;
  const auto add = [&](const char* member, const StudyValue& at, std::size_t k, const std::string& unit, double low,
                       double high) {
    if (!(high > low)) return;
    DesignVariable number;
    number.key = fmt::format("{}.{}[{}]", v.key, member, k);
    number.unit = unit;
    number.low = low;
    number.high = high;
    movables.push_back({number, setting, at, member, k});
  };
  for (std::size_t k = 1; k <= last; ++k) {
    const auto time = [&](std::size_t place) { return number_of(times[place]); };
    add("times", times[k], k, v.spin_up->time_unit, time(k) - 0.9 * (time(k) - time(k - 1)),
        k < last ? time(k) + 0.9 * (time(k + 1) - time(k)) : v.spin_up->until);
    if (k < last) add("speeds", speeds[k], k, v.unit, v.low, v.high);
  }
}

bool within(const DesignVariable& v, const StudyValue& value) {
  const auto same = [&](const StudyValue& choice) { return text_of(choice) == text_of(value); };
  if (!v.choices.empty()) return std::any_of(v.choices.begin(), v.choices.end(), same);
  const double number = unit_of_value(value) == v.unit ? number_in_unit(value, v.unit) : NAN;
  return number >= v.low && number <= v.high;
}

std::vector<Movable> movables_of(const DesignProblem& problem, const DesignCandidate& chosen) {
  std::vector<Movable> movables;
  for (std::size_t k = 0; k < problem.variables().size(); ++k) {
    const DesignVariable& v = problem.variables()[k];
    const StudyValue& value = chosen.settings[k].value;
    if (v.spin_up && !chosen.as_it_is) add_points(v, k, value, movables);
    // The study itself may lie off the range, or state its value in other terms.
    if (!v.spin_up && (!chosen.as_it_is || within(v, value))) movables.push_back({v, k, value});
  }
  return movables;
}

std::vector<StudyValue> values_around(const Movable& m) {
  std::vector<StudyValue> values;
  const auto add = [&](const StudyValue& value) {
    const auto same = [&](const StudyValue& other) { return text_of(other) == text_of(value); };
    if (!same(m.at) && std::none_of(values.begin(), values.end(), same)) values.push_back(value);
  };
  if (m.ordered()) {
    for (const double part : margin_parts)
      for (const double side : {-part, part}) add(m.moved_value(side));
  } else {
    for (const StudyValue& choice : m.variable.choices) add(choice);
  }
  return values;
}

std::vector<DesignSetting> settings_with(const DesignCandidate& chosen, const Movable& m, const StudyValue& value) {
  if (chosen.as_it_is) return {{m.variable.key, value}};
  std::vector<DesignSetting> settings = chosen.settings;
  StudyValue& setting = settings[m.setting].value;
  if (!m.member) {
    setting = value;
    return settings;
  }
  StudyValue::Array entries = *setting.find(m.member)->array();
  entries[m.entry] = value;
  setting.set(m.member, StudyValue(entries));
  return settings;
}

class MarginJudge {
 public:
  MarginJudge(const DesignStanding& standing, const DesignSample& chosen)
      : problem_(standing.problem()), standing_(standing), chosen_(chosen) {}

  // What fails there; empty: nothing.
  std::string failure(const DesignSample& sample) const {
    if (sample.figures.empty()) return "no such study";
    for (const DesignLimit& limit : problem_.limits())
      if (standing_.violation(limit, sample, Side::estimate) > 0.0 &&
          standing_.violation(limit, chosen_, Side::estimate) == 0.0)
        return problem_.figures()[limit.figure].figure.name;
    const std::size_t first = problem_.objectives().front();
    const DesignEstimate &now = sample.figures[first], &best = chosen_.figures[first];
    const bool worse = problem_.figures()[first].figure.up ? now.high < best.low : now.low > best.high;
    return problem_.limits().empty() && worse ? problem_.figures()[first].figure.name : "";
  }

  void judge(DesignMargin& m, bool ordered) const {
    std::sort(m.points.begin(), m.points.end(),
              [](const DesignPoint& a, const DesignPoint& b) { return a.value < b.value; });
    m.keeps_from = m.keeps_to = m.value;
    for (auto p = m.points.rbegin(); p != m.points.rend(); ++p)
      if (ordered && p->value < m.value && m.fails_below.empty()) step(*p, m.keeps_from, m.fails_below);
    for (const DesignPoint& p : m.points)
      if (ordered && p.value > m.value && m.fails_above.empty()) step(p, m.keeps_to, m.fails_above);
    const std::size_t first = problem_.objectives().front();
    double below = m.low, above = m.high;  // the nearest that were tried
    for (const DesignPoint& p : m.points) {
      if (p.value < m.value) below = std::max(below, p.value);
      if (p.value > m.value) above = std::min(above, p.value);
    }
    for (const DesignPoint& p : m.points)
      if (!p.sample.figures.empty() && (!ordered || near(m, p.value) || p.value == below || p.value == above))
        m.effect = std::max(m.effect, change(p.sample.figures[first].value, chosen_.figures[first].value));
  }

 private:
  void step(const DesignPoint& p, double& keeps, std::string& fails) const {
    fails = failure(p.sample);
    if (fails.empty()) keeps = p.value;
  }
  static bool near(const DesignMargin& m, double value) {
    return std::fabs(value - m.value) <= near_part * (m.high - m.low) * (1.0 + 1e-3);  // values have six digits
  }
  static double change(double a, double b) { return std::isfinite(a) && std::isfinite(b) ? std::fabs(a - b) : 0.0; }

  const DesignProblem& problem_;
  const DesignStanding& standing_;
  const DesignSample& chosen_;
};

}  // namespace

std::size_t margin_points(const DesignProblem& problem) { return 2 * margin_parts.size() * problem.dimensions(); }

std::vector<DesignMargin> design_margins(const DesignStanding& standing, DesignEnsembles& ensembles,
                                         const DesignCandidate& chosen, std::uint64_t starts, std::uint64_t seed) {
  const DesignSample here = ensembles.run({{chosen.changes(), starts, seed}}).front();
  if (here.figures.empty()) return {};
  const MarginJudge judge(standing, here);
  std::vector<DesignMargin> margins;
  for (const Movable& m : movables_of(standing.problem(), chosen)) {
    const std::vector<StudyValue> values = values_around(m);
    std::vector<WantedSample> wanted;
    for (const StudyValue& value : values) wanted.push_back({settings_with(chosen, m, value), starts, seed});
    const std::vector<DesignSample> samples = ensembles.run(wanted);
    const DesignVariable& v = m.variable;
    DesignMargin& margin = margins.emplace_back();
    margin.key = v.key;
    margin.unit = v.unit;
    margin.prefix = v.prefix;
    margin.value = m.value;
    margin.low = v.low;
    margin.high = v.high;
    for (std::size_t k = 0; k < values.size(); ++k)
      margin.points.push_back({allowed_number(v, values[k]), text_of(values[k]), samples[k]});
    margin.here = here;
    judge.judge(margin, m.ordered());
  }
  std::stable_sort(margins.begin(), margins.end(),
                   [](const DesignMargin& a, const DesignMargin& b) { return a.effect > b.effect; });
  return margins;
}

std::vector<std::string> design_limits_reached(const DesignStanding& standing, const DesignCandidate& chosen) {
  const DesignProblem& problem = standing.problem();
  // Limits and ends of ranges count as reached within these parts.
  constexpr double close = 0.05, at_end = 0.01;
  std::vector<std::string> words;
  const DesignSample& sample = chosen.best_known();
  for (const DesignLimit& limit : problem.limits()) {
    if (sample.figures.empty()) break;
    const DesignFigure& figure = problem.figures()[limit.figure].figure;
    const double value = sample.figures[limit.figure].value, bound = limit.below ? *limit.below : *limit.above;
    const std::string unit = figure.share ? " %" : figure.unit.empty() ? "" : " " + figure.unit;
    const double shown = figure.share ? 100.0 : 1.0;
    const std::string has = fmt::format("{} is {:.4g}{}, must be {} {:.4g}{}", figure.name, shown * value, unit,
                                        limit.below ? "below" : "above", shown * bound, unit);
    if (standing.violation(limit, sample, Side::estimate) > 0.0)
      words.push_back("not met: " + has);
    else if (standing.violation(limit, sample, Side::worst) > 0.0)
      words.push_back("not shown to be met: " + has);
    else if (std::fabs(value - bound) <= close * (figure.share ? std::min(bound, 1.0 - bound) : std::fabs(bound)))
      words.push_back("nearly reached: " + has);
  }
  for (std::size_t k = 0; k < problem.variables().size(); ++k) {
    const DesignVariable& v = problem.variables()[k];
    if (v.spin_up || (!v.choices.empty() && v.numbers.empty())) continue;
    if (chosen.as_it_is && !within(v, chosen.settings[k].value)) continue;
    const double value = allowed_number(v, chosen.settings[k].value);
    const double part =
        v.logarithmic ? std::log(value / v.low) / std::log(v.high / v.low) : (value - v.low) / (v.high - v.low);
    if (part <= at_end || part >= 1.0 - at_end)
      words.push_back(fmt::format("{} is at the {} end of its range: {}{:.4g}{}", v.key,
                                  part <= at_end ? "lower" : "upper", v.prefix, value,
                                  v.unit.empty() ? "" : " " + v.unit));
  }
  return words;
}

}  // namespace equipoise
