// Columns of text.
#include "equipoise/report/text/table_text.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

DocumentCell share_cell(const Share& s) { return number_cell(share_text(s)); }

std::string share_with_interval(const Share& s) {
  if (s.total == 0) return "-";
  if (s.count == 0 || s.count == s.total) return fmt::format("{} % ({})", s.count == 0 ? "0" : "100", interval(s));
  const int digits = digits_for(s);
  const auto text = [&](double share) { return fmt::format("{:.{}f}", 100.0 * share, digits); };
  // Even to a unit of the last digit: the longer side stands for both.
  const double unit = 0.01 * std::pow(10.0, -digits), up = s.high - s.share, down = s.share - s.low;
  if (std::fabs(up - down) < unit) return fmt::format("{} ± {} %", text(s.share), text(std::max(up, down)));
  return fmt::format("{} % ({} to {})", text(s.share), text(s.low), text(s.high));
}

std::string in_tone(const std::string& text, Tone tone, const TextStyle& style) {
  if (!style.colour || tone == Tone::plain || text.empty()) return text;
  const char* code = tone == Tone::good ? "32" : tone == Tone::bad ? "31" : "33";
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

namespace {

std::string bold(const std::string& text, const TextStyle& style) {
  return style.colour && !text.empty() ? "\x1b[1m" + text + "\x1b[0m" : text;
}

using Rows = std::vector<std::vector<DocumentCell>>;

std::vector<std::size_t> widths(const Rows& rows) {
  std::vector<std::size_t> width(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < width.size(); ++k) width[k] = std::max(width[k], display_width(row[k].text));
  return width;
}

// What the table takes of a line.
std::size_t line_width(const Rows& rows) {
  std::size_t sum = 0;
  for (const std::size_t width : widths(rows)) sum += width + 2;
  return sum - 2;
}

}  // namespace

std::string table_text(const DocumentTable& table, const TextStyle& style) {
  Rows rows{row_of(std::string(table.header.size(), 't'), table.header)};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  const bool marked = std::any_of(rows.begin(), rows.end(), [](const auto& r) { return r.front().tone == Tone::good; });
  std::vector<std::size_t> spare = table.spare;
  std::vector<std::string> hidden;
  while (style.width > 0 && !spare.empty() && line_width(rows) + (marked ? 2 : 0) > style.width) {
    const std::size_t gone = spare.back();
    spare.pop_back();
    if (spare.size() < table.missed) hidden.insert(hidden.begin(), rows.front()[gone].text);
    for (auto& row : rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(gone));
    for (std::size_t& k : spare) k -= k > gone;
  }
  const std::vector<std::size_t> width = widths(rows);
  std::vector<bool> right(width.size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < width.size(); ++k) right[k] = right[k] || row[k].number;
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string line = !marked ? "" : rows[r].front().tone == Tone::good ? "* " : "  ";
    std::string gap;  // spaces that are written only before something
    for (std::size_t k = 0; k < width.size(); ++k) {
      const DocumentCell& cell = rows[r][k];
      const std::string blank(width[k] - display_width(cell.text), ' ');
      const std::string shown = r == 0 ? bold(cell.text, style) : in_tone(cell.text, cell.tone, style);
      if (!shown.empty()) line += gap + (right[k] ? blank : "") + shown;
      gap = shown.empty() ? gap + blank + "  " : (right[k] ? "  " : blank + "  ");
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  if (!hidden.empty())
    text += filled(
        "", fmt::format("Columns left out here: {}. A wider terminal or --json shows them.", fmt::join(hidden, ", ")),
        style);
  return table.caption.empty() ? text : text + filled("", table.caption, style);
}

namespace {

// A block as text; empty if only pages show it.
struct TextWriter {
  const TextStyle& style;
  bool headings;

  std::string operator()(const Heading& h) const { return headings ? bold(h.text, style) + "\n" : ""; }
  std::string operator()(const DrawingRow&) const { return ""; }
  std::string operator()(const Paragraph& p) const {
    return in_tone(filled(p.lead ? "answer   " : "", p.text, style), p.tone, style);
  }
  std::string operator()(const Notice& n) const {
    std::string text = in_tone(filled("verdict   ", n.text, style), n.tone, style);
    for (const auto& [word, line] : n.lines)
      if (!line.empty()) text += filled(fmt::format("{:<10}", word), line, style);
    return text;
  }
  std::string operator()(const ItemList& list) const {
    std::string text;
    for (const std::string& item : list.items) text += filled("  ", item, style);
    return text;
  }
  std::string operator()(const DocumentTable& table) const {
    if (table.rows.empty() || (table.folded && !style.details)) return "";
    TextStyle plain = style;
    plain.colour = false;
    return fits(table_text(table, plain)) ? table_text(table, style) : as_list(table);
  }
  std::string operator()(const Listing& listing) const {
    return listing.open ? filled("", listing.caption + ":", style) + listing.text : "";
  }
  std::string operator()(const Brief& brief) const { return lines_filled(brief.lines, style, brief.hang); }

 private:
  bool fits(std::string_view text) const {
    std::size_t widest = 0;
    while (style.width > 0 && !text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size() - 1);
      widest = std::max(widest, display_width(text.substr(0, end)));
      text.remove_prefix(end + 1);
    }
    return widest <= style.width;
  }

  // For cells of long sentences: a row's first cell, and below it the others, each after its title.
  std::string as_list(const DocumentTable& table) const {
    std::string text;
    for (const auto& row : table.rows) {
      text += filled("", row.front().text, style);
      for (std::size_t k = 1; k < row.size(); ++k)
        if (!row[k].text.empty()) text += filled("  " + table.header[k] + ": ", row[k].text, style);
    }
    return table.caption.empty() ? text : text + filled("", table.caption, style);
  }
};

}  // namespace

std::string document_text(const Document& document, const TextStyle& style) {
  std::string text;
  bool in_group = false, below_heading = false;
  for (const Block& block : document.blocks) {
    const std::string shown = std::visit(TextWriter{style, !document.sheet}, block);
    if (shown.empty()) continue;
    const auto* paragraph = std::get_if<Paragraph>(&block);
    const bool sentence = paragraph && !paragraph->lead;
    if (!text.empty() && !below_heading && !(sentence && in_group)) text += "\n";
    in_group = sentence;
    below_heading = std::holds_alternative<Heading>(block);
    text += shown;
  }
  return text;
}

std::string lines_filled(std::string_view lines, const TextStyle& style, std::size_t hang) {
  std::string text;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view line = lines.substr(0, end);
    const bool labelled = hang > 0 && line.size() > hang && line[hang - 1] == ' ' && line[hang] != ' ';
    const std::size_t begin = labelled ? hang : std::min(line.find_first_not_of(' '), line.size());
    text += filled(line.substr(0, begin), line.substr(begin), style);
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return text;
}

std::string filled(std::string_view label, std::string_view text, const TextStyle& style) {
  std::string result(label);
  if (style.width == 0) return result + std::string(text) + "\n";
  std::size_t column = label.size();
  for (bool first = true; !text.empty(); first = false) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size() < text.size() ? word.size() + 1 : text.size());
    const std::size_t wide = display_width(word);
    if (!first && column + 1 + wide > style.width) {
      result += "\n" + std::string(label.size(), ' ');
      column = label.size();
    } else if (!first) {
      result += ' ';
      ++column;
    }
    result += word;
    column += wide;
  }
  return result + "\n";
}

}  // namespace equipoise
