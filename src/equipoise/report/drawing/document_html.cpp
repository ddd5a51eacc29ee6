// A report as one self-contained HTML page.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/html_text.hpp"

namespace equipoise {

namespace {

const char* name_of(Tone tone) {
  constexpr std::array names{"", "good", "bad", "open"};
  return names[static_cast<std::size_t>(tone)];
}

std::string linked(const DocumentCell& cell) {
  const std::string words = html_text(cell.text);
  return cell.link.empty() ? words : fmt::format("<a href=\"{}\">{}</a>", html_text(cell.link), words);
}

class HtmlWriter {
 public:
  explicit HtmlWriter(bool sheet) : sheet_(sheet) {}
  std::string out;

  void operator()(const Heading& h) {
    out += fmt::format("<h{0}{1}>{2}</h{0}>\n", h.level, h.anchor.empty() ? "" : fmt::format(" id=\"{}\"", h.anchor),
                       html_text(h.text));
  }

  void operator()(const Paragraph& p) {
    const std::string style = p.lead                  ? " class=\"lead\""
                              : p.tone == Tone::plain ? ""
                                                      : fmt::format(" class=\"box {}\"", name_of(p.tone));
    out += fmt::format("<p{}>{}</p>\n", style, html_text(p.text));
  }

  void operator()(const Notice& n) {
    out += fmt::format("<div class=\"notice {}\">\n<p>{}</p>\n", name_of(n.tone), html_text(n.text));
    for (const auto& [word, line] : n.lines)
      if (!line.empty()) out += fmt::format("<p><span>{}</span> {}</p>\n", html_text(word), html_text(line));
    out += "</div>\n";
  }

  void operator()(const ItemList& list) {
    out += "<ul class=\"items\">\n";
    for (const std::string& item : list.items) out += fmt::format("<li>{}</li>\n", html_text(item));
    out += "</ul>\n";
  }

  void operator()(const DocumentTable& t) {
    constexpr std::size_t short_enough = 40, most = 5000;
    const std::size_t all = t.rows.size(), shown = sheet_ ? std::min(all, most) : all;
    const bool long_one = sheet_ && all > short_enough, folded = t.folded || long_one;
    const std::string caption =
        !long_one ? t.caption : fmt::format("All {} rows{}{}", all, t.caption.empty() ? "" : ". ", t.caption);
    if (shown < all)
      (*this)(Paragraph{fmt::format("The table ends after {} of {} rows; the CSV file has all of them.", shown, all)});
    if (folded) out += fmt::format("<details><summary>{}</summary>\n", html_text(caption));
    out += "<div class=\"scroll\"><table>\n";
    const auto spare = [&](std::size_t k) { return std::find(t.spare.begin(), t.spare.end(), k) != t.spare.end(); };
    out += "<thead><tr>";
    for (std::size_t k = 0; k < t.header.size(); ++k) {
      const bool number = !t.rows.empty() && k < t.rows.front().size() && t.rows.front()[k].number;
      out += fmt::format("<th{}>{}</th>", style_of(number ? "number" : "", spare(k) ? "spare" : "", ""),
                         html_text(t.header[k]));
    }
    out += "</tr></thead>\n<tbody>\n";
    for (std::size_t r = 0; r < shown; ++r) {
      const auto& row = t.rows[r];
      out += "<tr>";
      for (std::size_t k = 0; k < row.size(); ++k)
        out += fmt::format("<td{}>{}</td>",
                           style_of(row[k].number  ? "number"
                                    : row[k].label ? "label"
                                                   : "",
                                    spare(k) ? "spare" : "", name_of(row[k].tone)),
                           linked(row[k]));
      out += "</tr>\n";
    }
    out += "</tbody></table></div>\n";
    if (!folded && !caption.empty()) out += fmt::format("<p class=\"caption\">{}</p>\n", html_text(caption));
    if (folded) out += "</details>\n";
  }

  void operator()(const DrawingRow& row) {
    constexpr std::array sizes{"", " large", " wide", " whole"};
    out += fmt::format("<figure class=\"drawings{}\">\n<div>\n", sizes[static_cast<std::size_t>(row.size)]);
    for (const Drawing& d : row.drawings) {
      const std::string swatch =
          d.colour.empty() ? "" : fmt::format("<span class=\"swatch\" style=\"background:{}\"></span>", d.colour);
      out += "<div>\n";
      if (!d.title.empty()) out += fmt::format("<p class=\"title\">{}{}</p>\n", swatch, html_text(d.title));
      out += d.svg;
      if (!d.text.empty()) out += fmt::format("<p>{}</p>\n", html_text(d.text));
      out += "</div>\n";
    }
    out += "</div>\n";
    if (!row.caption.empty()) out += fmt::format("<figcaption>{}</figcaption>\n", html_text(row.caption));
    out += "</figure>\n";
  }

  void operator()(const Brief& brief) {
    if (!brief.sentence.empty()) (*this)(Paragraph{brief.sentence});
  }

  void operator()(const Listing& listing) {
    out += fmt::format("<details{}><summary>{}</summary>\n<pre>{}</pre>\n</details>\n", listing.open ? " open" : "",
                       html_text(listing.caption), html_text(listing.text));
  }

 private:
  const bool sheet_;

  static std::string style_of(const std::string& a, const std::string& b, const std::string& c) {
    std::string names;
    for (const std::string* name : {&a, &b, &c})
      if (!name->empty()) names += (names.empty() ? "" : " ") + *name;
    return names.empty() ? "" : fmt::format(" class=\"{}\"", names);
  }
};

std::string contents(const Document& document) {
  std::string list;
  for (const Block& block : document.blocks)
    if (const auto* h = std::get_if<Heading>(&block); h && h->level == 2 && !h->anchor.empty())
      list += fmt::format("<a href=\"#{}\">{}</a>\n", h->anchor, html_text(h->text));
  return list.empty() ? "" : "<nav>\n" + list + "</nav>\n";
}

}  // namespace

std::string document_html(const Document& document) {
  HtmlWriter writer(document.sheet);
  for (const Block& block : document.blocks) std::visit(writer, block);
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  // Style and pictures are in it; it runs no script and fetches nothing.
  page +=
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "img-src data:; base-uri 'none'; form-action 'none'\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += fmt::format("<title>{}</title>\n<style>\n{}{}</style>\n</head>\n", html_text(document.title),
                      embedded::page_files.find("document.css"),
                      document.sheet ? embedded::page_files.find("sheet.css") : "");
  page += fmt::format("<body>\n<main>\n<h1>{}</h1>\n", html_text(document.title));
  return page + contents(document) + writer.out + "</main>\n</body>\n</html>\n";
}

}  // namespace equipoise
