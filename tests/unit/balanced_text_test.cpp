// What slices over an eccentricity say about balance.
#include <gtest/gtest.h>

#include <string>

#include "../support/parameters.hpp"
#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {
namespace balanced_text_test {

// A row of letters each: b balanced, u undecided, anything else "locked".
BasinSlice drawn(const std::string& y, const std::vector<std::string>& rows) {
  BasinSlice map;
  map.study = study_of(base_rotor(2), 2.4);  // mu = 0.05
  map.x = {"rotor.eccentricity", 0.0, 0.1, static_cast<int>(rows.front().size())};
  map.y = {y, 0.0, 0.1, static_cast<int>(rows.size())};
  for (const std::string& row : rows)
    for (const char c : row) map.code.push_back(c == 'b' ? short{balanced_id} : c == 'u' ? undecided_code : short{7});
  return map;
}

TEST(BalancedText, OfAnglesSaysWhereAllStartsBalanceAndWhereSomeDo) {
  EXPECT_EQ(
      balanced_text(drawn("initial.phi_1", {"ubbbx", "ubbxb"})),
      "All starts balance at λ from 0.03 to 0.05, some at λ from 0.03 to 0.09. The balls can cancel λ up to 0.1.");
  EXPECT_EQ(balanced_text(drawn("initial.phi_1", {"bxxxb", "xxxxb"})),
            "All starts balance at λ from 0.09 to 0.09, some at λ from 0.01 to 0.01 and from 0.09 to 0.09. The balls "
            "can cancel λ up to 0.1.");
  EXPECT_EQ(balanced_text(drawn("initial.phi_1", {"xxu"})),
            "All starts balance at no λ, some at no λ. The balls can cancel λ up to 0.1.");
}

TEST(BalancedText, OfMassesSaysHowMuchOfWhatTheBallsCanCancel) {
  // mu 0.025 and 0.075; lambda 0.01, 0.03, ..: 0.03 of 0.05, and 0.07 of 0.15 with an undecided pixel inside.
  EXPECT_EQ(balanced_text(drawn("balancer.mass", {"bbxbx", "bubbx"})),
            "As λ grows starts cease to balance at 0.47 (μ = 0.075) to 0.60 (μ = 0.025) of the 2 μ that the balls can "
            "cancel; in 1 of 2 rows some balance again beyond.");
  // Rows that do not end within the slice are not mentioned.
  EXPECT_EQ(balanced_text(drawn("balancer.mass", {"bbbbb", "xxxxx"})), "No row of one μ shows where balance ends.");
}

TEST(BalancedText, SaysNothingOfAMapThatStopped) {
  BasinSlice map = drawn("initial.phi_1", {"bb", "bb"});
  map.complete = false;
  EXPECT_EQ(balanced_text(map), "");
}

}  // namespace balanced_text_test
}  // namespace equipoise
