// One sentence about many cells: the best, the worst, what is unknown.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/answers/quantities.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/words/answers.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise {

namespace {

template <class Result>
std::vector<std::size_t> done_cells(const Result& r) {
  std::vector<std::size_t> cells;
  visit_done(r.cells, [&](std::size_t index, const auto&) { cells.push_back(index); });
  return cells;
}

// What cells are compared by: starts that keep every limit where all of them tell it, else those that end balanced.
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
  return alike == 1 ? words::answers::at + title : fmt::format(words::answers::in_cells, alike, cells.size(), title);
}

std::string shares_over(const SweepResult& r, const std::vector<std::size_t>& cells) {
  const CellShares shares(r);
  const auto less = [&](std::size_t a, std::size_t b) { return shares(a).share < shares(b).share; };
  const std::size_t worst = *std::min_element(cells.begin(), cells.end(), less);
  const std::size_t best = *std::max_element(cells.begin(), cells.end(), less);
  const std::string most = share_words(shares(best)), least = share_words(shares(worst));
  if (cells.size() == 1)
    return fmt::format(words::answers::one_cell, cell_words(r.axes, best),
                       shares.limits ? words::answers::every_limit_kept : words::answers::rotor_balanced, most);
  if (!less(worst, best))
    return fmt::format(words::answers::cells_alike, cells.size(),
                       shares.limits ? words::answers::every_limit_kept : words::answers::rotor_balanced, most);
  return fmt::format(words::answers::most_and_least_often,
                     shares.limits ? words::answers::every_limit_kept_first : words::answers::rotor_balanced_first,
                     where(shares, cells, best), most, where(shares, cells, worst), least);
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
    const std::string share = least < most ? fmt::format(words::answers::from_to, 100.0 * least, 100.0 * most)
                                           : fmt::format("{:.3g} %", 100.0 * most);
    text += fmt::format(words::answers::limit_in, limit.words, share);
  }
  return text;
}

// "213.2 g mm".
std::string sought_value(const CapacityResult& r, double value) {
  return value_words(r.key, fmt::format("{:.4g}{}{}", value, r.unit.empty() ? "" : " ", r.unit));
}

// "shown up to 201, shown to be fewer from 220 on".
std::string shown_words(const std::optional<double>& low, const std::optional<double>& high) {
  if (!low && !high) return words::answers::not_shown;
  std::string words = low ? fmt::format(words::answers::shown_up_to, *low) : "";
  if (high) words += (low ? ", " : "") + fmt::format(words::answers::fewer_from, *high);
  return words;
}

// "213 g mm (between 201 and 220)".
std::string capacity_words(const CapacityResult& r, const CapacityCell& cell) {
  const auto low = cell.shown_low(r.at_least), high = cell.shown_high(r.at_least);
  const auto likely = [](bool shown) { return shown ? "" : words::answers::likely; };
  if (cell.never) return likely(high == r.from) + (words::answers::less_than + sought_value(r, r.from));
  if (cell.always) return likely(low == r.to) + (words::answers::more_than + sought_value(r, r.to));
  if (low && high) return fmt::format(words::answers::surely_between, sought_value(r, *cell.value), *low, *high);
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
                     shown_words(low, high) + (low || high ? words::answers::confidence : ""));
}

std::string lone_capacity(const CapacityResult& r, const CapacityCell& cell, const std::string& starts) {
  const auto low = cell.shown_low(r.at_least), high = cell.shown_high(r.at_least);
  if (cell.never) return capacity_sentence(r, words::answers::nowhere, r.from, starts, low, high);
  if (cell.always) return capacity_sentence(r, words::answers::up_to_the_end, r.to, starts, low, high);
  return capacity_sentence(r, words::answers::up_to, *cell.value, starts, low, high);
}

// Before any cell is finished.
std::string open_capacity(const CapacityResult& r, const std::vector<std::string>& keys, const std::string& starts) {
  const auto known = std::find_if(r.open.begin(), r.open.end(), [](const auto& o) { return o && (o->low || o->high); });
  if (known == r.open.end()) return words::answers::no_cell_done;
  if (!r.axes.empty()) return words::answers::no_cell_finished;
  const OpenCapacity& open = **known;
  const std::string text =
      open.low ? capacity_sentence(r, words::answers::up_to, *open.low, starts, open.low, open.high)
               : capacity_sentence(r, words::answers::fewer_from_value, *open.high, starts, open.low, open.high);
  return after_what_is_drawn(keys, text + words::answers::stopped_before_found);
}

}  // namespace

