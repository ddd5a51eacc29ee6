// Names from outside made fit for any output.
#include <string>

#include <gtest/gtest.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/drawing/html_text.hpp"
#include "equipoise/report/text/csv.hpp"

namespace equipoise {
namespace display_text_test {

const std::string replaced = "\xEF\xBF\xBD";

TEST(DisplayText, LeavesWhatIsFitToBeShown) {
  for (const char* text :
       {"", "study.toml", "\xC3\xA9t\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x8E\x88", "\xEF\xBF\xBD", "\xED\x9F\xBF"})
    EXPECT_EQ(display_text(text), text);
}

TEST(DisplayText, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(display_text("a\xFFz"), "a" + replaced + "z");
  EXPECT_EQ(display_text("\xC3"), replaced);  // breaks off
  EXPECT_EQ(display_text("\xC3z"), replaced + "z");
  EXPECT_EQ(display_text("\xC0\xAF"), replaced + replaced);  // a longer form of '/'
  EXPECT_EQ(display_text("\xE0\x80\xAF"), replaced + replaced + replaced);
  EXPECT_EQ(display_text("\xED\xA0\x80"), replaced + replaced + replaced);                 // half of a surrogate pair
  EXPECT_EQ(display_text("\xF4\x90\x80\x80"), replaced + replaced + replaced + replaced);  // above U+10FFFF
}

TEST(DisplayText, EscapesControlCharactersOfBothSets) {
  EXPECT_EQ(display_text("a\n\x1b[31m\x7f"), "a\\u000A\\u001B[31m\\u007F");
  EXPECT_EQ(display_text("\xC2\x9B"
                         "31m"),
            "\\u009B31m");  // the other control sequence introducer
  EXPECT_EQ(display_text(std::string("\0", 1)), "\\u0000");
}

TEST(DisplayText, EscapesWhatBeginsALineOrChangesTheDirectionOfWriting) {
  EXPECT_EQ(display_text("a\xE2\x80\xA8z\xE2\x80\xA9\xE2\x80\xA7"), "a\\u2028z\\u2029\xE2\x80\xA7");
  EXPECT_EQ(display_text("a\xE2\x80\xAEz\xE2\x81\xA9\xE2\x80\x8F"), "a\\u202Ez\\u2069\\u200F");
  EXPECT_EQ(display_text("\xE2\x80\x93\xE2\x81\xBB"), "\xE2\x80\x93\xE2\x81\xBB");  // a dash, a superscript minus
  EXPECT_EQ(display_lines("a\x1B\n\n\tb\n"), "a\\u001B\n\n\tb\n");
}

TEST(HtmlText, IsWordsInAnyMarkup) {
  EXPECT_EQ(html_text("<a href=\"x\">&amp;"), "&lt;a href=&quot;x&quot;&gt;&amp;amp;");
  EXPECT_EQ(html_text("a\nb\tc\x1b\xFF"), "a\nb\tc\\u001B" + replaced);  // XML has no such character
}

TEST(CsvText, IsNoFormulaForASpreadsheet) {
  EXPECT_EQ(csv_text("balanced"), "balanced");
  EXPECT_EQ(csv_text("=HYPERLINK(\"a\",\"b\")"), "\"'=HYPERLINK(\"\"a\"\",\"\"b\"\")\"");
  for (const char* text :
       {"+1+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "-x", "+", "=1", "-12*A1*B1&C1", "+3/A1", "-40 degC"})
    EXPECT_EQ(csv_text(text), std::string("'") + text);
  for (const char* number : {"-2.5", "+3", "-1e-9"}) EXPECT_EQ(csv_text(number), number);
}

// All starts were once reported as 1e+02 %.
TEST(PercentText, HasNoExponentAndNeverRoundsToAllOrNone) {
  EXPECT_EQ(percent_text(1.0), "100 %");
  EXPECT_EQ(percent_text(0.0), "0 %");
  EXPECT_EQ(percent_text(0.9996), "more than 99 %");
  EXPECT_EQ(percent_text(0.471), "47 %");
  EXPECT_EQ(percent_text(0.0321), "3.2 %");
  EXPECT_EQ(percent_text(0.0015), "0.15 %");
  EXPECT_EQ(percent_text(0.00001), "less than 0.01 %");
}

}  // namespace display_text_test
}  // namespace equipoise
