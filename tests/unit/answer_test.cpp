// The page's sentence, its numbers and the data of its drawings, from results made by hand.
#include "equipoise/report/answers/answer.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/report/drawing/svg.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/shown/shown_runs.hpp"
#include "equipoise/core/statistics/quantile.hpp"

namespace equipoise {
namespace answer_test {

const std::string machine = constant_machine + "[limits]\ndisplacement = \"5 mm\"\nvelocity = \"4.5 mm/s\"\n";

BasinResult result_of(const std::string& text, std::uint64_t starts, std::uint64_t balanced,
                      std::uint64_t undecided = 0) {
  BasinResult r;
  r.study = parse_study(text, "m.toml");
  r.starts = starts;
  r.attractors.push_back(
      {balanced_id, "balanced", "", open_share(balanced, balanced + undecided, starts), "equilibrium", 50.0});
  r.undecided = wilson_share(undecided, starts);
  r.diverged = r.failed = wilson_share(0, starts);
  return r;
}

// Wilson's intervals of 1960 in 2000 are 97.29 to 98.53 %, of 40 in 2000 1.47 to 2.71 % (Wilson 1927, by hand).
TEST(Answer, SaysHowSurelyItBalancesAndWhatIsExceeded) {
  BasinResult r = result_of(machine, 2000, 1960);
  EXPECT_EQ(answer_sentence(r), "The rotor ends balanced in 97.29 to 98.53 % of runs (95 % confidence).");
  r.transients.emplace();
  TransientGroup all;
  all.name = "all";
  all.starts = 2000;
  all.exceeded[0] = wilson_share(40, 2000);
  all.exceeded[2] = wilson_share(0, 2000);
  r.transients->groups.push_back(all);
  EXPECT_EQ(answer_sentence(r),
            "The rotor ends balanced in 97.29 to 98.53 % of runs (95 % confidence); 5 mm is exceeded on the way in "
            "1.47 to 2.71 %; 4.5 mm/s RMS in the end is exceeded in less than 0.19 %.");
}

TEST(Answer, SaysWhatIsNotKnown) {
  const std::string open = answer_sentence(result_of(constant_speed, 1000, 700, 100));
  EXPECT_TRUE(holds(open, "bounds 67.1 to 82.4 %")) << open;  // Wilson of 700 and of 800 in 1000
  EXPECT_TRUE(holds(open, "; 10.0 % stay undecided.")) << open;
  EXPECT_EQ(answer_sentence(result_of(constant_speed, 0, 0)),
            "Nothing is known yet: stopped before the first run was decided.");
  BasinResult lost = result_of(constant_speed, 1000, 999);
  lost.failed = wilson_share(1, 1000);
  EXPECT_TRUE(holds(answer_sentence(lost), "; 1 start could not be followed to an end."));
}

TEST(Answer, SaysThatNothingBalancesAndWhatStalls) {
  BasinResult none = result_of(constant_speed, 100, 0);
  none.stalled = wilson_share(100, 100);
  EXPECT_EQ(
      answer_sentence(none),
      "None of 100 runs balanced; the probability is less than 3.7 % (95 % confidence); more than 96.3 % never come "
      "up to speed.");
  BasinResult stuck = result_of(constant_speed, 100, 100);
  stuck.attractors.front().name = "balanced, stuck";
  EXPECT_TRUE(holds(answer_sentence(stuck), "ends \"balanced, stuck\" in more than 96.3 %"));
}

TEST(PageNumbers, HaveThreeDigitsAndNoPowers) {
  EXPECT_EQ(page_number(0.033127), "0.0331");
  EXPECT_EQ(page_number(3573.2), "3573");
  EXPECT_EQ(page_number(12345.0), "12350");
  EXPECT_EQ(page_number(-10000.0), "-10000");
  EXPECT_EQ(page_number(0.0), "0");
  const PageQuantities shown(parse_study(machine, "m.toml")), plain(parse_study(constant_speed, "c.toml"));
  EXPECT_EQ(shown.text(0.8 / 30.0, study::Dimension::length), "0.8 mm");
  EXPECT_EQ(shown.range(0.08 / 30.0, 0.09 / 30.0, study::Dimension::length), "80 to 90 um");
  EXPECT_EQ(plain.text(41.6, study::Dimension::time), "41.6/ω_c");
  EXPECT_EQ(plain.axis("time", 41.6, study::Dimension::time).label, "time, 1/ω_c");
}

TEST(GivenKeys, AreThoseOfTheTextInItsUnits) {
  const auto tables = given_tables(machine, "m.toml", {"rotor.eccentricity=\"0.3 mm\""});
  ASSERT_EQ(tables.size(), 4u);
  EXPECT_EQ(tables[0][0], "rotor");
  EXPECT_TRUE(holds(tables[0][1], "; eccentricity 0.3 mm")) << tables[0][1];
  EXPECT_TRUE(tables[1][1].ends_with("; race radius 30 mm")) << tables[1][1];
  EXPECT_EQ(tables[3][0], "limits");
  // Without its text the same machine is still shown in units.
  const auto echoed = given_tables(parse_study(machine, "m.toml"));
  EXPECT_EQ(echoed[0][0], "rotor");
  EXPECT_TRUE(holds("; " + echoed[0][1] + ";", "; mass 12 kg;")) << echoed[0][1];
}

TEST(GivenKeys, HaveEveryPlace) {
  const std::string place =
      "[[place]]\nname = \"laundry\"\nmass = \"24 g\"\nradius = \"100 mm\"\nangle = \"90 degree\"\n";
  const auto tables = given_tables(machine + place + place, "m.toml", {"place.2.mass=\"30 g\""});
  ASSERT_EQ(tables.size(), 6u);
  EXPECT_EQ(tables[1][0], "place 1");
  EXPECT_TRUE(holds(tables[1][1], "; name laundry")) << tables[1][1];
  EXPECT_EQ(tables[2][0], "place 2");
  EXPECT_TRUE(holds(tables[2][1], "; mass 30 g")) << tables[2][1];
  EXPECT_EQ(tables[3][0], "balancer");
}

TEST(Runs, AreAtTheQuantilesThatSummariesTell) {
  StartArrays starts;
  const float lost = std::numeric_limits<float>::quiet_NaN();
  std::vector<float>& peak = starts.transients[0];
  peak = {0.3f, 0.1f, lost, 0.5f, 0.2f, 0.4f};
  EXPECT_EQ(median_and_worst(starts), (std::vector<std::uint64_t>{0, 3}));
  // On a grid a start may stand for several cells.
  starts.weight = {1.0, 1.0, 1.0, 1.0, 1.0, 9.0};
  EXPECT_EQ(median_and_worst(starts), (std::vector<std::uint64_t>{5, 3}));
  starts.weight.clear();
  peak = {0.3f};
  EXPECT_EQ(median_and_worst(starts), (std::vector<std::uint64_t>{0}));
  peak = {lost};
  EXPECT_TRUE(median_and_worst(starts).empty());
  // Of a thousand different peaks, 500 are at most that of the typical start, and ten are above that of the worst.
  Distribution all;
  peak.clear();
  for (int k = 0; k < 1000; ++k) {
    peak.push_back(0.001f * static_cast<float>((k * 377) % 1000));
    all.add(peak.back());
  }
  const auto chosen = median_and_worst(starts);
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(peak[chosen[0]], 0.001f * 499.0f);
  EXPECT_EQ(peak[chosen[1]], 0.001f * 989.0f);
  EXPECT_EQ(peak[chosen[0]], static_cast<float>(all.summary().quantiles[0].value));
  EXPECT_EQ(peak[chosen[1]], static_cast<float>(all.summary().quantiles[2].value));
}

TEST(Svg, WritesOutWhatIsNoMarkupAndPlacesDataInItsFrame) {
  Svg svg(100.0, 100.0, "a < b");
  EXPECT_TRUE(holds(svg.str(), "<title>a &lt; b</title>"));
  const SvgAxes axes(svg, {10.0, 10.0}, {90.0, 80.0}, {0.0, 2.0}, {0.0, 4.0}, {"x", 1.0}, {"y", 1.0});
  const SvgPoint middle = axes.at(1.0, 2.0);
  EXPECT_DOUBLE_EQ(middle.x, 50.0);
  EXPECT_DOUBLE_EQ(middle.y, 45.0);
  // A scale above the frame leaves out words that would touch the one before, and those outside.
  Svg above(100.0, 100.0, "scale");
  SvgAxes scaled(above, {10.0, 30.0}, {90.0, 80.0}, {0.0, 2.0}, {0.0, 4.0}, {"x", 1.0}, {"y", 1.0});
  scaled.scale_above({0.0, 0.1, 1.0, 3.0}, {"a1", "a2", "a3", "a4"}, "above");
  for (const char* words : {">a1<", ">a3<", ">above<"}) EXPECT_TRUE(holds(above.str(), words)) << words;
  for (const char* words : {">a2<", ">a4<"}) EXPECT_FALSE(holds(above.str(), words)) << words;
  const auto ticks = round_ticks({0.0, 0.95}, 4);
  ASSERT_EQ(ticks.size(), 2u);  // a quarter is 0.24: the next round step is 0.5
  EXPECT_DOUBLE_EQ(ticks[1], 0.5);
  EXPECT_TRUE(round_ticks({1.0, 1.0}, 4).empty());
  EXPECT_DOUBLE_EQ(round_up(0.21), 0.5);
  EXPECT_DOUBLE_EQ(round_up(20.0), 20.0);
}

}  // namespace answer_test
}  // namespace equipoise
