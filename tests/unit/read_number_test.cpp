// Numbers read by the C library against std::from_chars(): the same bits, and the same end.
#include "equipoise/core/base/read_number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>

#include <fmt/format.h>

namespace equipoise {
namespace read_number_test {

void expect_same(const std::string& text) {
  double expected = 7.0, read = 7.0;
  const char *begin = text.data(), *end = begin + text.size();
  const auto [after, error] = std::from_chars(begin, end, expected);
  const NumberRead ours = read_number_by_c(begin, end, read);
  EXPECT_EQ(ours.end - begin, after - begin) << text;
  EXPECT_EQ(ours.error, error) << text;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(expected)) << text;
}

TEST(ReadNumber, TakesWhatFromCharsTakes) {
  std::istringstream texts(
      "|-|+1| 1|1|-1|1.|.5|.|-.5|1.5mm|1e3|1e|1e+|1e-3x|1e+3|1E5|12 kg|0x10|1..2|inf|-inf|INF|infin|Infinity|nan|"
      "NaN|nan(abc)|nan(|in|1e400|-1e400|1e-400|5e-324|2.4e-324|1.7976931348623157e308|1.7976931348623159e308|0.1|"
      "0e999|00012|9007199254740993|2.2250738585072014e-308|1e-310|- 1");
  for (std::string text; std::getline(texts, text, '|');) expect_same(text);
}

TEST(ReadNumber, RoundsToNearest) {
  std::mt19937_64 draw(1);
  for (int k = 0; k < 20000; ++k) {
    const double value = std::bit_cast<double>(draw());
    expect_same(fmt::format("{}", value));
    expect_same(fmt::format("{:.25e}", value));
    expect_same(fmt::format("{:.3g}", value));
  }
}

TEST(ReadNumber, NumberOfAllTakesNothingBesideTheNumber) {
  EXPECT_EQ(number_of_all(".5"), 0.5);
  EXPECT_EQ(number_of_all("-5."), -5.0);
  for (const char* text : {"", " 1", "1 ", "1 kg", "+1", "1e999", "."}) EXPECT_FALSE(number_of_all(text)) << text;
}

TEST(ReadNumber, NumberInTakesWhatATextBeginsWith) {
  EXPECT_EQ(number_in("2.5 mm"), 2.5);
  EXPECT_EQ(number_in("-1e-3"), -1e-3);
  EXPECT_EQ(number_in("mm"), 0.0);
  EXPECT_EQ(number_in(""), 0.0);
}

}  // namespace read_number_test
}  // namespace equipoise
