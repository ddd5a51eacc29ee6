// Words and tables for a basin slice.
#include "equipoise/report/html/map_html.hpp"

#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/report/decision/plain_names.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

class MapDocument {
 public:
  MapDocument(const BasinSlice& map, const GivenMachine& machine) : map_(map), machine_(machine) {}

  Document make() {
    document_ = page_with(map_.study, answer_sentence(map_));
    if (!map_.complete)
      add(Paragraph{"Stopped before all points were done: white ones are missing, shares are of the others.",
                    Tone::bad});
    picture();
    outcomes();
    figures();
    add_machine(document_, machine_, "in the study; its values of what varies here are not used");
    origin();
    return std::move(document_);
  }

 private:
  void add(Block block) { document_.blocks.push_back(std::move(block)); }

  void picture() {
    add(Heading{2, "Where starts end", ""});
    add(map_drawing(map_));
  }

  void outcomes() {
    DocumentTable table{{"outcome", "of the points", "95 % interval", "points"}, {}, "", false, {3}};
    for (const OutcomeShare& c : map_.codes) {
      if (c.share.count == 0 && c.id < undecided_code) continue;
      table.rows.push_back({{reader_title(c, map_.study.scales.has_value())},
                            share_cell(c.share),
                            number_cell(interval(c.share)),
                            number_cell(fmt::format("{}", c.share.count))});
    }
    table.caption = "Points lie on a grid; the interval is that of as many random ones.";
    add(std::move(table));
  }

  void figures() {
    const SliceFigures& f = map_.figures;
    DocumentTable table{{"how basins lie in each other", "", "95 % interval"}};
    const auto row = [&](const char* name, const std::optional<Estimate>& figure) {
      if (figure)
        table.rows.push_back({{name},
                              number_cell(fmt::format("{:.3f}", figure->value)),
                              number_cell(fmt::format("{:.3f} to {:.3f}", figure->low, figure->high))});
    };
    row("box dimension of the boundary (1: smooth, 2: it fills the plane)", f.box_dimension);
    row("uncertainty exponent (near 0: exact starts help little)", f.uncertainty_exponent);
    row("basin entropy", f.basin_entropy);
    row("boundary basin entropy (above 0.693: fractal)", f.boundary_basin_entropy);
    if (!table.rows.empty()) add(std::move(table));
  }

  void origin() {
    add(Heading{2, "How it was computed", ""});
    std::string text = fmt::format("{} x {} points, a start each, followed until it is known where it ends.",
                                   map_.x.pixels * map_.every, map_.y.pixels * map_.every);
    text += model_words(map_.study, {map_.cpu_target, map_.threads, map_.seconds, map_.cpu_seconds});
    if (map_.pixels_kept > 0) text += fmt::format("; {} points from an earlier run's file", map_.pixels_kept);
    add(Paragraph{text + "."});
    add_study(document_, map_.study);
  }

  const BasinSlice& map_;
  const GivenMachine& machine_;
  Document document_;
};

}  // namespace

std::string map_html(const BasinSlice& map, const GivenMachine& machine) {
  return document_html(MapDocument(map, machine).make());
}

}  // namespace equipoise
