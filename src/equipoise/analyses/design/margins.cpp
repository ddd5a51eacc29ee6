// One number at a time.
#include "equipoise/analyses/design/margins.hpp"

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
  DesignMargin margin;
  bool logarithmic = false, whole = false;
  std::vector<StudyValue> choices;
  std::vector<double> numbers;
  std::size_t setting = 0;
  StudyValue at;                 // the chosen value
  const char* member = nullptr;  // for a spin-up: times or speeds
  std::size_t entry = 0;

  bool ordered() const { return choices.empty() || !numbers.empty(); }
  StudyValue moved_value(double part) const {
    if (numbers.empty()) return value_of(moved(part), margin.unit, whole);
    const std::size_t here = nearest_allowed(numbers, margin.value), to = nearest_allowed(numbers, moved(part));
    return choices[part > 0.0 ? std::max(to, std::min(here + 1, numbers.size() - 1))
                              : std::min(to, here > 0 ? here - 1 : 0)];
  }

  // The number changed by a part of the range; unchanged if that leads out of the range.
  double moved(double part) const {
    const DesignMargin& m = margin;
    const double to = logarithmic ? m.value * std::pow(m.high / m.low, part) : m.value + part * (m.high - m.low);
    const double inside = std::clamp(to, m.low, m.high);
    return whole ? std::round(part > 0.0 ? std::max(inside, std::min(m.value + 1.0, m.high))
                                         : std::min(inside, std::max(m.value - 1.0, m.low)))
                 : inside;
  }
};

// A point keeps a tenth of the time to its neighbours, so that pieces do not vanish.
void add_points(const DesignVariable& v, std::size_t setting, const StudyValue& table, std::vector<Movable>& movables) {
  const StudyValue::Array& times = *table.find("times")->array();
  const auto last = times.size() - 1;
  for (std::size_t k = 1; k <= last; ++k) {
    const auto time = [&](std::size_t place) { return number_of(times[place]); };
    Movable t{{}, false, false, {}, {}, setting, times[k], "times", k};
    t.margin.key = fmt::format("{}.times[{}]", v.key, k);
    t.margin.unit = v.spin_up->time_unit;
    t.margin.low = time(k) - 0.9 * (time(k) - time(k - 1));
    t.margin.high = k < last ? time(k) + 0.9 * (time(k + 1) - time(k)) : v.spin_up->until;
    if (t.margin.high > t.margin.low) movables.push_back(t);
    if (k == last) break;
    Movable s{{}, false, false, {}, {}, setting, (*table.find("speeds")->array())[k], "speeds", k};
    s.margin.key = fmt::format("{}.speeds[{}]", v.key, k);
    s.margin.unit = v.unit;
    s.margin.low = v.low;
    s.margin.high = v.high;
    movables.push_back(s);
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
    if (v.spin_up) {
      if (!chosen.as_it_is) add_points(v, k, value, movables);
      continue;
    }
    Movable m{{}, v.logarithmic, v.whole, v.choices, v.numbers, k, value, nullptr, 0};
    // The study itself may lie off the range, or state its value in other terms.
    if (chosen.as_it_is && !within(v, value)) continue;
    m.margin.prefix = v.prefix;
    m.margin.key = v.key;
    m.margin.unit = v.unit;
    m.margin.low = v.low;
    m.margin.high = v.high;
    movables.push_back(m);
  }
  for (Movable& m : movables) m.margin.value = allowed_number(m.choices, m.numbers, m.at);
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
    for (const StudyValue& choice : m.choices) add(choice);
  }
  return values;
}

std::vector<DesignSetting> settings_with(const DesignCandidate& chosen, const Movable& m, const StudyValue& value) {
  if (chosen.as_it_is) return {{m.margin.key, value}};
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
  MarginJudge(const DesignProblem& problem, const DesignStanding& standing, const DesignSample& chosen)
      : problem_(problem), standing_(standing), chosen_(chosen) {}

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

std::vector<DesignMargin> design_margins(const DesignProblem& problem, const DesignStanding& standing,
                                         DesignEnsembles& ensembles, const DesignCandidate& chosen,
                                         std::uint64_t starts, std::uint64_t seed) {
  const DesignSample here = ensembles.run({{chosen.changes(), starts, seed}}).front();
  if (here.figures.empty()) return {};
  const MarginJudge judge(problem, standing, here);
  std::vector<DesignMargin> margins;
  for (Movable& m : movables_of(problem, chosen)) {
    const std::vector<StudyValue> values = values_around(m);
    std::vector<WantedSample> wanted;
    for (const StudyValue& value : values) wanted.push_back({settings_with(chosen, m, value), starts, seed});
    const std::vector<DesignSample> samples = ensembles.run(wanted);
    for (std::size_t k = 0; k < values.size(); ++k)
      m.margin.points.push_back({allowed_number(m.choices, m.numbers, values[k]), text_of(values[k]), samples[k]});
    m.margin.here = here;
    judge.judge(m.margin, m.ordered());
    margins.push_back(std::move(m.margin));
  }
  std::stable_sort(margins.begin(), margins.end(),
                   [](const DesignMargin& a, const DesignMargin& b) { return a.effect > b.effect; });
  return margins;
}

std::vector<std::string> design_limits_reached(const DesignProblem& problem, const DesignStanding& standing,
                                               const DesignCandidate& chosen) {
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
    const double value = allowed_number(v.choices, v.numbers, chosen.settings[k].value);
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
