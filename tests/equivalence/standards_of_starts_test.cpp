// What standards make of an ensemble: shares counted start by start, exposure from single trajectories, and sentences.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/refusals.hpp"
#include "../support/studies.hpp"
#include "equipoise/base/angles.hpp"
#include "equipoise/decision/standards_text.hpp"
#include "equipoise/ensembles/basin.hpp"
#include "equipoise/standards/hand_arm.hpp"
#include "equipoise/standards/severity.hpp"

namespace equipoise {
namespace standards_of_starts_test {

// Ends in several motions: 1500 rpm is 25 Hz.
const std::string machine = R"([rotor]
mass = "4 kg"
stiffness = "10 kN/m"
damping_ratio = 0.25
eccentricity = "0.6 mm"
[balancer]
balls = 2
race_radius = "60 mm"
mass = "200 g"
drag = "1.8e-3 N m s"
[speed]
speed = "1150 rpm"
[sampling]
starts = 400
[standards]
severity_class = "II"
hand_held = true
standing_mass = "9 kg"
friction = 0.4
)";

BasinResult run(const std::string& text, const std::vector<std::string>& overrides = {}) {
  BasinOptions options;
  options.transients = true;
  options.keep_starts = true;
  return basin(parse_study(text, "machine", overrides), options);
}

TEST(StandardsOfStarts, SharesAreThoseCountedStartByStart) {
  const BasinResult r = run(machine);
  const auto& columns = r.every_start->transients;
  std::array<std::uint64_t, 3> within{};
  std::uint64_t slides = 0;
  for (std::size_t i = 0; i < r.starts; ++i) {
    // One direction of a motion on equal supports: half of the mean square.
    const double velocity = 1000.0 * columns[figure_place(&TransientRow::rms_velocity)][i] * r.study.scales->velocity();
    for (std::size_t k = 0; k < 3; ++k)
      within[k] += velocity / std::sqrt(2.0) <= standards::severity_classes[1].boundaries[k];
    slides += columns[figure_place(&TransientRow::peak_force)][i] * r.study.scales->force() > 0.4 * 9.0 * 9.80665;
  }
  const auto json = standards_json(r);
  EXPECT_EQ(json["severity"]["within"]["A"]["count"], within[0]);
  EXPECT_EQ(json["severity"]["within"]["B"]["count"], within[1]);
  EXPECT_EQ(json["severity"]["within"]["C"]["count"], within[2]);
  EXPECT_EQ(json["slides"]["share"]["count"], slides);
  EXPECT_GT(within[0], 0u);
  EXPECT_LT(within[2], r.starts);
}

TEST(StandardsOfStarts, ExposureIsThatOfTheCirclesAcceleration) {
  const BasinResult r = run(machine);
  const TransientGroup& bare = r.without_balls->bare.figures;
  // The bare rotor goes round a circle: r omega^2, weighted.
  const double radius = bare.figure(&TransientRow::peak_radial_at_end).quantiles[0].value * r.study.scales->length;
  const double speed = r.study.speed.speed * r.study.scales->frequency;
  const double expected = standards::hand_arm_weighting(speed / two_pi) * radius * speed * speed;
  const double told = standards_json(r)["hand_arm"]["without_balls"]["acceleration"];
  EXPECT_NEAR(told, expected, 1e-5 * expected);
}

TEST(StandardsOfStarts, SlowRotorsHaveNoZone) {
  const BasinResult r = run(with(machine, "1150 rpm", "590 rpm"));
  EXPECT_TRUE(holds(standards_text(r), "no zone is given"));
  EXPECT_FALSE(standards_json(r).contains("severity"));
  EXPECT_FALSE(holds(standards_text(run(machine)), "no zone is given"));
}

// A rotor alone is judged as the same rotor beside its balls is.
TEST(StandardsOfStarts, JudgeARotorWithoutBallsToo) {
  const auto beside = standards_json(run(machine));
  const BasinResult r = run(machine, {"balancer.balls=0"});
  const auto alone = standards_json(r);
  const std::string text = standards_text(r);
  EXPECT_EQ(alone["severity"]["without_balls"], beside["severity"]["without_balls"]);
  EXPECT_EQ(alone["hand_arm"]["without_balls"], beside["hand_arm"]["without_balls"]);
  EXPECT_EQ(alone["balance_quality"]["without_balls"], beside["balance_quality"]["without_balls"]);
  EXPECT_FALSE(alone["hand_arm"].contains("median"));
  for (const char* words :
       {"Balance quality e omega", "Severity: Without balls: zone", "hand-arm vibration", "may slide"})
    EXPECT_TRUE(holds(text, words)) << words << text;
  for (const char* words : {"of starts", "on average", "90 % below"}) EXPECT_FALSE(holds(text, words)) << words << text;
  // Of an unknown unbalance shares are told.
  const BasinResult drawn = run(machine, {"balancer.balls=0", "rotor.eccentricity={uniform=['0.2 mm', '0.9 mm']}"});
  EXPECT_TRUE(holds(standards_text(drawn), "severity zone")) << standards_text(drawn);
  EXPECT_TRUE(standards_json(drawn)["hand_arm"].contains("at_most_in_90_percent"));
}

TEST(StandardsOfStarts, AreOfMachinesWithUnits) {
  const auto problem = [](const std::string& text) { return refused([&] { parse_study(text, "machine"); }); };
  EXPECT_EQ(problem(constant_speed + "[standards]\nhand_held = true\n").key(), "standards.hand_held");
  EXPECT_EQ(problem(with(machine, "friction = 0.4\n", "")).key(), "standards.standing_mass");
  EXPECT_EQ(problem(with(machine, "\"II\"", "\"V\"")).key(), "standards.severity_class");
  EXPECT_FALSE(holds(standards_text(run(machine.substr(0, machine.find("[standards]")))), "zone"));
}

}  // namespace standards_of_starts_test
}  // namespace equipoise
