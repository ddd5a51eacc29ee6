// The answer in one sentence: how reliably the rotor balances, which limits are exceeded, what is not known.
#include "equipoise/report/answers/answer.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

// Bounds that hold whatever undecided starts come to, if those could change the interval.
std::string surely(const Share& s) {
  const bool wider = s.least < s.low || s.most > s.high;
  return wider ? fmt::format(", bounds {:.{}f} to {}", 100.0 * s.least, digits_for(s), percent(s.most, digits_for(s)))
               : "";
}

std::string balance_words(const BasinResult& r) {
  const OutcomeShare& balanced = r.attractors.front();
  const Share& s = balanced.share;
  if (s.count == 0)
    return fmt::format("None of {} runs balanced; the probability is {} (95 % confidence{})", r.starts, share_words(s),
                       surely(s));
  const bool plain = balanced.name == "balanced";  // otherwise held by friction
  return fmt::format("The rotor ends {} in {} of runs (95 % confidence{})",
                     plain ? balanced.name : "\"" + balanced.name + "\"", share_words(s), surely(s));
}

std::string limit_words(const BasinResult& r) {
  if (!r.transients || r.transients->groups.empty()) return "";
  std::string text;
  for (const ToldLimit& limit : told_limits(r.study))
    if (const auto& exceeded = r.transients->groups.front().exceeded[limit.place])
      text += fmt::format("; {} in {}", limit.words, share_words(*exceeded));
  return text;
}

// Of a rotor that has no balls.
std::string bare_answer(const BasinResult& r) {
  const PageQuantities shown(r.study);
  const TransientGroup& g = r.without_balls->bare.figures;
  const auto figure = [&](float TransientRow::*value) {
    return shown.text(g.figure(value).quantiles[0].value, *transient_figures[figure_place(value)].dimension);
  };
  return fmt::format("There are no balls: the rotor's peak displacement is {}, and its RMS velocity at the end {}{}.",
                     figure(&TransientRow::peak_radial), figure(&TransientRow::rms_velocity),
                     r.without_balls->bare.one ? "" : ", in the median");
}

}  // namespace

std::string share_words(const Share& s) {
  const int digits = digits_for(s);
  if (s.total == 0) return "an unknown share";
  if (s.count == 0) return "less than " + percent(s.high, digits);
  if (s.count == s.total) return "more than " + percent(s.low, digits);
  return interval(s);
}

std::vector<std::string> drawn_keys(const Study& study, const std::vector<std::string>& set) {
  std::vector<std::string> keys;
  for (const UncertainValue& value : study.uncertain.values)
    if (std::find(set.begin(), set.end(), value.key) == set.end()) keys.push_back(value.key);
  return keys;
}

std::vector<ToldLimit> told_limits(const Study& study) {
  const PageQuantities shown(study);
  std::vector<ToldLimit> told;
  for (std::size_t k = 0; k < transient_limits.size(); ++k)
    if (const TransientLimit& l = transient_limits[k]; study.limits.*l.limit)
      told.push_back({k, shown.text(*(study.limits.*l.limit), l.told_in()) + l.exceeded});
  return told;
}

std::string after_what_is_drawn(std::vector<std::string> keys, std::string sentence) {
  if (keys.empty()) return sentence;
  std::transform(keys.begin(), keys.end(), keys.begin(), key_words);
  const std::string last = keys.back();
  keys.pop_back();
  sentence.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence.front())));
  return fmt::format("With {}{}{} sampled for each run, {}", fmt::join(keys, ", "), keys.empty() ? "" : " and ", last,
                     sentence);
}

std::string answer_sentence(const BasinResult& r) {
  if (r.study.parameters.balls == 0 && r.without_balls) return bare_answer(r);
  if (r.starts == 0 || r.attractors.empty()) return "Nothing is known yet: stopped before the first run was decided.";
  std::string text = balance_words(r);
  if (r.stalled && r.stalled->count > 0) text += fmt::format("; {} never come up to speed", share_words(*r.stalled));
  text += limit_words(r);
  if (r.undecided.count > 0)
    text += fmt::format("; {} stay undecided", percent(r.undecided.share, digits_for(r.undecided)));
  if (const std::uint64_t lost = r.lost(); lost > 0)
    text += fmt::format("; {} could not be followed to an end", lost == 1 ? "1 start" : fmt::format("{} starts", lost));
  return after_what_is_drawn(drawn_keys(r.study), text + ".");
}

}  // namespace equipoise
