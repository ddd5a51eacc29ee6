// One sentence about many cells: the best, the worst, what is unknown.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {

constexpr char no_cell_done[] = "Nothing is known: no cell is done.";
constexpr char every_limit_kept[] = "every limit is kept";
constexpr char rotor_balanced[] = "the rotor ends balanced";
constexpr char up_to[] = "Up to {} {}, {} {}: {}";

template <class Result>
std::vector<std::size_t> done_cells(const Result& r) {
  std::vector<std::size_t> cells;
  visit_done(r.cells, [&](std::size_t index, const auto&) { cells.push_back(index); });
  return cells;
}

// What cells are compared by: starts that meet every limit if all cells report it, otherwise those that end balanced.
struct CellShares {
  explicit CellShares(const SweepResult& r)
      : limits(std::all_of(r.cells.begin(), r.cells.end(), [](const auto& c) { return !c || kept_share(*c); })),
        result(r) {}
  const Share& operator()(std::size_t cell) const {
    return limits ? *kept_share(*result.cells[cell]) : result.cells[cell]->outcomes.front().share;
  }
  bool limits;
  const SweepResult& result;
};

// "final speed 2.4 ω_c, ball drag 0.05".
std::string cell_words(const std::vector<SweepAxis>& axes, std::size_t cell) {
  std::string words;
  visit_parameters(axes, cell, [&](const SweepParameter& p, std::size_t k) {
    words += (words.empty() ? "" : ", ") + key_words(p.key) + " " + value_words(p.key, p.given[k]);
  });
  return words;
}

// "at final speed 2.4 ω_c", "in 3 of 12 cells, such as final speed 2.4 ω_c": cells with the same share.
std::string where(const CellShares& shares, const std::vector<std::size_t>& cells, std::size_t one) {
  const auto alike = std::count_if(cells.begin(), cells.end(),
                                   [&](std::size_t cell) { return shares(cell).share == shares(one).share; });
  const std::string title = cell_words(shares.result.axes, one);
  return alike == 1 ? "at " + title : fmt::format("in {} of {} cells, such as {}", alike, cells.size(), title);
}

std::string shares_over(const SweepResult& r, const std::vector<std::size_t>& cells) {
  const CellShares shares(r);
  const auto less = [&](std::size_t a, std::size_t b) { return shares(a).share < shares(b).share; };
  const std::size_t worst = *std::min_element(cells.begin(), cells.end(), less);
  const std::size_t best = *std::max_element(cells.begin(), cells.end(), less);
  const std::string most = share_words(shares(best)), least = share_words(shares(worst));
  if (cells.size() == 1)
    return fmt::format("At {} {} in {} of starts (95 % confidence)", cell_words(r.axes, best),
                       shares.limits ? every_limit_kept : rotor_balanced, most);
  if (!less(worst, best))
    return fmt::format("In each of {} cells {} in {} of starts (95 % confidence)", cells.size(),
                       shares.limits ? every_limit_kept : rotor_balanced, most);
  return fmt::format("{} most often {}: in {} of starts; least often {}: in {} (95 % confidence in each cell)",
                     shares.limits ? "Every limit is kept" : "The rotor ends balanced", where(shares, cells, best),
                     most, where(shares, cells, worst), least);
}

// How often a limit is exceeded, from the best cell to the worst.
std::string limits_over(const SweepResult& r, const std::vector<std::size_t>& cells) {
  std::string text;
  for (const ToldLimit& limit : told_limits(r.study)) {
    double least = 1.0, most = 0.0;
    for (const std::size_t cell : cells) {
      const auto& transients = r.cells[cell]->transients;
      if (!transients || !transients->exceeded[limit.place]) return text;
      least = std::min(least, transients->exceeded[limit.place]->share);
      most = std::max(most, transients->exceeded[limit.place]->share);
    }
    const std::string share = least < most ? fmt::format("{:.3g} to {:.3g} %", 100.0 * least, 100.0 * most)
                                           : fmt::format("{:.3g} %", 100.0 * most);
    text += fmt::format("; {} in {}", limit.words, share);
  }
  return text;
}

