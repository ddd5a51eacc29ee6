// A report as Markdown.
#include <algorithm>

#include <fmt/format.h>

#include "equipoise/report/drawing/document.hpp"

namespace equipoise {

namespace {

std::string markdown_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '_' || c == '<' || c == '`') result += '\\';
    result += c;
  }
  return result;
}

struct MarkdownWriter {
  std::string pictures, out;

  void operator()(const Heading& h) {
    out += fmt::format("{} {}\n\n", std::string(static_cast<std::size_t>(h.level), '#'), markdown_text(h.text));
  }
  void operator()(const Paragraph& p) {
    out += fmt::format("{}{}\n\n", p.tone == Tone::plain ? "" : "> ", markdown_text(p.text));
  }
  void operator()(const Notice& n) {
    out += fmt::format("> {}\n", markdown_text(n.text));
    for (const auto& [word, line] : n.lines) out += fmt::format(">\n> {}: {}\n", word, markdown_text(line));
    out += "\n";
  }
  void operator()(const ItemList& list) {
    for (const std::string& item : list.items) out += fmt::format("- {}\n", markdown_text(item));
    out += "\n";
  }
  void operator()(const DocumentTable& t) {
    out += "|";
    for (const std::string& name : t.header) out += fmt::format(" {} |", markdown_text(name));
    out += "\n|";
    for (std::size_t k = 0; k < t.header.size(); ++k) {
      const bool right = !t.rows.empty() && k < t.rows.front().size() && t.rows.front()[k].number;
      out += right ? " ---: |" : " --- |";
    }
    out += "\n";
    for (const auto& row : t.rows) {
      out += "|";
      for (const DocumentCell& cell : row) {
        const std::string words = markdown_text(cell.text);
        out += cell.link.empty() ? fmt::format(" {} |", words) : fmt::format(" [{}]({}) |", words, cell.link);
      }
      out += "\n";
    }
    out += "\n";
    if (!t.caption.empty()) out += markdown_text(t.caption) + "\n\n";
  }
  void operator()(const DrawingRow& row) {
    if (!row.picture.empty())
      out += fmt::format("![{}]({}{}{}.svg)\n", markdown_text(row.caption), pictures, pictures.empty() ? "" : "/",
                         row.picture);
    for (const Drawing& d : row.drawings)
      if (!d.text.empty()) out += fmt::format("- {}: {}\n", markdown_text(d.title), markdown_text(d.text));
    out += "\n" + markdown_text(row.caption) + "\n\n";
  }
  void operator()(const Listing& listing) {
    out += fmt::format("{}:\n\n```\n{}```\n\n", markdown_text(listing.caption), listing.text);
  }
};

}  // namespace

std::string document_markdown(const Document& document, const std::string& pictures) {
  MarkdownWriter writer{pictures, fmt::format("# {}\n\n", markdown_text(document.title))};
  for (const Block& block : document.blocks) std::visit(writer, block);
  return writer.out;
}

}  // namespace equipoise
