// Computes an ensemble, its motions, the distribution of its peaks and three runs.
#include "equipoise/report/shown/machine_page.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/report/shown/motion_path.hpp"
#include "equipoise/report/shown/shown_runs.hpp"

namespace equipoise {

namespace {

constexpr std::uint64_t most_starts_drawn = 1'000'000;
constexpr std::size_t most_motions_drawn = 6;
constexpr double least_drift = 1e-4;  // a slower ball looks at rest in a drawing

std::vector<BallOnMotion> balls_on(const MotionPath& path, const double* drift, double duration) {
  std::vector<BallOnMotion> balls;
  for (std::size_t i = 0; i < path.phi.size(); ++i) {
    const std::vector<double>& phi = path.phi[i];
    const auto [low, high] = std::minmax_element(phi.begin(), phi.end());
    BallOnMotion ball{phi.front(), *low, *high, drift ? drift[i] : (phi.back() - phi.front()) / duration};
    // Where no drift is known, a ball drifts if it moved by half a turn or more.
    const bool back = drift ? std::fabs(ball.drift) < least_drift : std::fabs(phi.back() - phi.front()) < 0.5 * two_pi;
    if (back && *high - *low < two_pi) ball.drift = 0.0;
    balls.push_back(ball);
  }
  return balls;
}

// Distances from the axis along a path.
std::vector<double> reach_of(const MotionPath& path) {
  std::vector<double> reach;
  for (std::size_t k = 0; k < path.x.size(); ++k) reach.push_back(std::hypot(path.x[k], path.y[k]));
  return reach;
}

// The path of the centre; of a tilting rotor, of the outermost of its bearings that moves more.
template <class PathAt>
void draw_shaft(DrawnMotion& drawn, const std::vector<double>& bearings, PathAt&& path_at) {
  if (bearings.empty()) {
    MotionPath path = path_at(0.0);
    drawn.x = std::move(path.x);
    drawn.y = std::move(path.y);
    return;
  }
  const auto [least, most] = std::minmax_element(bearings.begin(), bearings.end());
  drawn.r_max = -1.0;
  for (const double place : {*least, *most}) {
    MotionPath path = path_at(place);
    const std::vector<double> reach = reach_of(path);
    const auto [low, high] = std::minmax_element(reach.begin(), reach.end());
    if (reach.empty() || !(*high > drawn.r_max)) continue;
    drawn.bearing = place;
    drawn.x = std::move(path.x);
    drawn.y = std::move(path.y);
    drawn.r_min = *low;
    drawn.r_max = *high;
    drawn.r_mean = 0.5 * (*low + *high);
  }
}

// Balls are followed along their whole way, the shaft only for as many turns as keep the drawing clear.
void draw_path(const model::System& system, const Motion& motion, const std::vector<double>& bearings,
               DrawnMotion& drawn) {
  constexpr double most_turns = 24.0;
  constexpr int looks = 2000, looks_a_turn = 48;
  const double turn = turn_time(motion.speed), duration = whole_way(motion);
  drawn.balls = balls_on(motion_path(system, motion, duration, looks), motion.drift.data(), duration);
  const double turns = std::min(duration / turn, most_turns);
  const int count = std::max(looks_a_turn, static_cast<int>(turns * looks_a_turn));
  draw_shaft(drawn, bearings,
             [&](double place) { return motion_path(system, motion, turns * turn, count, {}, place); });
}

void draw_end(const Study& study, const StartArrays& starts, std::uint64_t index, const StopFlag* stop,
              DrawnMotion& drawn) {
  constexpr double longest = 20000.0, turns = 12.0;
  constexpr int looks_a_turn = 48;
  const double until = std::min<double>((*starts.transient("followed_until"))[index], longest);
  if (!(until > 0.0)) return;
  const double pace = std::max(1.0, std::fabs(study.system().pace()));
  const Trajectory run = start_run(study, index, until, two_pi / (looks_a_turn * pace), stop);
  if (run.stopped || run.t.size() < 2) return;
  std::size_t first = run.t.size() - 1;
  while (first > 0 && std::fabs(run.psi.back() - run.psi[first]) < turns * two_pi) --first;
  const double duration = run.t.back() - run.t[first];
  drawn.balls = balls_on(motion_path(study.parameters, run, first), nullptr, duration);
  const auto begin = run.radial.begin() + static_cast<std::ptrdiff_t>(first);
  const auto [low, high] = std::minmax_element(begin, run.radial.end());
  drawn.r_min = *low;
  drawn.r_max = *high;
  drawn.r_mean = 0.5 * (*low + *high);
  draw_shaft(drawn, study.bearings, [&](double place) { return motion_path(study.parameters, run, first, place); });
  drawn.speed = (run.psi.back() - run.psi[first]) / duration;
  drawn.one_start = true;
}

void draw_motion(const Attractor& a, const Study& study, DrawnMotion& drawn) {
  const Motion& m = a.motion;
  drawn.r_min = m.r_min;
  drawn.r_mean = m.r_mean;
  drawn.r_max = m.r_max;
  drawn.speed = m.speed;
  drawn.continuum = a.continuum.has_value() || m.set_valued;
  draw_path(system_of(study.parameters, m), m, study.bearings, drawn);
}

class PageMaker {
 public:
  PageMaker(const Study& study, GivenMachine given, const BasinOptions& options) : options_(options) {
    static_cast<GivenMachine&>(page_) = std::move(given);
    BasinOptions run = options;
    run.keep_starts = true;
    const bool grid = study.sampling.method == SamplingMethod::grid;  // a grid's first starts are not a fair sample
    if (!grid) run.keep_at_most = most_starts_drawn;
    run.transients = true;
    page_.basin = basin(study, run, &catalogue_);
    starts_ = std::move(*page_.basin.every_start);
    page_.basin.every_start.reset();
    page_.starts_drawn = starts_.starts;
  }

