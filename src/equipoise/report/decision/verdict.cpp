// Judges an ensemble against limits and against the rotor without balls.
#include "equipoise/report/decision/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "equipoise/report/decision/standards_text.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/study/contents/below_resonance.hpp"
#include "equipoise/report/reports/transient_report.hpp"

namespace equipoise {

namespace {

constexpr char do_not_fit_because[] = "Don't fit it: {}.";
constexpr char leave_it_out[] = "Leave the balancer out.";
constexpr char more_torque[] = "The rotor stalls even without balls: give its motor more torque.";

// The share of starts that have to keep all limits if [limits] states none.
constexpr double usual_required_share = 0.95;
// The most that a peak without balls may be exceeded, and the part of its velocity that counts as an improvement.
constexpr double larger_peak = 1.1, quieter_end = 0.5;

constexpr std::size_t median = 0, ninety = 1;
static_assert(reported_quantiles[median] == 0.5 && reported_quantiles[ninety] == 0.9);

// An ensemble's vibration over that of the same rotors without balls.
// Where every start has the same rotor, that rotor's one run is what each start is compared with; else each of the
// first starts is compared with the run of its own rotor.
struct TimesBare {
  // Of starts, by their RMS velocity at the end over that without balls; bounds hold however undecided starts end.
  std::array<QuantileEstimate, reported_quantiles.size()> end_velocity{};
  // The peak that nine starts of ten stay below, over the peak that nine rotors of ten stay below without balls.
  QuantileEstimate peak;
};

// If neither vibrates, the ratio is 0.
double over(double with, double bare) { return with == 0.0 ? 0.0 : with / bare; }

QuantileEstimate over(const QuantileEstimate& with, double bare) {
  return {over(with.value, bare), over(with.low, bare), over(with.high, bare)};
}

TimesBare over_one_run(const TransientGroup& with, const TransientGroup& bare) {
  TimesBare times;
  for (std::size_t q = 0; q < reported_quantiles.size(); ++q)
    times.end_velocity[q] =
        over(with.sure_end_velocity[q], bare.figure(&TransientRow::rms_velocity).quantiles[q].value);
  times.peak = over(with.figure(&TransientRow::peak_radial).quantiles[ninety],
                    bare.figure(&TransientRow::peak_radial).quantiles[ninety].value);
  return times;
}

// Undecided starts may come to rest, or to more than any other.
TimesBare pair_by_pair(const std::vector<PairedStart>& with, const std::vector<PairedStart>& bare) {
  Distribution seen, least, most, peaks, bare_peaks;
  for (std::size_t i = 0; i < std::min(with.size(), bare.size()); ++i) {
    const PairedStart &w = with[i], &b = bare[i];
    if (std::isnan(w.peak_radial) || std::isnan(b.peak_radial)) continue;
    const auto velocity = static_cast<float>(over(w.rms_velocity, b.rms_velocity));
    seen.add(velocity, w.weight);
    least.add(w.undecided ? 0.0f : velocity, w.weight);
    most.add(w.undecided ? std::numeric_limits<float>::infinity() : velocity, w.weight);
    peaks.add(w.peak_radial, w.weight);
    bare_peaks.add(b.peak_radial, w.weight);
  }
  TimesBare times{seen.summary().quantiles, {}};
  const auto low = least.summary().quantiles, high = most.summary().quantiles;
  for (std::size_t q = 0; q < reported_quantiles.size(); ++q) {
    times.end_velocity[q].low = low[q].low;
    times.end_velocity[q].high = high[q].high;
  }
  times.peak = over(peaks.summary().quantiles[ninety], bare_peaks.summary().quantiles[ninety].value);
  return times;
}

TimesBare times_bare(const BasinResult& r) {
  const TransientResult& with = *r.transients;
  const OneBodyRuns& bare = r.without_balls->bare;
  return bare.one ? over_one_run(with.groups.front(), bare.figures) : pair_by_pair(with.first, bare.first);
}

class Judge {
 public:
  explicit Judge(const BasinResult& r)
      : r_(r),
        with_(r.transients->groups.front()),
        bare_(r.without_balls->bare),
        none_(bare_.figures),
        times_(times_bare(r)) {}

