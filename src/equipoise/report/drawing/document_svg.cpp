// The drawings of a document, from the top down: how high each part is follows from how its words break into lines.
#include <algorithm>

#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/drawing/svg.hpp"

namespace equipoise {

namespace {

constexpr double margin = 14.0, between = 16.0, title_size = 14.0, name_size = 12.0, small_size = 10.5;

struct Line {
  SvgPoint at;
  std::string words, colour;
  double size;
};

// Lines and drawings with their places, before the height of all is known.
struct Sheet {
  double width;
  std::vector<Line> lines;
  std::vector<std::pair<SvgPoint, const std::string*>> drawings;

  // Returns the place below.
  double write(SvgPoint at, const std::string& words, double across, double size, const char* colour) {
    for (const std::string& line : text_lines(words, across, size)) {
      at.y += 1.35 * size;
      lines.push_back({at, line, colour, size});
    }
    return at.y;
  }
};

}  // namespace

std::string document_svg(const Document& document, const std::string& title) {
  std::vector<const DrawingRow*> rows;
  std::size_t columns = 1;
  double widest = 0.0;
  for (const Block& block : document.blocks) {
    const auto* row = std::get_if<DrawingRow>(&block);
    if (!row) continue;
    rows.push_back(row);
    if (row->drawings.size() > 1) columns = 2;
    for (const Drawing& d : row->drawings) widest = std::max(widest, size_of(d.svg).x);
  }
  if (widest == 0.0) widest = drawing_width;  // nothing was computed
  const double across = static_cast<double>(columns) * widest + (columns > 1 ? between : 0.0);
  Sheet sheet{across + 2.0 * margin, {}, {}};
  double y = sheet.write({margin, 0.5 * margin}, title, across, title_size, ink);
  std::string details;
  for (const DrawingRow* row : rows) {
    if (row->details != details)
      y = sheet.write({margin, y + 1.0}, details = row->details, across, small_size, quiet_ink);
    for (std::size_t first = 0; first < row->drawings.size(); first += columns) {
      double below = y;
      for (std::size_t k = first; k < std::min(first + columns, row->drawings.size()); ++k) {
        const Drawing& d = row->drawings[k];
        SvgPoint at{margin + static_cast<double>(k - first) * (widest + between), y + 6.0};
        if (!d.title.empty()) at.y = sheet.write(at, d.title, widest, name_size, ink) + 4.0;
        sheet.drawings.emplace_back(at, &d.svg);
        at.y = sheet.write({at.x, at.y + size_of(d.svg).y}, d.text, widest, small_size, ink);
        below = std::max(below, at.y);
      }
      y = below;
    }
    y = sheet.write({margin, y + 4.0}, row->caption, across, small_size, quiet_ink);
  }
  Svg svg(sheet.width, y + margin, title);
  svg.rectangle({0.0, 0.0}, sheet.width, y + margin, {"", "var(--paper)"});
  for (const auto& [at, drawing] : sheet.drawings) svg.picture(at, *drawing);
  for (const Line& line : sheet.lines) svg.text(line.at, line.words, SvgAnchor::start, line.colour, line.size);
  return svg.file();
}

}  // namespace equipoise
