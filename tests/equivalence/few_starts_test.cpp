// Small searches for few starts: each start comes to what it comes to after a full search.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"

namespace equipoise {
namespace few_starts_test {

struct Ended {
  std::vector<Outcome> outcomes;
  std::vector<std::string> names;
  BasinResult result;

  float velocity(std::size_t i) const { return result.every_start->transient("rms_velocity")->at(i); }
};

Ended ended(const Study& study, bool few_starts, int threads = 2) {
  BasinOptions options;
  options.threads = threads;
  options.transients = options.keep_starts = true;
  options.without_balls = false;
  if (few_starts) options.search = SearchMode::few;
  Ended all;
  options.outcome = [&](const Outcome& outcome) { all.outcomes.push_back(outcome); };
  Catalogue catalogue;
  all.result = basin(study, options, &catalogue);
  for (const Outcome& outcome : all.outcomes) {
    const Attractor* a = outcome.kind == OutcomeKind::attracted ? catalogue.find(outcome.attractor) : nullptr;
    all.names.push_back(a ? a->name : name_of(outcome.kind));
  }
  return all;
}

Study study_from(std::string text, const std::string& more = "") {
  return parse_study(text + more + "[sampling]\nstarts = 200\n", "rotor");
}

// Windows measure the end of a start that no motion's figures are known of; two long ones agree to 2 %.
constexpr double of_windows = 0.02;

void expect_same_ends(const Study& study, std::size_t motions) {
  const Ended few = ended(study, true), full = ended(study, false);
  ASSERT_EQ(few.names.size(), 200u);
  std::vector<std::string> met;
  for (std::size_t i = 0; i < few.names.size(); ++i) {
    if (few.names[i] == name_of(MotionKind::measured))  // with events its windows tell all
      EXPECT_EQ(full.outcomes[i].kind, OutcomeKind::attracted) << "start " << i;
    else
      EXPECT_EQ(few.names[i], full.names[i]) << "start " << i;
    EXPECT_NEAR(few.velocity(i), full.velocity(i), of_windows * full.velocity(i) + 1e-9) << "start " << i;
    if (std::find(met.begin(), met.end(), few.names[i]) == met.end()) met.push_back(few.names[i]);
  }
  EXPECT_GE(met.size(), motions);
}

TEST(FewStarts, ComeToTheSameAtConstantSpeed) { expect_same_ends(study_from(constant_speed), 3); }

TEST(FewStarts, ComeToTheSameAfterARunUp) { expect_same_ends(study_from(ramp_speed), 2); }

TEST(FewStarts, ComeToTheSameWithAMotor) {
  expect_same_ends(study_from(with(rotor_and_balancer, "damping = 0.5", "damping = 0.5\ninertia = 0.6"),
                              "[speed]\nprofile = \"torque\"\ntorque = { stall = 0.1, no_load_speed = 3.0 }\n"),
                   2);
}

TEST(FewStarts, ComeToTheSameUnderGravity) {
  expect_same_ends(study_from(with(constant_speed, "damping = 0.5", "damping = 0.5\ngravity = 0.01")), 3);
}

TEST(FewStarts, ComeToTheSameWhereBallsStick) {
  expect_same_ends(study_from(with(constant_speed, "drag = 0.05", "drag = 0.1\nrolling = 0.001\nstiction = 0.002")), 2);
}

TEST(FewStarts, DependNeitherOnThreadsNorOnTheirNumber) {
  Study study = study_from(constant_speed);
  const Ended one = ended(study, true, 1), two = ended(study, true, 2);
  study.sampling.starts = 100;
  const Ended half = ended(study, true);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_EQ(one.names[i], two.names[i]);
    EXPECT_EQ(one.outcomes[i].time, two.outcomes[i].time);
    EXPECT_EQ(one.velocity(i), two.velocity(i));
    if (i < 100) {
      EXPECT_EQ(one.names[i], half.names[i]);
    }
  }
}

}  // namespace few_starts_test
}  // namespace equipoise