// "213.2 g mm".
std::string sought_value(const CapacityResult& r, double value) {
  return value_words(r.key, fmt::format("{:.4g}{}{}", value, r.unit.empty() ? "" : " ", r.unit));
}

// "shown up to 201, shown to be fewer from 220 on".
std::string shown_words(const std::optional<double>& low, const std::optional<double>& high) {
  if (!low && !high) return "likely, but not shown";
  std::string words = low ? fmt::format("shown up to {:.4g}", *low) : "";
  if (high) words += (low ? ", " : "") + fmt::format("shown to be fewer from {:.4g} on", *high);
  return words;
}

// "213 g mm (between 201 and 220)".
std::string capacity_words(const CapacityResult& r, const CapacityCell& cell) {
  const auto low = cell.shown_low(r.at_least), high = cell.shown_high(r.at_least);
  const auto likely = [](bool shown) { return shown ? "" : "likely "; };
  if (cell.never) return likely(high == r.from) + ("less than " + sought_value(r, r.from));
  if (cell.always) return likely(low == r.to) + ("more than " + sought_value(r, r.to));
  if (low && high) return fmt::format("{} (between {:.4g} and {:.4g})", sought_value(r, *cell.value), *low, *high);
  return fmt::format("{} ({})", sought_value(r, *cell.value), shown_words(low, high));
}

// Also orders capacities beyond the range.
double rank(const CapacityResult& r, const CapacityCell& cell) {
  const double outside = r.to - r.from;
  return cell.never ? r.from - outside : cell.always ? r.to + outside : *cell.value;
}

// One of the four sentences, with what is shown of it.
std::string capacity_sentence(const CapacityResult& r, const char* sentence, double value, const std::string& starts,
                              const std::optional<double>& low, const std::optional<double>& high) {
  return fmt::format(fmt::runtime(sentence), key_words(r.key), sought_value(r, value), starts, r.asked(),
                     shown_words(low, high) + (low || high ? " (95 % confidence)" : ""));
}

std::string lone_capacity(const CapacityResult& r, const CapacityCell& cell, const std::string& starts) {
  const auto low = cell.shown_low(r.at_least), high = cell.shown_high(r.at_least);
  if (cell.never)
    return capacity_sentence(r, "At {} {}, where the range begins, fewer than {} {}: {}", r.from, starts, low, high);
  if (cell.always) return capacity_sentence(r, "Up to {} {}, the end of the range, {} {}: {}", r.to, starts, low, high);
  return capacity_sentence(r, up_to, *cell.value, starts, low, high);
}

// Before any cell is finished.
std::string open_capacity(const CapacityResult& r, const std::vector<std::string>& keys, const std::string& starts) {
  const auto known = std::find_if(r.open.begin(), r.open.end(), [](const auto& o) { return o && (o->low || o->high); });
  const std::uint64_t trials = r.trials + r.resumed_trials;
  if (known == r.open.end() && trials == 0) return no_cell_done;
  if (known == r.open.end())
    return fmt::format("Nothing is known yet: {} value{} tried, none with 95 % confidence.", trials, plural(trials));
  if (!r.axes.empty()) return "No cell is finished; the table shows what is known of each.";
  const OpenCapacity& open = **known;
  const std::string text =
      open.low ? capacity_sentence(r, up_to, *open.low, starts, open.low, open.high)
               : capacity_sentence(r, "From {} {} on, fewer than {} {}: {}", *open.high, starts, open.low, open.high);
  return after_what_is_drawn(keys, text + "; stopped before the largest was found.");
}

}  // namespace

const Share* kept_share(const SweepCell& cell) {
  return cell.transients && cell.transients->kept() ? &*cell.transients->kept() : nullptr;
}