  MachinePage make() {
    name_outcomes();
    if (starts_.starts == 0) {
      if (alone()) runs({});
      return page_;
    }
    distributions();
    tell("drawing the motions");
    motions();
    runs(median_and_worst(starts_));
    return page_;
  }

 private:
  // Whether there are no balls, and one run is enough.
  bool alone() const {
    return page_.basin.study.parameters.balls == 0 && page_.basin.without_balls && page_.basin.without_balls->bare.one;
  }

  void runs(const std::vector<std::uint64_t>& indices) {
    tell("following the rotor without balls, the typical run and the worst in a hundred");
    page_.runs = shown_runs(page_.basin.study, starts_, indices, options_.stop);
    for (ShownRun& run : page_.runs) {
      if (run.of != RunOf::bare)
        run.outcome = outcomes_[run.code];
      else if (const auto& without = page_.basin.without_balls; without && without->bare.one && without->bare.runs > 0)
        run.peak = without->bare.figures.figure(&TransientRow::peak_radial).largest;
    }
  }

  void tell(const char* what) const {
    if (options_.progress) options_.progress({0, 0, std::string("report: ") + what, {}, true});
  }

  void name_outcomes() {
    for (const OutcomeShare& a : page_.basin.attractors) add_outcome(a);
    for (const OutcomeShare& o : page_.basin.others())
      if (o.id == stalled_code || o.id == undecided_code) add_outcome(o);
  }
  void add_outcome(const OutcomeShare& o) {
    outcomes_[o.id] = o;
    listed_.push_back(o.id);
  }

