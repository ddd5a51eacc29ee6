// A result as blocks. The terminal prints them (report/text/table_text.hpp), and a page shows them with their drawings.
// This room: plots, SVG and documents: the means of drawing, no result.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace equipoise {

/// The tone of a table cell, seen at a glance.
enum class Tone { plain, good, bad, open };

struct DocumentCell {
  std::string text;
  Tone tone = Tone::plain;
  bool number = false;  ///< right-aligned
  bool label = false;   ///< kept on one line where there is room
  std::string link{};   ///< link target; may be empty
};
inline DocumentCell number_cell(const std::string& text) { return {text, Tone::plain, true}; }
inline DocumentCell label_cell(const std::string& text) { return {text, Tone::plain, false, true}; }
/// A row of plain cells, a letter each: text, number or label.
inline std::vector<DocumentCell> row_of(const std::string& letters, const std::vector<std::string>& texts) {
  std::vector<DocumentCell> row;
  for (std::size_t k = 0; k < texts.size(); ++k)
    row.push_back({texts[k], Tone::plain, letters[k] == 'n', letters[k] == 'l'});
  return row;
}

struct Heading {
  int level = 2;
  std::string text, anchor;
};
struct Paragraph {
  std::string text;
  Tone tone = Tone::plain;  ///< other than plain: in a box
  bool lead = false;        ///< the document's main statement, in larger letters
};
/// The document's verdict, before everything else: a statement in a box of a tone, and lines below it, each after a
/// word that says what it is: {"why", "98 % of runs stay within every limit."}.
struct Notice {
  std::string text;
  Tone tone = Tone::plain;
  std::vector<std::array<std::string, 2>> lines;
};
/// Short items in columns.
struct ItemList {
  std::vector<std::string> items;
};
struct DocumentTable {
  std::vector<std::string> header{};
  std::vector<std::vector<DocumentCell>> rows{};
  std::string caption{};
  bool folded = false;  ///< long detail, shown on demand
  /// Columns that a narrow screen may hide.
  std::vector<std::size_t> spare{};
  std::size_t missed = 0;  ///< how many of these, the first ones, are missed: text says which of them are hidden
};
/// A picture drawn for the page itself (report/drawing/svg.hpp), as text in the page's own light or dark colours.
struct Drawing {
  std::string title{}, svg{}, text{};
  std::string colour{};  ///< of an outcome, shown before the title; may be empty
};
/// On paper three to a row; two, for plots, which have small print; one below the other, as wide as the text, for the
/// page's main subject; across the whole sheet.
enum class DrawingSize { small, large, wide, whole };
/// Drawings side by side where there is room.
struct DrawingRow {
  std::vector<Drawing> drawings{};
  std::string caption{};
  DrawingSize size = DrawingSize::small;
  /// What a picture file says in addition, as the rest of the document is not there: the parameters that do not vary,
  /// and whether the result is partial.
  std::string details{};
};
/// Verbatim lines, shown on demand.
struct Listing {
  std::string caption, text;
  bool open = false;  ///< part of the answer: always shown
};
/// The same in two forms: lines for the terminal, and a sentence for a page, which has room for the rest elsewhere.
struct Brief {
  std::string lines, sentence;
  std::size_t hang = 0;  ///< width of the label that lines begin with
};
using Block = std::variant<Heading, Paragraph, Notice, ItemList, DocumentTable, DrawingRow, Listing, Brief>;

struct Document {
  std::string title;
  std::vector<Block> blocks;
  /// A sheet to take to a meeting: closely set, at most two pages of A4 if its writer keeps to that, dark on dark
  /// screens. Its long tables are folded, and end where paper would have no end.
  bool sheet = false;

  void add(Block block) { blocks.push_back(std::move(block)); }
  /// A paragraph per line; empty lines are left out.
  void add_lines(std::string_view lines) {
    while (!lines.empty()) {
      const std::size_t end = std::min(lines.find('\n'), lines.size());
      if (end > 0) add(Paragraph{std::string(lines.substr(0, end))});
      lines.remove_prefix(std::min(end + 1, lines.size()));
    }
  }
};

/// One self-contained page without scripts: its drawings are inside, and nothing is loaded from elsewhere.
std::string document_html(const Document& document);

/// The document's drawings as one SVG that needs nothing else, for browsers, word processors and printers: title, and
/// row by row details, drawings two to a row with their titles and words, caption.
std::string document_svg(const Document& document, const std::string& title);
template <class Result>
std::string result_svg(const Result& result, const std::string& title) {
  return document_svg(document_of(result), title);
}

}  // namespace equipoise
