// Starts that draw their rotor: the same outcomes as from plain studies, whatever the threads, kept in files; and what
// balance depends on.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/files.hpp"
#include "../support/refusals.hpp"
#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/one_study/sensitivity.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {
namespace drawn_starts_test {

// Half of its starts balance, half co-drift; both are decided within a few hundred units of time.
const std::string rotor =
    rotor_and_balancer + "[speed]\nprofile = \"ramp\"\nfinal = 1.8\nduration = 20.0\n[sampling]\nstarts = 120\n";

Study study_with(const std::vector<std::string>& overrides) { return parse_study(rotor, "study", overrides); }

struct Ensemble {
  BasinResult result;
  std::vector<std::string> outcomes;  // of each start, by name
};

Ensemble run(const Study& study, BasinOptions options = {}) {
  Ensemble ensemble;
  std::vector<Outcome> outcomes;
  options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
  options.keep_starts = true;
  Catalogue catalogue;
  ensemble.result = basin(study, options, &catalogue);
  for (const Outcome& outcome : outcomes) {
    const Attractor* a = outcome.kind == OutcomeKind::attracted ? catalogue.find(outcome.attractor) : nullptr;
    ensemble.outcomes.push_back(a ? a->name : name_of(outcome.kind));
  }
  return ensemble;
}

std::size_t differences(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  EXPECT_EQ(a.size(), b.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i];
  return count;
}

TEST(DrawnStarts, OfOneRotorHaveThatRotorsOutcomesAndTransients) {
  const Ensemble plain = run(study_with({"limits.displacement=0.1"}));
  const Ensemble drawn = run(study_with({"limits.displacement=0.1", "rotor.eccentricity={values=[0.01]}"}));
  EXPECT_GE(drawn.result.attractors.size(), 2u);
  // Near a boundary of basins one start in a thousand may end otherwise with another step error.
  EXPECT_LE(differences(plain.outcomes, drawn.outcomes), 1u);
  const StartArrays &a = *plain.result.every_start, &b = *drawn.result.every_start;
  EXPECT_EQ(a.phi, b.phi);
  for (std::size_t k = 0; k < 2; ++k) {  // peaks, over all and after release: the same lanes see them
    std::size_t apart = 0;               // such as peak again on a chaotic way after they were told
    for (std::size_t i = 0; i < plain.outcomes.size(); ++i)
      apart += std::fabs(a.transients[k][i] - b.transients[k][i]) >
               1e-3 * a.transients[k][i];  // between steps they are cubics
    EXPECT_LE(apart, 1u) << transient_figures[k].name;
  }
}

TEST(DrawnStarts, OfHardlyDifferentRotorsHaveTheSharesOfOne) {
  const BasinResult plain = run(study_with({})).result;
  const BasinResult drawn = run(study_with({"rotor.eccentricity={uniform=[0.01, 0.01000000001]}"})).result;
  for (const OutcomeShare& a : plain.attractors)
    for (const OutcomeShare& b : drawn.attractors) {
      if (a.name != b.name) continue;
      EXPECT_LE(b.share.low, a.share.share) << a.name;
      EXPECT_GE(b.share.high, a.share.share) << a.name;
      // Of common starts only chaotic ones can end elsewhere: two or three in a hundred here.
      EXPECT_NEAR(static_cast<double>(a.share.count), static_cast<double>(b.share.count), 3.0) << a.name;
    }
}

TEST(DrawnStarts, OfAListHaveTheOutcomesOfItsStudies) {
  const std::vector<std::string> first{"balancer.drag=0.05"}, second{"balancer.drag=0.1"};
  const Study study = study_with({"balancer.drag={values=[0.05, 0.1]}"});
  const std::vector<std::string> of_first = run(study_with(first)).outcomes,
                                 of_second = run(study_with(second)).outcomes;
  std::vector<std::string> wanted;
  std::size_t firsts = 0;
  for (std::uint64_t i = 0; i < of_first.size(); ++i) {
    const bool is_first = drawn_values(study, sampler_of(study), study.sampling.seed, i)[0] == 0.05;
    firsts += is_first;
    wanted.push_back((is_first ? of_first : of_second)[i]);
  }
  EXPECT_NEAR(static_cast<double>(firsts), 60.0, 4.0 * std::sqrt(30.0));  // binomial
  EXPECT_GT(differences(of_first, of_second), 30u);                       // so that the draw matters
  EXPECT_LE(differences(run(study).outcomes, wanted), 1u);
}

TEST(DrawnStarts, AreTheSameWithAnyThreadsResumedAndReplayed) {
  const std::vector<std::string> set{"rotor.eccentricity={uniform=[0.005, 0.015]}", "sampling.starts=40"};
  const Study study = study_with(set);
  BasinOptions options;
  options.threads = 1;
  const Ensemble one = run(study, options);
  options.threads = 2;
  const std::string path = scratch_file("drawn-starts.nc");
  options.output = path;
  Study part = study;
  part.sampling.starts = 25;
  run(part, options);
  const Ensemble whole = run(study, options);
  std::filesystem::remove(path);
  EXPECT_EQ(whole.result.resumed_from, 25u);
  EXPECT_EQ(one.outcomes, whole.outcomes);
  EXPECT_EQ(one.result.every_start->decision_time, whole.result.every_start->decision_time);
  EXPECT_EQ(one.result.every_start->outcome, whole.result.every_start->outcome);
  const StartReplay replay = replay_start(study, 31);
  EXPECT_EQ(replay.outcome.time, one.result.every_start->decision_time[31]);
  EXPECT_EQ(replay.name, one.outcomes[31]);
  EXPECT_EQ(replay.drawn[0], one.result.every_start->drawn[31]);
  EXPECT_EQ(replay.drawn, drawn_values(study, sampler_of(study), study.sampling.seed, 31));
}

TEST(DrawnStarts, OfMachinesKeepTheirUnits) {
  // A heavier rotor on the same supports has slower units of time: times of all draws are those of the medians.
  const std::string machine = R"([rotor]
mass = "12 kg"
stiffness = "48 kN/m"
damping_ratio = 0.25
unbalance = "200 g mm"
[balancer]
balls = 2
race_radius = "120 mm"
mass = "6 g"
drag = "1e-3 N m s"
[speed]
profile = "constant"
speed = "1500 rpm"
[sampling]
starts = 4
)";
  const Study draws = parse_study(machine, "machine", {"rotor.mass={values=[\"3 kg\", \"12 kg\", \"12 kg\"]}"});
  const Study light = parse_study(machine, "machine", {"rotor.mass=3 kg"});
  BasinOptions options;
  options.transients = true;
  const double ratio = light.scales->time() / draws.scales->time();
  EXPECT_NEAR(ratio, 0.5, 1e-12);
  int lights = 0;
  for (std::uint64_t i = 0; i < 12 && lights < 2; ++i) {
    const StartReplay drawn = replay_start(draws, i, options);
    if (drawn.drawn[0] != 3.0) continue;
    ++lights;
    const StartReplay plain = replay_start(light, i, options);
    EXPECT_EQ(drawn.name, plain.name);
    // R is the same; the peak between steps is accurate to a thousandth.
    EXPECT_NEAR(drawn.transients->peak_radial, plain.transients->peak_radial, 1e-3 * plain.transients->peak_radial);
    const double newton = plain.transients->peak_force * light.scales->force();
    EXPECT_NEAR(drawn.transients->peak_force * draws.scales->force(), newton, 1e-3 * newton);
  }
  EXPECT_GT(lights, 0);
}

