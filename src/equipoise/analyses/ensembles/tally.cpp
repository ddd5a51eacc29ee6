// Counts outcomes, and decides how to sample and when sampling may end.
#include "equipoise/analyses/ensembles/tally.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/start_runs/undecided.hpp"
#include "equipoise/core/statistics/even_share.hpp"

namespace equipoise {

namespace {
// Fewest starts before sampling may end: with fewer, a rare outcome's interval may be narrow by luck.
constexpr std::uint64_t fewest_starts = 4096;
// Random starts are checked each time this many more are counted.
constexpr std::uint64_t checkpoint = 1024;

// True for 4, 5, 6 or 7 times a power of two points in a replicate. Powers of two are best: their points form a net,
// with one point in every elementary interval. Between them the points consist of whole nets of at least a quarter of
// that size. Doubling alone would take 44 % more starts than needed on average; quarters take 12 % more. Every check is
// one more chance to stop on a luckily narrow interval, so there are only four an octave.
bool ends_a_net(std::uint64_t points) {
  const int quarter = std::bit_width(points) - 3;
  return quarter >= 0 && (points >> quarter << quarter) == points;
}
}  // namespace

Tally::Tally(const Sampler& sampler, std::uint64_t seed, double settled)
    : sampler_(sampler), seed_(seed), settled_(settled) {}

Tally::Key Tally::key_of(OutcomeKind kind, int attractor) {
  return {static_cast<int>(kind), kind == OutcomeKind::attracted ? attractor : 0};
}

void Tally::add(const Outcome& outcome) {
  const Key key = key_of(outcome.kind, outcome.attractor);
  Line& line = lines_[key];
  ++line.count;
  const double weight = sampler_.weight(seed_, total_);
  line.time += weight * (outcome.time - settled_);
  line.counted += weight;
  if (const double later = outcome.time - settled_ - lasting_chaos; later > 0.0) {
    ++line.late;
    line.late_time += later;
  }
  if (!std::isnan(outcome.unbalance)) line.unbalance[outcome.unbalance] += weight;
  ++line.by[static_cast<std::size_t>(outcome.by)];
  if (sampler_.method() == SamplingMethod::sobol) ++line.in_replicate[total_ % sobol_replicates];
  if (sampler_.grid()) add_to_pair(key, line, weight);
  ++total_;
}

void Tally::add_to_pair(Key key, Line& line, double w) {
  weight_ += w;
  weight_squared_ += w * w;
  if (total_ % 2 == 1 && key != before_)
    for (const Key& half : {key, before_}) {
      Line& one = half == key ? line : lines_[before_];
      const Key other = half == key ? before_ : key;
      one.split.add(w);
      if (other == key_of(OutcomeKind::undecided, 0)) one.from_undecided.add(w);
    }
  before_ = key;
}

Share Tally::interval(const Line& line) const {
  switch (sampler_.method()) {
    case SamplingMethod::sobol: {
      std::array<std::uint64_t, sobol_replicates> totals;
      for (std::size_t r = 0; r < totals.size(); ++r)
        totals[r] = (total_ + sobol_replicates - 1 - r) / sobol_replicates;
      return replicated_share(line.in_replicate, totals);
    }
    case SamplingMethod::grid:
      return stratified_share(
          {line.count, total_, line.counted, weight_, weight_squared_, line.split.count, line.split.squared},
          total_ == sampler_.grid()->starts());
    default:
      return wilson_share(line.count, total_);
  }
}

// Both lines as one outcome, for share(). A pair split between the two is no longer split.
Tally::Line Tally::united(const Line& line, const Line& undecided) {
  Line both = line;
  both.count += undecided.count;
  both.counted += undecided.counted;
  for (std::size_t r = 0; r < both.in_replicate.size(); ++r) both.in_replicate[r] += undecided.in_replicate[r];
  both.split.count += undecided.split.count - 2 * line.from_undecided.count;
  both.split.squared += undecided.split.squared - 2.0 * line.from_undecided.squared;
  return both;
}

Share Tally::share(Key key) const {
  const Key open = key_of(OutcomeKind::undecided, 0);
  const auto at = lines_.find(key), undecided = lines_.find(open);
  const Line line = at == lines_.end() ? Line{} : at->second;
  const Share result = interval(line);
  if (key == open || undecided == lines_.end()) return result;
  return share_between(result, interval(united(line, undecided->second)));
}

Share Tally::share(OutcomeKind kind, int attractor) const { return share(key_of(kind, attractor)); }

namespace {
// The values below which the fractions unbalance_quantiles of all weight lie.
std::vector<double> quantiles_of(const std::map<float, double>& weights) {
  double total = 0.0;
  for (const auto& [value, weight] : weights) total += weight;
  std::vector<double> result;
  double below = 0.0;
  for (const auto& [value, weight] : weights) {
    below += weight;
    while (result.size() < unbalance_quantiles.size() &&
           below >= unbalance_quantiles[result.size()] * total * (1.0 - 1e-12))
      result.push_back(value);
  }
  return result;
}
}  // namespace

OutcomeShare Tally::share(const Attractor& a) const {
  OutcomeShare result{a.id, a.name, a.alias, share(OutcomeKind::attracted, a.id), name_of(a.motion.kind)};
  if (const auto at = lines_.find(key_of(OutcomeKind::attracted, a.id)); at != lines_.end()) {
    result.mean_time = at->second.time / at->second.counted;
    result.decided_by = at->second.by;
    result.unbalance = quantiles_of(at->second.unbalance);
  }
  return result;
}

void Tally::count(const Catalogue& catalogue, BasinResult& result) const {
  const bool driven = result.study.speed.driven();
  const double stall_speed = driven ? result.study.stall_speed() : 0.0;
  result.attractors.clear();
  if (!catalogue.find(balanced_id)) result.attractors.push_back(share(Attractor{balanced_id, "balanced", "", {}, {}}));
  for (const Attractor& a : catalogue.attractors()) {
    // Starts whose rotor does not come up to speed count as stalled instead.
    const bool measured = a.motion.kind == MotionKind::measured;
    if (a.id != balanced_id && std::fabs(a.motion.speed) < stall_speed && !measured) continue;
    OutcomeShare one = share(a);
    // A measured kind of motion is reported only if a start ended in it.
    if (one.share.count > 0 || a.id == balanced_id || !measured) result.attractors.push_back(std::move(one));
  }
  result.undecided = share(OutcomeKind::undecided);
  result.diverged = share(OutcomeKind::diverged);
  result.failed = share(OutcomeKind::failed);
  if (driven) result.stalled = share(OutcomeKind::stalled);
}

std::optional<EscapeRate> Tally::chaos(const Catalogue& catalogue) const {
  bool lasts = false;
  std::uint64_t escapes = 0, late = 0;
  double watched = 0.0;
  for (const auto& [key, line] : lines_) {
    if (key.first != static_cast<int>(OutcomeKind::attracted)) continue;
    const Attractor* a = catalogue.find(key.second);
    const bool still = a && (a->name == long_lived_chaos || a->motion.kind == MotionKind::chaotic);
    lasts = lasts || (still && a->name == long_lived_chaos);
    if (!still) escapes += line.late;
    late += line.late;
    watched += line.late_time;
  }
  if (!lasts) return std::nullopt;
  EscapeRate result = escape_rate(escapes, late, watched);
  result.watched_from = lasting_chaos;
  return result;
}

std::vector<Share> Tally::shares() const {
  std::vector<Share> all;
  for (const auto& [key, line] : lines_) all.push_back(interval(line));
  all.push_back(interval(Line{}));
  return all;
}

bool Tally::at_checkpoint() const {
  if (total_ < fewest_starts) return false;
  if (sampler_.method() == SamplingMethod::sobol)
    return total_ % sobol_replicates == 0 && ends_a_net(total_ / sobol_replicates);
  return total_ % checkpoint == 0;
}

bool Tally::narrow(double half_width) const {
  const std::vector<Share> all = shares();
  return std::all_of(all.begin(), all.end(), [&](const Share& s) { return s.half_width() <= half_width; });
}

namespace {
// 97.5 % quantile of the normal distribution.
constexpr double z = 1.959963984540054;

// Wilson's half-width is z sqrt(p q n + z^2/4) / (n + z^2); solved for n with b = z^2 / h^2.
double wilson_starts(double p, double h) {
  const double pq = p * (1.0 - p), b = z * z / (h * h), linear = 0.5 * b * pq - z * z;
  return std::max(linear + std::sqrt(std::max(linear * linear + z * z * (0.25 * b - z * z), 0.0)), 0.0);
}
}  // namespace

double most_random_starts(double half_width) { return wilson_starts(0.5, half_width); }

double random_starts_for(const std::vector<Share>& shares, double half_width) {
  double most = 0.0;
  for (const Share& s : shares) most = std::max(most, wilson_starts(s.share, half_width));
  return most;
}

SamplingChoice choose_sampling(const std::vector<Share>& pilot, double half_width) {
  SamplingChoice choice;
  choice.random_starts = random_starts_for(pilot, half_width);
  for (const Share& s : pilot) {
    const double ratio = s.half_width() / half_width;
    const double needed =
        s.by == IntervalBy::wilson ? wilson_starts(s.share, half_width) : static_cast<double>(s.total) * ratio * ratio;
    choice.sobol_starts = std::max(choice.sobol_starts, needed);
  }
  choice.pilot = pilot.front().total;
  choice.method = choice.sobol_starts - static_cast<double>(choice.pilot) < choice.random_starts
                      ? SamplingMethod::sobol
                      : SamplingMethod::random;
  return choice;
}

}  // namespace equipoise