const Share* kept_share(const SweepCell& cell) {
  return cell.transients && cell.transients->kept() ? &*cell.transients->kept() : nullptr;
}

std::string answer_sentence(const SweepResult& r) {
  const std::vector<std::size_t> cells = done_cells(r);
  if (cells.empty()) return words::answers::no_cell_done;
  const std::vector<std::string> keys = drawn_keys(r.study, keys_of(r.axes));
  std::string text = shares_over(r, cells) + limits_over(r, cells);
  const auto open = std::max_element(cells.begin(), cells.end(), [&](std::size_t a, std::size_t b) {
    return r.cells[a]->undecided.share < r.cells[b]->undecided.share;
  });
  if (const Share& undecided = r.cells[*open]->undecided; undecided.count > 0)
    text += fmt::format(words::answers::undecided_up_to, percent(undecided.share, digits_for(undecided)),
                        cell_words(r.axes, *open));
  return after_what_is_drawn(keys, text + ".");
}

std::string answer_sentence(const CapacityResult& r) {
  const std::vector<std::size_t> cells = done_cells(r);
  std::vector<std::string> set = keys_of(r.axes);
  set.push_back(r.key);
  const std::vector<std::string> keys = drawn_keys(r.study, set);
  const std::string starts = fmt::format(words::answers::share_of_starts, 100.0 * r.at_least);
  if (cells.empty()) return open_capacity(r, keys, starts);
  const auto title = [&](std::size_t cell) { return cell_words(r.axes, cell); };
  if (cells.size() == 1) {
    std::string text = lone_capacity(r, *r.cells[cells.front()], starts);
    if (!r.axes.empty()) text += words::answers::at_cell + title(cells.front());
    return after_what_is_drawn(keys, text + ".");
  }
  const auto less = [&](std::size_t a, std::size_t b) { return rank(r, *r.cells[a]) < rank(r, *r.cells[b]); };
  const auto [worst, best] = std::minmax_element(cells.begin(), cells.end(), less);
  if (!less(*worst, *best))
    return after_what_is_drawn(keys, fmt::format(words::answers::largest_in_all_cells, key_words(r.key), starts,
                                                 r.asked(), capacity_words(r, *r.cells[*best]), cells.size()));
  return after_what_is_drawn(keys, fmt::format(words::answers::largest_at, key_words(r.key), starts, r.asked(),
                                               capacity_words(r, *r.cells[*best]), title(*best), title(*worst),
                                               capacity_words(r, *r.cells[*worst])));
}

std::string answer_sentence(const BasinSlice& map) {
  const auto with = [&](short code) {
    return std::find_if(map.codes.begin(), map.codes.end(), [&](const OutcomeShare& c) { return c.id == code; });
  };
  const auto of_all =
      std::find_if(map.codes.begin(), map.codes.end(), [](const OutcomeShare& c) { return c.share.total > 0; });
  if (of_all == map.codes.end()) return words::answers::no_pixel_done;
  const std::uint64_t points = of_all->share.total;
  const std::string plane =
      fmt::format(words::answers::points_of_plane, points, key_words(map.x.key), key_words(map.y.key));
  const auto balanced = with(balanced_id);
  std::string text = fmt::format(words::answers::none_of_points, plane);
  if (balanced != map.codes.end() && balanced->share.count > 0) {
    const bool plain = balanced->name == "balanced";  // otherwise held by friction
    text = fmt::format(words::answers::of_points, plane, share_words(balanced->share),
                       plain ? balanced->name : "\"" + balanced->name + "\"");
  }
  if (map.figures.balanced_radius && *map.figures.balanced_radius > 0.0)
    text += fmt::format(words::answers::radius_of_balance, *map.figures.balanced_radius);
  if (const auto open = with(undecided_code); open != map.codes.end() && open->share.count > 0)
    text += fmt::format(words::answers::stay_undecided, percent(open->share.share, digits_for(open->share)));
  return text + ".";
}

}  // namespace equipoise