TEST(DrawnStarts, AreRefusedUpFrontWhereAnEndCannotBeDecided) {
  const auto message = [](const std::vector<std::string>& overrides) {
    return refusal_text([&] { basin(study_with(overrides)); });
  };
  EXPECT_NE(
      message({"rotor.eccentricity={uniform=[0.0, 0.1]}", "numerics.decide=horizon"}).find("must be \"validated\""),
      std::string::npos);
  EXPECT_NE(message({"balancer.drag={values=[0.1, 0.1, 1e9]}"}).find("with balancer.drag = 1000000000"),
            std::string::npos);
}

TEST(Sensitivity, IsOfTheStartWhereTheRotorHardlyVaries) {
  const Study study = study_with({"rotor.eccentricity={uniform=[0.01, 0.01000000001]}"});
  SensitivityOptions options;
  options.rows = 40;
  options.threads = 1;
  const SensitivityResult one = sensitivity(study, options);
  ASSERT_EQ(one.inputs.size(), 2u);
  EXPECT_EQ(one.inputs[0].key, start_input);
  EXPECT_EQ(one.evaluations, 160u);
  // The draw of the start determines the outcome: in each row's pair the mixed start equals the other one, except for
  // at most one start in a thousand on a boundary.
  EXPECT_NEAR(one.inputs[0].indices.first.value, 1.0, 0.1);
  EXPECT_NEAR(one.inputs[1].indices.total.value, 0.0, 0.1);
  options.threads = 2;
  const SensitivityResult two = sensitivity(study, options);
  EXPECT_EQ(one.inputs[0].indices.total.low, two.inputs[0].indices.total.low);
  EXPECT_EQ(one.balanced.count, two.balanced.count);
}

TEST(Sensitivity, StoppedEarlyIsOfThePrefix) {
  const Study study = study_with({"rotor.eccentricity={uniform=[0.005, 0.015]}"});
  StopFlag stop{true};
  SensitivityOptions options;
  options.stop = &stop;
  const SensitivityResult none = sensitivity(study, options);
  EXPECT_TRUE(none.partial);
  EXPECT_EQ(none.rows, 0u);
  EXPECT_TRUE(none.inputs.empty());
}

TEST(Sensitivity, NeedsSomethingUncertain) { EXPECT_THROW(sensitivity(study_with({})), InputError); }

}  // namespace drawn_starts_test
}  // namespace equipoise