  BalancerVerdict verdict(std::span<const TriedChange> tried) {
    if (const auto& kept = with_.kept())
      by_limits(*kept);
    else
      by_comparison();
    if (const std::string below = below_resonance_words(r_.study); !below.empty()) leave_out(below);
    verdict_.change = verdict_.leave_out                    ? leave_it_out
                      : verdict_.decision == Decision::fit  ? "No change is needed."
                      : stalls_alone()                      ? more_torque
                      : verdict_.decision == Decision::open ? more_starts()
                      : !tried.empty()                      ? best_words(tried)
                                       : "Run \"equipoise design\" to search for a better balancer.";
    return std::move(verdict_);
  }

 private:
  void say(Decision decision, std::string words) {
    verdict_.decision = decision;
    verdict_.words = std::move(words);
  }

  void leave_out(const std::string& below) {
    say(Decision::do_not_fit, fmt::format(do_not_fit_because, below));
    verdict_.leave_out = true;
  }

  // "98.2 % (97.9 to 98.5 %)"
  static std::string share_words(const Share& s) { return fmt::format("{} ({})", share_text(s), interval(s)); }

  std::string shown(double value, study::Dimension d) const {
    const study::ShownUnit unit = unit_of(r_.study, d);
    return fmt::format("{:.3g} {}", value * unit.size, unit.name);
  }

  double required() const { return r_.study.limits.share.value_or(usual_required_share); }

  void by_limits(const Share& kept) {
    const double needed = required();
    const auto& bare = none_.kept();
    const bool bare_keeps = bare && bare->total > 0 && (bare_.one ? bare->count > 0 : bare->least >= needed);
    verdict_.leave_out = bare_keeps;
    verdict_.because = fmt::format("{} of runs stay within every limit{}.", share_words(kept), by_phase(kept, needed));
    if (const std::string without = bare_limit_words(bare_, r_.study); !without.empty())
      verdict_.because += " " + without + ".";
    const std::string asked = percent_text(needed);
    if (bare_keeps) {
      const std::string meets = bare_.one ? "the rotor meets every limit without"
                                          : fmt::format("at least {} of runs meet every limit without", asked);
      if (kept.most < needed)
        say(Decision::do_not_fit, fmt::format("Don't fit it: {} balls; with them too few runs do.", meets));
      else
        say(Decision::not_needed, fmt::format("You don't need a balancer: {} one.", meets));
    } else if (kept.least >= needed) {
      const std::string more = larger_peaks();
      if (!more.empty() && !bounds_the_way())
        say(Decision::caution, fit_if_it_may_vibrate(more));
      else
        say(Decision::fit, fmt::format("Fit it: at least {} of runs stay within every limit{}.", asked,
                                       more.empty() ? "" : ", though " + more));
    } else if (kept.most < needed) {
      if (worse_at_end())
        say(Decision::do_not_fit,
            fmt::format("Don't fit it as it is: too few runs stay within every limit ({} required), and half of them "
                        "end up vibrating more than without balls.",
                        asked));
      else
        say(Decision::change, "Change the design: " + what_fails(kept, needed));
    } else {
      const bool open = kept.least < kept.low || kept.most > kept.high;
      say(Decision::open,
          fmt::format("Too close to call: {} of runs stay within every limit{}; {} required.", share_words(kept),
                      open ? ", bounds " + bounds_text(kept) + " however undecided runs end" : "", asked));
    }
  }

  // ": 9.2 % during start-up, 40 % at full speed", if runs exceed limits in both.
  std::string by_phase(const Share& kept, double needed) const {
    const auto &end = with_.within[static_cast<std::size_t>(Within::at_end)],
               &way = with_.within[static_cast<std::size_t>(Within::on_the_way)];
    if (!end || !way || kept.share >= needed || end->count == end->total || way->count == way->total) return "";
    return fmt::format(": {} {}, {} {}", percent_text(way->share), phases_[0], percent_text(end->share), phases_[1]);
  }