std::string answer_sentence(const SweepResult& r) {
  const std::vector<std::size_t> cells = done_cells(r);
  if (cells.empty()) return no_cell_done;
  const std::vector<std::string> keys = drawn_keys(r.study, keys_of(r.axes));
  std::string text = shares_over(r, cells) + limits_over(r, cells);
  const auto open = std::max_element(cells.begin(), cells.end(), [&](std::size_t a, std::size_t b) {
    return r.cells[a]->undecided.share < r.cells[b]->undecided.share;
  });
  if (const Share& undecided = r.cells[*open]->undecided; undecided.count > 0)
    text += fmt::format("; up to {} stay undecided, at {}", percent(undecided.share, digits_for(undecided)),
                        cell_words(r.axes, *open));
  return after_what_is_drawn(keys, text + ".");
}

std::string answer_sentence(const CapacityResult& r) {
  const std::vector<std::size_t> cells = done_cells(r);
  std::vector<std::string> set = keys_of(r.axes);
  set.push_back(r.key);
  const std::vector<std::string> keys = drawn_keys(r.study, set);
  const std::string starts = fmt::format("{:.4g} % of starts", 100.0 * r.at_least);
  if (cells.empty()) return open_capacity(r, keys, starts);
  const auto title = [&](std::size_t cell) { return cell_words(r.axes, cell); };
  if (cells.size() == 1) {
    std::string text = lone_capacity(r, *r.cells[cells.front()], starts);
    if (!r.axes.empty()) text += ", at " + title(cells.front());
    return after_what_is_drawn(keys, text + ".");
  }
  const auto less = [&](std::size_t a, std::size_t b) { return rank(r, *r.cells[a]) < rank(r, *r.cells[b]); };
  const auto [worst, best] = std::minmax_element(cells.begin(), cells.end(), less);
  if (!less(*worst, *best))
    return after_what_is_drawn(
        keys, fmt::format("The largest {} at which {} {} is {} in each of {} cells (95 % confidence).",
                          key_words(r.key), starts, r.asked(), capacity_words(r, *r.cells[*best]), cells.size()));
  return after_what_is_drawn(
      keys, fmt::format("The largest {} at which {} {} is {} at {}; it is least at {}: {} (95 % confidence).",
                        key_words(r.key), starts, r.asked(), capacity_words(r, *r.cells[*best]), title(*best),
                        title(*worst), capacity_words(r, *r.cells[*worst])));
}

std::string answer_sentence(const BasinSlice& map) {
  const auto with = [&](short code) {
    return std::find_if(map.codes.begin(), map.codes.end(), [&](const OutcomeShare& c) { return c.id == code; });
  };
  const auto of_all =
      std::find_if(map.codes.begin(), map.codes.end(), [](const OutcomeShare& c) { return c.share.total > 0; });
  if (of_all == map.codes.end()) return "Nothing is known: stopped before any pixel was done.";
  const std::uint64_t points = of_all->share.total;
  const std::string plane = fmt::format("{} points over {} and {}", points, key_words(map.x.key), key_words(map.y.key));
  const auto balanced = with(balanced_id);
  std::string text = fmt::format("Not one of {} ends balanced", plane);
  if (balanced != map.codes.end() && balanced->share.count > 0) {
    const bool plain = balanced->name == "balanced";  // otherwise held by friction
    const std::string name = plain ? balanced->name : "\"" + balanced->name + "\"";
    // Pixels come in an order that is not random.
    text = map.complete ? fmt::format("Of {}, {} end {} (95 % confidence, as of random ones)", plane,
                                      share_words(balanced->share), name)
                        : fmt::format("Among the first {}, {} end {}; they are not a sample of the map", plane,
                                      share_text(balanced->share), name);
  }
  if (map.figures.balanced_radius && *map.figures.balanced_radius > 0.0)
    text += fmt::format("; all within {:.3g} rad of balanced angles do", *map.figures.balanced_radius);
  if (const auto open = with(undecided_code); open != map.codes.end() && open->share.count > 0)
    text += fmt::format("; {} stay undecided", percent(open->share.share, digits_for(open->share)));
  return text + ".";
}

}  // namespace equipoise
