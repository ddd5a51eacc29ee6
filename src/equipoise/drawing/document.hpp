// A report as blocks, independent of the form it takes: HTML page or Markdown.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "equipoise/drawing/chart.hpp"

namespace equipoise {

/// What a cell of a table says at a glance.
enum class Tone { plain, good, bad, open };

struct DocumentCell {
  std::string text;
  Tone tone = Tone::plain;
  bool number = false;  ///< set to the right
  bool label = false;   ///< kept on one line where there is room
};

struct Heading {
  int level = 2;
  std::string text, anchor;
};
struct Paragraph {
  std::string text;
  Tone tone = Tone::plain;  ///< other than plain: a box
};
struct DocumentTable {
  std::vector<std::string> header;
  std::vector<std::vector<DocumentCell>> rows;
  std::string caption;
  bool folded = false;  ///< long detail, shown on demand
  /// Columns that a narrow screen can spare.
  std::vector<std::size_t> spare;
};
struct Figure {
  std::string caption;
  std::vector<Chart> charts;  ///< interactive; may be empty
  std::string picture;        ///< path of the static picture; may be empty
};
using Block = std::variant<Heading, Paragraph, DocumentTable, Figure>;

struct Document {
  std::string title;
  std::vector<Block> blocks;
};

/// One self-contained page: pictures and the chart library are inside, nothing is loaded from elsewhere. Without the
/// chart library, or where scripts do not run or on paper, the pictures stand in for the charts.
/// Throws RunError if a picture cannot be read.
std::string document_html(const Document& document);

/// Markdown whose pictures are files; `pictures`: their folder as seen from the Markdown file.
std::string document_markdown(const Document& document, const std::string& pictures);

}  // namespace equipoise