  // Names the limit that most runs exceed, if that alone fails the balancer.
  std::string what_fails(const Share& kept, double needed) const {
    const Share* worst = nullptr;
    std::size_t which = 0;
    bool at_end = false;
    const auto consider = [&](const std::optional<Share>& s, std::size_t k, bool end) {
      if (!s || (worst && s->share <= worst->share)) return;
      worst = &*s, which = k, at_end = end;
    };
    for (std::size_t k = 0; k < transient_limits.size(); ++k) {
      consider(with_.exceeded[k], k, transient_limits[k].at_end);
      consider(with_.exceeded_at_end[k], k, true);
    }
    if (!worst || !(worst->least > 1.0 - needed))
      return fmt::format("only {} of runs stay within every limit; {} required.", share_words(kept),
                         percent_text(needed));
    const TransientLimit& limit = transient_limits[which];
    const bool of_settling = limit.value == &TransientRow::settling_time;  // an end, but not a motion there
    std::string words = fmt::format("{} of runs exceed the {} limit on {}{} ({}); at most {} may.", share_text(*worst),
                                    shown(*(r_.study.limits.*limit.limit), limit.told_in()),
                                    limit.by_speed ? limit.measured : figure_name(at_end ? limit.end : limit.value),
                                    of_settling ? "" : fmt::format(" {}", phases_[at_end]), interval(*worst),
                                    fmt::format("{:.3g} %", 100.0 * (1.0 - needed)));
    const auto& end = with_.within[static_cast<std::size_t>(Within::at_end)];
    if (!at_end && end && end->count == end->total) {
      words += fmt::format(" {} every run meets the limits.", capitalised(phases_[1]));
    }
    return words;
  }

  // Then its peaks may be what they are.
  bool bounds_the_way() const { return r_.study.limits.displacement || r_.study.limits.clearance; }

  void by_comparison() {
    const study::ShownUnit unit = unit_of(r_.study, study::Dimension::velocity);
    const QuantileEstimate &most = with_.sure_end_velocity[ninety], &times = times_.end_velocity[ninety];
    const double without = none_.figure(&TransientRow::rms_velocity).quantiles[ninety].value;
    const auto number = [&](double v) { return std::isfinite(v) ? fmt::format("{:.3g}", v * unit.size) : "?"; };
    const std::string low = number(most.low), high = number(most.high);
    verdict_.because = fmt::format(
        "In 9 of 10 runs the RMS velocity {} is at most {} {}{}; without balls {}{}.", phases_[1], number(most.value),
        unit.name, low == high ? "" : fmt::format(" ({} to {})", low, high), number(without),
        bare_.one ? ""
                  : fmt::format(". In 9 of 10 runs it is at most {} times that of the same rotor without balls",
                                fmt::format("{:.2g}", times.value)));
    if (times.high <= quieter_end) {
      if (const std::string more = larger_peaks(); !more.empty())
        say(Decision::caution, fit_if_it_may_vibrate(more));
      else
        say(Decision::fit, "Fit it: in 9 of 10 runs at most half of the vibration is left.");
    } else if (worse_at_end()) {
      say(Decision::do_not_fit, "Don't fit it as it is: half of the runs end up vibrating more than without balls.");
    } else if (times.low > quieter_end) {
      say(Decision::change, "Change the design: too many runs end with more than half of the vibration without balls.");
    } else {
      say(Decision::open, "Too close to call: whether 9 of 10 runs end with at most half of the vibration.");
    }
  }

  bool worse_at_end() const { return times_.end_velocity[median].low > 1.0; }

  std::string peak_words(double peak) const {
    return fmt::format("1 run in 10 peaks above {}", shown(peak, study::Dimension::length));
  }

  // "1 run in 10 peaks above 26.6 mm (18.2 mm without balls)"; empty if it is not certainly larger.
  std::string larger_peaks() const {
    if (!(times_.peak.low > larger_peak)) return "";
    const auto most = [](const TransientGroup& group) {
      return group.figure(&TransientRow::peak_radial).quantiles[ninety].value;
    };
    return fmt::format("{} ({} without balls)", peak_words(most(with_)), shown(most(none_), study::Dimension::length));
  }

  std::string fit_if_it_may_vibrate(const std::string& more) const {
    return fmt::format("Fit it if you can accept more vibration {}: {}.", phases_[0], more);
  }

