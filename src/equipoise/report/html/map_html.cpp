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
#include "equipoise/report/plots/map_drawing.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/words/pages.hpp"
#include "equipoise/report/words/text.hpp"

namespace equipoise {

namespace {

class MapDocument {
 public:
  MapDocument(const BasinSlice& map, const GivenMachine& machine) : map_(map), machine_(machine) {}

  Document make() {
    document_ = page_with(map_.study, answer_sentence(map_));
    if (!map_.complete) add(Paragraph{words::pages::stopped_map, Tone::bad});
    picture();
    outcomes();
    figures();
    add_machine(document_, machine_, words::pages::plays_no_part);
    origin();
    return std::move(document_);
  }

 private:
  void add(Block block) { document_.blocks.push_back(std::move(block)); }

  void picture() {
    add(Heading{2, words::pages::where_starts_end, ""});
    add(map_drawing(map_));
  }

  void outcomes() {
    DocumentTable table{{"outcome", words::pages::of_the_points, "95 % interval", "points"}, {}, "", false, {3}};
    for (const OutcomeShare& c : map_.codes) {
      if (c.share.count == 0 && c.id < undecided_code) continue;
      table.rows.push_back({{reader_title(c, map_.study.scales.has_value())},
                            share_cell(c.share),
                            number_cell(interval(c.share)),
                            number_cell(fmt::format("{}", c.share.count))});
    }
    table.caption = words::pages::points_on_grid;
    add(std::move(table));
  }

  void figures() {
    const SliceFigures& f = map_.figures;
    DocumentTable table{{words::pages::how_basins_lie, "", "95 % interval"}};
    const auto row = [&](const char* name, const std::optional<SliceFigure>& figure) {
      if (figure)
        table.rows.push_back({{name},
                              number_cell(fmt::format("{:.3f}", figure->value)),
                              number_cell(fmt::format("{:.3f} to {:.3f}", figure->low, figure->high))});
    };
    row(words::pages::box_dimension, f.box_dimension);
    row(words::pages::uncertainty_exponent, f.uncertainty_exponent);
    row(words::text::basin_entropy, f.basin_entropy);
    row(words::pages::boundary_entropy, f.boundary_basin_entropy);
    if (!table.rows.empty()) add(std::move(table));
  }

  void origin() {
    add(Heading{2, words::pages::how_computed, ""});
    std::string text =
        fmt::format(words::pages::points_followed, map_.x.pixels * map_.every, map_.y.pixels * map_.every);
    text += model_words(map_.study, {map_.cpu_target, map_.threads, map_.seconds, map_.cpu_seconds});
    if (map_.pixels_kept > 0) text += fmt::format(words::pages::points_from_file, map_.pixels_kept);
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
