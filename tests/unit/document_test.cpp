// Reports as HTML and Markdown: nothing is loaded from elsewhere, and no text becomes markup.
#include <cstdio>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "equipoise/base/error.hpp"
#include "equipoise/drawing/document.hpp"

namespace equipoise {
namespace {

Document sample(const std::string& picture) {
  Document d{"A < B & \"C\"", {}};
  d.blocks.push_back(Heading{2, "First", "first"});
  d.blocks.push_back(Paragraph{"x < y | z", Tone::bad});
  d.blocks.push_back(
      DocumentTable{{"a", "b|c"}, {{{"1 < 2", Tone::good, false}, {"3", Tone::plain, true}}}, "Cap", false, {1}});
  Chart chart{"<i>",
              "x",
              "y",
              true,
              false,
              false,
              {{"</script>", "#0072B2", ChartSeries::Style::line, {1, 10}, {2, 3}, {1, 2}, {3, 4}}}};
  d.blocks.push_back(Figure{"Fig", {chart}, picture});
  return d;
}

std::string picture_file() {
  const std::string path = testing::TempDir() + "/document_test.png";
  std::ofstream(path, std::ios::binary) << "Man";
  return path;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Html, IsSelfContainedAndEscaped) {
  const std::string page = document_html(sample(picture_file()));
  EXPECT_NE(page.find("<title>A &lt; B &amp; &quot;C&quot;</title>"), std::string::npos);
  EXPECT_NE(page.find("x &lt; y | z"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,TWFu\""), std::string::npos);  // RFC 4648's own example
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "src=\"/", "<link"})
    EXPECT_EQ(page.substr(0, page.find("</main>")).find(outside), std::string::npos) << outside;
  // A chart's label must not end its script element.
  EXPECT_NE(page.find("<\\/script>"), std::string::npos);
  EXPECT_EQ(count(page, "<script"), count(page, "</script>"));
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
  // A report with charts stays light, as its pictures are. (The chart library's own styles come after this style.)
  const std::string charts = document_html(sample(""));
  EXPECT_EQ(charts.substr(0, charts.find("</style>")).find("prefers-color-scheme"), std::string::npos);
  const std::string text = document_markdown(d, "");
  EXPECT_NE(text.find("- a \\< b: c & d\n"), std::string::npos) << text;
  EXPECT_NE(text.find("```\nx < y\n```"), std::string::npos);
}

TEST(Html, AMissingPictureIsAnError) { EXPECT_THROW(document_html(sample("/nowhere/picture.png")), RunError); }

TEST(Markdown, PointsToPicturesAndEscapes) {
  const std::string text = document_markdown(sample(picture_file()), "pictures");
  EXPECT_NE(text.find("![Fig](pictures/document_test.png)"), std::string::npos);
  EXPECT_NE(text.find("| a | b\\|c |\n| --- | ---: |\n| 1 \\< 2 | 3 |"), std::string::npos);
  EXPECT_NE(text.find("> x \\< y \\| z"), std::string::npos);
}

TEST(Charts, KeepTheirNumbers) {
  const Document d = sample("");
  const auto json = plotly_json(std::get<Figure>(d.blocks.back()).charts.front());
  EXPECT_EQ(json["data"][0]["x"], nlohmann::ordered_json({1.0, 10.0}));
  EXPECT_EQ(json["data"][0]["error_y"]["array"], nlohmann::ordered_json({1.0, 1.0}));
  EXPECT_EQ(json["layout"]["xaxis"]["type"], "log");
}

TEST(Charts, RoundToFiveDigitsWhateverTheScale) {
  Chart chart{"",
              "",
              "",
              false,
              false,
              false,
              {{"", "#000000", ChartSeries::Style::line, {0, 1, 2}, {0.0, 0.000123456789, -98765.4321}, {}, {}}}};
  const auto y = plotly_json(chart)["data"][0]["y"];
  EXPECT_EQ(y[0], 0.0);
  EXPECT_NEAR(y[1].get<double>(), 0.00012346, 1e-12);  // the sixth digit
  EXPECT_NEAR(y[2].get<double>(), -98765.0, 1e-9);
}

}  // namespace
}  // namespace equipoise