  // "Twice the drag: 199 of 200 trial runs stayed within every limit (97.2 to 99.9 %)."
  std::string best_words(std::span<const TriedChange> tried) const {
    constexpr char further[] = "run \"equipoise design\" to search further.";
    const TriedChange* best = &tried.front();
    for (const TriedChange& t : tried)
      if (serves_better(t, *best)) best = &t;
    const std::string change = capitalised(best->words);
    const std::string figure =
        best->kept ? fmt::format("{} of {} trial runs stayed within every limit ({})", best->kept->count, best->starts,
                                 interval(*best->kept))
                   : fmt::format("RMS velocity {} at most {} in 9 of 10 of {} trial runs", phases_[1],
                                 shown(best->end_velocity.value, study::Dimension::velocity), best->starts);
    const std::string peak = peak_words(best->peak.value);
    if (best->decision == Decision::fit)
      return fmt::format("{}: {}{}.", change, figure, verdict_.decision == Decision::caution ? "; " + peak : "");
    if (best->decision == Decision::caution) {
      const double now = with_.figure(&TransientRow::peak_radial).quantiles[ninety].value;
      if (best->peak.high < now) return fmt::format("{}: {} ({} trial runs).", change, peak, best->starts);
      return fmt::format("None of the {} changes tried is shown to lower the peak; {}", tried.size(), further);
    }
    if (best->kept && best->kept->count == 0)
      return fmt::format("With none of the {} changes tried does a run stay within every limit; {}", tried.size(),
                         further);
    if (best->decision == Decision::open && best->kept && best->kept->share >= required())
      return fmt::format("{}: {}. That is too few runs to be sure of {}: rerun with it set.", change, figure,
                         percent_text(required()));
    return fmt::format("{}: {}. None of the {} changes tried is enough; {}", change, figure, tried.size(), further);
  }

  // Balls may bring a rotor through a resonance at which it stalls without them.
  bool stalls_alone() const {
    const std::uint64_t short_of_speed = (r_.stalled ? r_.stalled->count : 0) + r_.undecided.count;
    return bare_.runs > 0 && bare_.stalled == bare_.runs && 2 * short_of_speed > r_.starts;
  }

  std::string more_starts() const {
    const Share& undecided = r_.undecided;
    if (undecided.count > 0)
      return fmt::format("{} of runs are undecided: raise the time limit, numerics.horizon, to settle it.",
                         percent_text(undecided.share));
    return fmt::format("Run more: --starts {}.", 4 * std::max<std::uint64_t>(r_.starts, 250));
  }

