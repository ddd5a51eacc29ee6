// Reports as HTML: nothing is loaded from elsewhere, and no text becomes markup.
#include <string>

#include <gtest/gtest.h>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise {
namespace document_test {

Document sample() {
  Document d{"A < B & \"C\"", {}};
  d.blocks.push_back(Heading{2, "First", "first"});
  d.blocks.push_back(Paragraph{"x < y | z", Tone::bad});
  d.blocks.push_back(
      DocumentTable{{"a", "b|c"}, {{{"1 < 2", Tone::good, false}, {"3", Tone::plain, true}}}, "Cap", false, {1}});
  d.blocks.push_back(DrawingRow{{{"<i>", "<svg></svg>\n", "", ""}}, "Fig"});
  return d;
}

TEST(Html, IsSelfContainedAndEscaped) {
  const std::string page = document_html(sample());
  EXPECT_NE(page.find("<title>A &lt; B &amp; &quot;C&quot;</title>"), std::string::npos);
  EXPECT_NE(page.find("x &lt; y | z"), std::string::npos);
  EXPECT_NE(page.find("&lt;i&gt;</p>\n<svg></svg>"), std::string::npos);
  for (const char* outside : {"src=", "href=\"http", "@import", "<link", "<script"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(Html, ASheetHasDrawingsAndListingsButNoScript) {
  Document d{"Sheet", {Paragraph{"all of it", Tone::plain, true}}};
  d.sheet = true;
  d.blocks.push_back(DrawingRow{{{"a < b", "<svg></svg>\n", "c & d", "#0072B2"}}, "Cap"});
  d.blocks.push_back(Listing{"Text", "x < y\n"});
  const std::string page = document_html(d);
  for (const char* part : {"class=\"lead\">all of it", "background:#0072B2", "a &lt; b", "<svg></svg>", "c &amp; d",
                           "<pre>x &lt; y\n</pre>", "prefers-color-scheme: dark"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const char* none : {"<script", "<nav", "<svg>&"}) EXPECT_EQ(page.find(none), std::string::npos) << none;
  // A long report stays light: colours of its curves are chosen for white paper.
  EXPECT_EQ(document_html(sample()).find("prefers-color-scheme"), std::string::npos);
}

// Shares that do not add up to all say why.
TEST(TableText, NamesTheColumnsThatItHidesIfTheyAreMissed) {
  DocumentTable table{
      {"first", "second", "starts"}, {{number_cell("1"), number_cell("2"), number_cell("3")}}, "", false, {}};
  table.spare = {0, 1, 2};
  table.missed = 2;
  EXPECT_EQ(table_text(table, {30}).find("left out"), std::string::npos);
  EXPECT_EQ(table_text(table, {14}).find("left out"), std::string::npos);
  const std::string narrow = table_text(table, {8});
  EXPECT_EQ(narrow.find("second\n"), std::string::npos) << narrow;
  EXPECT_NE(narrow.find("second."), std::string::npos) << narrow;
}

}  // namespace document_test
}  // namespace equipoise
