// Picture files: words from outside stay words, colours are concrete, lines fit; lines of zero are whole.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/drawing/svg.hpp"
#include "equipoise/report/plots/plane_frame.hpp"

namespace equipoise {
namespace plot_file_test {

Plot plot_of(const std::string& label) {
  Plot plot{"", label, label, false, false, true, {}};
  for (const char* colour : {"#0072B2", limit_colour})
    plot.series.push_back({label, colour, PlotSeries::Style::line, {1.0, 2.0}, {3.0, 4.0}, {}, {}});
  return plot;
}

TEST(PlotFile, WordsFromOutsideStayWords) {
  const std::string hostile = "a\n]]><script>&\"'\x1b:var(--ink)\xFF";
  const std::string file = document_svg({"", {drawn({plot_of(hostile)}, "")}}, hostile);
  EXPECT_FALSE(holds(file, "<script>"));
  EXPECT_FALSE(holds(file, "\x1b"));
  EXPECT_TRUE(holds(file, "a\\u000A]]&gt;&lt;script&gt;&amp;&quot;'\\u001B:var(--ink)\xEF\xBF\xBD</text>")) << file;
}

TEST(PlotFile, HasConcreteColours) {
  const std::string file = document_svg({"", {drawn({plot_of("x")}, "")}}, "t");
  for (const char* part : {"xmlns=\"http://www.w3.org/2000/svg\"", "fill:#ffffff", "fill:#1b1f24", "stroke:#b3361b"})
    EXPECT_TRUE(holds(file, part)) << part;
  EXPECT_FALSE(holds(file, "var(")) << file;
}

TEST(PlotFile, SeveralDrawingsStandTwoToARowEachWithItsWords) {
  Svg small(100.0, 50.0, "small");
  small.line({0.0, 0.0}, {1.0, 1.0}, {ink, ""});
  DrawingRow row;
  for (const char* title : {"first", "second", "third"}) row.drawings.push_back({title, small.str(), "below", ""});
  row.caption = "caption";
  const std::string file = document_svg({"", {row}}, "t");
  for (const char* part : {">first<", ">third<", ">below<", ">caption<", "translate(14 ", "translate(130 "})
    EXPECT_TRUE(holds(file, part)) << part;
  EXPECT_EQ(size_of(file).x, 2.0 * 100.0 + 16.0 + 2.0 * 14.0);
  EXPECT_GT(size_of(file).y, 2.0 * 50.0);
}

TEST(TextLines, FitAndKeepAllWords) {
  EXPECT_EQ(text_lines("one two", 500.0), std::vector<std::string>{"one two"});
  EXPECT_TRUE(text_lines("", 500.0).empty());
  const std::string word(80, 'w'), text = "ψ " + word + " of many words and φ";
  std::string joined;
  for (const std::string& line : text_lines(text, 100.0)) {
    EXPECT_LE(display_width(line), 16u) << line;
    joined += line;
  }
  joined.erase(std::remove(joined.begin(), joined.end(), ' '), joined.end());
  EXPECT_EQ(joined, "ψ" + word + "ofmanywordsandφ");
}

std::vector<float> field(const SliceAxis& x, const SliceAxis& y, double (*value)(double, double)) {
  std::vector<float> values;
  for (int row = 0; row < y.pixels; ++row)
    for (int column = 0; column < x.pixels; ++column)
      values.push_back(static_cast<float>(value(x.centre(column), y.centre(row))));
  return values;
}

// Dashes would start again in every cell.
TEST(ZeroLine, IsOneLineFromEndToEnd) {
  const SliceAxis x{"a", -2.0, 2.0, 40}, y{"b", -2.0, 2.0, 30};
  const auto circle = zero_line(x, y, field(x, y, [](double a, double b) { return std::hypot(a, b) - 1.0; }));
  ASSERT_EQ(circle.size(), 1u);
  EXPECT_EQ(circle.front().front(), circle.front().back());
  double turn = 0.0;
  for (std::size_t k = 1; k < circle.front().size(); ++k) {
    const MapPoint &p = circle.front()[k - 1], &q = circle.front()[k];
    EXPECT_NEAR(std::hypot(p[0], p[1]), 1.0, 0.01);
    turn += std::atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]);
  }
  EXPECT_NEAR(std::fabs(turn), 2.0 * std::acos(-1.0), 1e-6);
  const auto across = zero_line(x, y, field(x, y, [](double a, double b) { return a + 0.3 * b; }));
  ASSERT_EQ(across.size(), 1u);
  EXPECT_NEAR(std::fabs(across.front().front()[1]), 2.0, 1e-6);  // to both edges
  EXPECT_NEAR(across.front().front()[1], -across.front().back()[1], 1e-6);
  EXPECT_TRUE(zero_line(x, y, field(x, y, [](double, double) { return 1.0; })).empty());
}

}  // namespace plot_file_test
}  // namespace equipoise