  const BasinResult& r_;
  const TransientGroup& with_;
  const OneBodyRuns& bare_;
  const TransientGroup& none_;
  const TimesBare times_;
  const std::array<const char*, 2> phases_ = phase_words(r_.study);
  BalancerVerdict verdict_;
};

}  // namespace

std::string below_resonance_words(const Study& study) {
  if (!runs_below_resonance(study)) return "";
  const auto critical = model::critical_speeds(study.parameters);
  // Balls that hang below the shaft gather nowhere.
  const char* there = study.parameters.gravity == 0.0 ? "balls gather on the heavy side and add to the unbalance"
                                                      : "balls cancel no unbalance";
  if (!study.uncertain.empty())
    return fmt::format("the rotor runs below its critical speed with balls, whatever is drawn: there {}", there);
  return fmt::format("the rotor runs at {}, below its critical speed of {} with balls: there {}",
                     engineering(study.scales, std::fabs(study.speed_profile().final_speed()), study::Dimension::speed),
                     engineering(study.scales, std::min(critical[0], critical[1]), study::Dimension::speed), there);
}

std::optional<BalancerVerdict> verdict_of(const BasinResult& r, std::span<const TriedChange> tried) {
  if (tells_without_balls(r) && r.without_balls->bare.figures.starts > 0) return Judge(r).verdict(tried);
  // Known before a start is.
  const std::string below = r.transients ? below_resonance_words(r.study) : "";
  if (below.empty()) return std::nullopt;
  return BalancerVerdict{Decision::do_not_fit, fmt::format(do_not_fit_because, below), by_linear_theory, leave_it_out,
                         true};
}

std::optional<TriedChange> tried_change(std::string words, const BasinResult& r) {
  const auto verdict = verdict_of(r);
  if (!verdict) return std::nullopt;
  const TransientGroup& all = r.transients->groups.front();
  return TriedChange{std::move(words),
                     r.study,
                     r.starts,
                     verdict->decision,
                     all.kept(),
                     all.sure_end_velocity[ninety],
                     all.figure(&TransientRow::peak_radial).quantiles[ninety],
                     r.seconds,
                     r.cpu_seconds};
}

namespace {
// Lower is better.
int standing(Decision d) {
  return d == Decision::fit || d == Decision::not_needed ? 0 : d == Decision::caution ? 1 : d == Decision::open ? 2 : 3;
}
}  // namespace

bool serves_better(const TriedChange& a, const TriedChange& b) {
  if (standing(a.decision) != standing(b.decision)) return standing(a.decision) < standing(b.decision);
  if (a.decision == Decision::caution && a.peak.value != b.peak.value) return a.peak.value < b.peak.value;
  if (a.kept && b.kept && a.kept->share != b.kept->share) return a.kept->share > b.kept->share;
  if (a.end_velocity.value != b.end_velocity.value) return a.end_velocity.value < b.end_velocity.value;
  return a.peak.value < b.peak.value;
}

bool may_serve_better(const TriedChange& a, const TriedChange& b) {
  if (standing(a.decision) != standing(b.decision)) return standing(a.decision) < standing(b.decision);
  if (a.kept && b.kept) return a.kept->high >= b.kept->low;
  return !(a.end_velocity.low > b.end_velocity.high);
}

Tone tone_of(Decision decision) {
  return decision == Decision::fit || decision == Decision::not_needed ? Tone::good
         : decision == Decision::do_not_fit                            ? Tone::bad
                                                                       : Tone::open;
}

DocumentTable changes_table(const BasinResult& r, std::span<const TriedChange> tried, std::size_t most) {
  const auto as_it_is = tried_change("as it is", r);
  if (tried.empty() || !as_it_is) return {};
  const bool limited = as_it_is->kept.has_value();
  std::vector<TriedChange> order(tried.begin(), tried.end());
  std::stable_sort(order.begin(), order.end(), serves_better);
  if (order.size() > most) order.resize(most);
  order.push_back(*as_it_is);
  const study::ShownUnit velocity = unit_of(r.study, study::Dimension::velocity),
                         length = unit_of(r.study, study::Dimension::length);
  DocumentTable table{{"change",
                       limited ? "within every limit" : fmt::format("RMS velocity at the end, {}", velocity.name),
                       fmt::format("peak displacement, {}", length.name)}};
  const auto number = [](const QuantileEstimate& q, const study::ShownUnit& unit) {
    return number_cell(std::isfinite(q.value) ? fmt::format("{:.3g}", q.value * unit.size) : "-");
  };
  for (const TriedChange& t : order) {
    const bool change = t.words != as_it_is->words;
    table.rows.push_back(
        {{t.words, change && tone_of(t.decision) == Tone::good ? Tone::good : Tone::plain, false, true},
         limited ? number_cell(t.kept ? share_with_interval(*t.kept) : "-") : number(t.end_velocity, velocity),
         number(t.peak, length)});
  }
  const auto [fewest, all] = std::minmax_element(
      tried.begin(), tried.end(), [](const TriedChange& a, const TriedChange& b) { return a.starts < b.starts; });
  const std::string starts = fewest->starts == all->starts
                                 ? fmt::format("each on {} starts", all->starts)
                                 : fmt::format("each on {} starts, or on {} where that was enough to see it fail",
                                               all->starts, fewest->starts);
  table.caption =
      fmt::format("{}{} changes tried, {}, best first. {}.", tried.size() > most ? "Of " : "", tried.size(), starts,
                  limited ? "Shares with their 95 % intervals; peak: 90 % of starts below"
                          : "Velocity and peak: 90 % of starts below");
  return table;
}

Notice verdict_notice(const BalancerVerdict& v) {
  return {v.words, tone_of(v.decision), {{"why", v.because}, {"try next", v.change}}};
}

std::string verdict_text(const BalancerVerdict& v, const TextStyle& style) {
  return document_text({"", {verdict_notice(v)}}, style) + "\n";
}

void to_json(Json& json, Decision decision) { json = decision_names[static_cast<std::size_t>(decision)]; }

void to_json(Json& json, const TriedChange& t) {
  const auto figure = [&](const QuantileEstimate& e, study::Dimension d) {
    const study::ShownUnit unit = unit_of(t.study, d);
    Json one = object("unit", unit.name);
    one.update(Json(times(e, unit.size)));
    return one;
  };
  json = object("words", t.words, "starts", t.starts, "decision", t.decision);
  if (t.kept) put(json, "kept", sure(*t.kept));
  put(json, "rms_velocity_90", figure(t.end_velocity, study::Dimension::velocity), "peak_radial_90",
      figure(t.peak, study::Dimension::length), "seconds", t.seconds, "cpu_seconds", t.cpu_seconds);
}

void to_json(Json& json, const PartOf<BalancerVerdict, std::span<const TriedChange>>& of) {
  const BalancerVerdict& v = of.part;
  json = object("decision", v.decision, "words", v.words, "because", v.because, "change", v.change);
  if (!of.whole.empty()) put(json, "tried", list_of(of.whole, [](const TriedChange& t) { return Json(t); }));
}

}  // namespace equipoise