  void motions() {
    std::vector<DrawnMotion>& drawn = page_.motions;
    for (const OutcomeShare& o : page_.basin.outcomes_met())
      if (o.share.count > 0 && (o.id > 0 || o.id == stalled_code)) drawn.push_back({o, {}, {}, {}});
    std::stable_sort(drawn.begin(), drawn.end(),
                     [](const DrawnMotion& a, const DrawnMotion& b) { return a.share.share > b.share.share; });
    if (drawn.size() > most_motions_drawn) {
      page_.motions_left_out = drawn.size() - most_motions_drawn;
      drawn.resize(most_motions_drawn);
    }
    for (DrawnMotion& one : drawn) draw(one);
  }

  void draw(DrawnMotion& one) {
    const Attractor* a = one.id > 0 ? catalogue_.find(one.id) : nullptr;
    // With uncertain values, each start's motion belongs to its own rotor.
    const bool common = page_.basin.study.uncertain.empty();
    if (a && common && a->motion.kind != MotionKind::measured && a->motion.state.size() > 0)
      return draw_motion(*a, page_.basin.study, one);
    const auto found = std::find(starts_.outcome.begin(), starts_.outcome.end(), static_cast<short>(one.id));
    if (found == starts_.outcome.end()) return;
    draw_end(page_.basin.study, starts_, static_cast<std::uint64_t>(found - starts_.outcome.begin()), options_.stop,
             one);
  }

  void distributions() {
    const Limits& limits = page_.basin.study.limits;
    // The peak displacement always, with the one limit that is shown of it.
    const auto of_peak = limits.clearance && !limits.displacement ? &Limits::clearance : &Limits::displacement;
    for (const TransientLimit& l : transient_limits)
      if (l.value == &TransientRow::peak_radial ? l.limit == of_peak : !l.by_speed && limits.*l.limit)
        add_distribution(l);
  }

  void add_distribution(const TransientLimit& l) {
    constexpr std::size_t bins = 36;
    const std::vector<float>* values = &starts_.transients[figure_place(l.value)];
    const std::optional<double>& limit = page_.basin.study.limits.*l.limit;
    FigureDistribution d;
    d.limited = &l;
    bool some = false;
    for (const float v : *values) {
      if (!std::isfinite(v)) continue;
      d.low = some ? std::min<double>(d.low, v) : v;
      d.high = some ? std::max<double>(d.high, v) : v;
      some = true;
    }
    if (!some) return;
    constexpr double near_enough = 2.5;  // to be shown together with the limit
    if (limit && *limit < near_enough * d.high) d.high = std::max(d.high, 1.05 * *limit);
    if (limit && *limit > 0.4 * d.low) d.low = std::min(d.low, 0.95 * *limit);
    if (d.high - d.low < 1e-3 * d.high) d.low = 0.0;  // all alike
    if (d.low < 0.3 * d.high) d.low = 0.0;
    if (!(d.high > 0.0)) d.high = limit.value_or(1e-6);
    std::map<int, std::vector<double>> counts;
    double all = 0.0;
    for (std::size_t i = 0; i < values->size(); ++i) {
      const double weight = starts_.weight.empty() ? 1.0 : starts_.weight[i];
      all += weight;
      if (!std::isfinite((*values)[i])) continue;
      const double place = ((*values)[i] - d.low) / (d.high - d.low) * static_cast<double>(bins);
      auto& of = counts[starts_.outcome[i]];
      of.resize(bins);
      of[std::min(bins - 1, static_cast<std::size_t>(std::max(place, 0.0)))] += weight;
    }
    for (const int code : listed_)
      if (auto& of = counts[code]; !of.empty()) {
        for (double& share : of) share /= all;
        d.outcomes.push_back({code, outcomes_[code].name, std::move(of)});
      }
    page_.peaks.push_back(std::move(d));
  }

  const BasinOptions& options_;
  MachinePage page_;
  Catalogue catalogue_;
  StartArrays starts_;
  std::map<int, OutcomeShare> outcomes_;
  std::vector<int> listed_;
};

}  // namespace

MachinePage machine_page(const Study& study, GivenMachine given, const BasinOptions& options) {
  return PageMaker(study, std::move(given), options).make();
}

}  // namespace equipoise
