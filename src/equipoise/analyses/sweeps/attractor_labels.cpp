// Matches attractors across cells, in the cells' order.
#include "equipoise/analyses/sweeps/attractor_labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include "equipoise/attractors/motions/catalogue.hpp"

namespace equipoise {

namespace {

// Largest difference between two motions that count as the same at neighbouring parameters.
constexpr double farthest = 1.0 / 3.0;

double relative(double a, double b) {
  const double size = std::max(std::fabs(a), std::fabs(b));
  return size > 0.0 ? std::fabs(a - b) / size : 0.0;
}

// Balls may have changed places.
double drift_difference(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double difference = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    difference = std::max(difference, relative(a[i], b[i]));
  return difference;
}

double distance(const SweepOutcome& a, const SweepOutcome& b) {
  if (a.kind != b.kind || without_number(a.name) != without_number(b.name))
    return std::numeric_limits<double>::infinity();
  if (!a.r_max || !b.r_max) return 0.0;  // matched by name alone
  return std::max({relative(*a.r_mean, *b.r_mean), relative(*a.r_max, *b.r_max), drift_difference(a.drift, b.drift)});
}

class Labels {
 public:
  Labels(const std::vector<SweepAxis>& axes, SweepCells& cells) : axes_(axes), cells_(cells) {}

  void label(std::size_t index) {
    SweepCell& cell = *cells_[index];
    std::vector<SweepOutcome*> open;
    std::set<int> used;
    for (SweepOutcome& outcome : cell.outcomes)
      if (outcome.own_id < first_free_id)
        names_.try_emplace(outcome.id = outcome.own_id, outcome.name);
      else
        open.push_back(&outcome);
    match(open, neighbours(index), used);
    for (SweepOutcome* outcome : open) outcome->id = next(outcome->name);
    for (SweepOutcome& outcome : cell.outcomes) outcome.name = names_.at(outcome.id);
  }

 private:
  std::vector<const SweepCell*> neighbours(std::size_t index) const {
    std::vector<const SweepCell*> found;
    const std::vector<std::size_t> place = place_on(axes_, index);
    std::size_t stride = 1;
    for (std::size_t a = axes_.size(); a-- > 0; stride *= axes_[a].size())
      if (place[a] > 0 && cells_[index - stride]) found.push_back(&*cells_[index - stride]);
    return found;
  }

  // The nearest pairs first; whatever finds a partner leaves `open`.
  void match(std::vector<SweepOutcome*>& open, const std::vector<const SweepCell*>& neighbours, std::set<int>& used) {
    for (;;) {
      double least = farthest;
      auto chosen = open.end();
      int id = 0;
      for (auto o = open.begin(); o != open.end(); ++o)
        for (const SweepCell* cell : neighbours)
          for (const SweepOutcome& other : cell->outcomes) {
            if (other.own_id < first_free_id || used.count(other.id)) continue;
            const double off = distance(**o, other);
            if (off >= least) continue;
            least = off;
            chosen = o;
            id = other.id;
          }
      if (chosen == open.end()) return;
      (*chosen)->id = id;
      used.insert(id);
      open.erase(chosen);
    }
  }

  int next(const std::string& name) {
    const int id = std::max(first_free_id, names_.empty() ? 0 : names_.rbegin()->first + 1);
    const std::string plain = without_number(name);
    std::string unique = plain;
    const auto taken = [&](const std::string& text) {
      return std::any_of(names_.begin(), names_.end(), [&](const auto& entry) { return entry.second == text; });
    };
    for (int number = 2; taken(unique); ++number) unique = fmt::format("{} ({})", plain, number);
    names_[id] = unique;
    return id;
  }

  const std::vector<SweepAxis>& axes_;
  SweepCells& cells_;
  std::map<int, std::string> names_;  // by identifier
};

}  // namespace

void label_attractors(const std::vector<SweepAxis>& axes, SweepCells& cells) {
  Labels labels(axes, cells);
  for (std::size_t index = 0; index < cells.size(); ++index)
    if (cells[index]) labels.label(index);
}

}  // namespace equipoise
