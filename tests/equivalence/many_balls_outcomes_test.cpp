// Nine balls or more: starts decided as basin decides them, against the same starts followed alone for much longer with
// no rule that might end them, and described by means and extremes alone (machine_follow.hpp).
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/machine/model/system.hpp"
#include "machine_follow.hpp"

namespace many_balls_outcomes_test {

using namespace equipoise;

struct Case {
  std::string name, toml;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::string study_text(int balls, const std::string& mass, const std::string& more) {
  return "[rotor]\neccentricity = 0.01\ndamping = 0.5\n[balancer]\nballs = " + std::to_string(balls) +
         "\nmass = " + mass + "\ndrag = 0.1\n" + more + "[speed]\nprofile = \"constant\"\nspeed = 2.4\n";
}

std::vector<Case> cases() {
  const std::string contact = "contact_angle = 0.2\n",
                    kinds =
                        "[0.004, 0.004, 0.004, 0.004, 0.006, 0.006, 0.006, 0.006, 0.006, 0.008, 0.008, 0.008, 0.008, "
                        "0.008, 0.008, 0.008]";
  return {{"of_9", study_text(9, "0.0111", "")},
          {"of_12", study_text(12, "0.00833", "")},
          {"of_16", study_text(16, "0.00625", "")},
          {"of_12_in_contact", study_text(12, "0.00833", contact)},
          {"of_16_of_three_kinds", study_text(16, kinds, "")}};
}

class ManyBalls : public testing::TestWithParam<Case> {};

TEST_P(ManyBalls, ComeToWhatTheyAreSaidTo) {
  Study study = parse_study(GetParam().toml, GetParam().name);
  study.sampling.starts = 16;
  BasinOptions options;
  options.threads = 1;
  options.keep_starts = true;
  const BasinResult result = basin(study, options);
  int decided = 0;
  for (std::uint64_t i = 0; i < study.sampling.starts; ++i) {
    const int outcome = result.every_start->outcome[i];
    if (outcome <= 0) continue;
    ++decided;
    if (i % 3 != 0) continue;
    const auto seen = machine_follow::follow(study, i, 4.0 * result.every_start->decision_time[i] + 4000.0);
    ASSERT_FALSE(seen.lost);
    // The rotor without balls would shake with r = 0.012.
    EXPECT_EQ(outcome == 1, machine_follow::kind_of(study, seen) == "rest" && seen.last_r < 1e-4) << "start " << i;
  }
  EXPECT_GE(decided, 8);
}

INSTANTIATE_TEST_SUITE_P(Of, ManyBalls, testing::ValuesIn(cases()), [](const auto& info) { return info.param.name; });

}  // namespace many_balls_outcomes_test
