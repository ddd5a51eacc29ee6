// Words and tables around a sweep's drawings.
#include "equipoise/report/html/sweep_html.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/plural.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/html/cell_table.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/answers/quantities.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/text/cell_text.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

class SweepDocument {
 public:
  SweepDocument(const SweepResult& result, const GivenMachine& machine) : r_(result), machine_(machine) {
    for (const auto& cell : r_.cells) {
      if (!cell) continue;
      ++done_;
      starts_ += cell->starts;
      least_starts_ = std::min(least_starts_, cell->starts);
      most_starts_ = std::max(most_starts_, cell->starts);
      open_ = open_ || cell->undecided.count > 0;
      stalls_ = stalls_ || (cell->stalled && cell->stalled->count > 0);
      lost_ += cell->lost();
    }
  }

  Document make() {
    document_ = page_with(r_.study, answer_sentence(r_));
    add_missing_cells(document_, done_, r_.cells.size());
    if (lost_ > 0) add(Paragraph{fmt::format("{} starts could not be followed to an end.", lost_), Tone::open});
    notes();
    if (done_ > 0) {
      pictures();
      table();
    }
    add_machine(document_, machine_, "in the study, before anything is varied");
    origin();
    return std::move(document_);
  }

 private:
  void add(Block block) { document_.blocks.push_back(std::move(block)); }

  // A note shared by many cells appears once.
  void notes() {
    std::vector<std::pair<std::string, std::size_t>> told;
    for (const auto& cell : r_.cells) {
      if (!cell || cell->note.empty()) continue;
      const auto at = std::find_if(told.begin(), told.end(), [&](const auto& one) { return one.first == cell->note; });
      if (at == told.end())
        told.emplace_back(cell->note, 1);
      else
        ++at->second;
    }
    constexpr std::size_t most = 4;
    for (std::size_t k = 0; k < told.size() && k < most; ++k)
      add(Paragraph{fmt::format("Note of {} cell{}: {}.", told[k].second, plural(told[k].second), told[k].first),
                    Tone::open});
    if (told.size() > most) add(Paragraph{fmt::format("{} more notes of single cells.", told.size() - most)});
  }

  void pictures() {
    add(Heading{2, "Where starts end", ""});
    add(sweep_drawing(r_));
    if (const auto peaks = peak_plot(r_)) {
      DrawingRow below;
      below.wide = true;
      below.drawings.push_back({"Peak displacement on the way", plot_svg(*peaks, "Peaks along the parameter"), "", ""});
      below.caption = "With 95 % intervals.";
      add(std::move(below));
    }
  }

  void table() {
    DocumentTable table;
    table.header = parameter_titles(r_.axes, key_words);
    table.header.insert(table.header.end(), {"balanced", "95 % interval"});
    if (open_) {
      table.spare.push_back(table.header.size());
      table.header.push_back("bounds");
    }
    table.header.push_back("undecided");
    if (stalls_) table.header.push_back("stalled");
    const PageQuantities shown(r_.study);
    for (const TransientLimit& l : transient_limits)
      if (shows(l)) table.header.push_back("above " + shown.text(*(r_.study.limits.*l.limit), l.told_in()));
    table.spare.push_back(table.header.size());
    table.header.push_back("starts");
    if (open_)
      table.caption = "Intervals hold only if the undecided starts end elsewhere; bounds hold however they end.";
    for (std::size_t k = 0; k < r_.cells.size(); ++k)
      if (r_.cells[k]) table.rows.push_back(row_of(k));
    add_cell_table(document_, std::move(table), "the CSV file holds all of them");
  }

  // Only limits on what happens on the way.
  bool shows(const TransientLimit& l) const { return r_.transients && !l.at_end && r_.study.limits.*l.limit; }

  std::vector<DocumentCell> row_of(std::size_t index) const {
    const SweepCell& cell = *r_.cells[index];
    const Share& balanced = cell.outcomes.front().share;
    std::vector<DocumentCell> row = parameter_values(r_.axes, index);
    row.push_back(share_cell(balanced));
    row.push_back(number_cell(interval(balanced)));
    if (open_) row.push_back(number_cell(bounds_text(balanced)));
    row.push_back(share_cell(cell.undecided));
    if (stalls_) row.push_back(cell.stalled ? share_cell(*cell.stalled) : number_cell("-"));
    for (std::size_t k = 0; k < transient_limits.size(); ++k)
      if (shows(transient_limits[k])) {
        const auto& exceeded = cell.transients->exceeded[k];
        row.push_back(exceeded ? share_cell(*exceeded) : number_cell("-"));
      }
    row.push_back(number_cell(fmt::format("{}", cell.starts)));
    return row;
  }

  void origin() {
    add(Heading{2, "How it was computed", ""});
    const std::string each = least_starts_ == most_starts_
                                 ? fmt::format("{} starts", most_starts_)
                                 : fmt::format("{} to {} starts", least_starts_, most_starts_);
    std::string text = fmt::format("Varied: {}. ", varied_words(r_.axes));
    if (done_ > 0)
      text += fmt::format(
          "{} cells with {} each ({} in all) {}, the same in every cell, each followed until it is known where it "
          "ends.",
          done_, each, starts_, starts_words(r_.study, drawn_keys(r_.study, keys_of(r_.axes))));
    if (r_.half_width > 0.0)
      text += fmt::format(" Sampled until every share was known to +- {:.3g} %.", 100.0 * r_.half_width);
    text += model_words(r_.study, {r_.cpu_target, r_.threads, r_.seconds, r_.cpu_seconds});
    if (r_.resumed_cells > 0) text += fmt::format("; {} cells from an earlier run's file", r_.resumed_cells);
    add(Paragraph{text + "."});
    add_study(document_, r_.study);
  }

  const SweepResult& r_;
  const GivenMachine& machine_;
  std::size_t done_ = 0;
  std::uint64_t starts_ = 0, least_starts_ = ~std::uint64_t{0}, most_starts_ = 0, lost_ = 0;
  bool open_ = false, stalls_ = false;
  Document document_;
};

}  // namespace

std::string sweep_html(const SweepResult& result, const GivenMachine& machine) {
  return document_html(SweepDocument(result, machine).make());
}

}  // namespace equipoise
