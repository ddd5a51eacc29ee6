// What standards make of an ensemble: shares counted start by start, exposure from single trajectories, and sentences.
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/refusals.hpp"
#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/standards/hand_arm.hpp"
#include "equipoise/machine/standards/severity.hpp"
#include "equipoise/report/decision/standards_text.hpp"
#include "equipoise/report/reports/reports.hpp"

namespace equipoise {
namespace standards_of_starts_test {

std::string standards_text(const BasinResult& r) { return document_text({"", standards_blocks(r)}); }

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

// As the program's JSON has it.
Json standards_of(const BasinResult& r) { return judged_by_standards(r); }

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
  const auto json = standards_of(r);
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
  const double told = standards_of(r)["hand_arm"]["without_balls"]["acceleration"];
  EXPECT_NEAR(told, expected, 1e-5 * expected);
}

// Standards mean one direction. Forced vibration in closed form, in X and Y.
TEST(StandardsOfStarts, SeverityIsOfTheDirectionThatHasMore) {
  const auto bare = [](const std::vector<std::string>& overrides) {
    std::vector<std::string> all{"balancer.balls=0"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    return run(machine, all);
  };
  const auto figure = [](const BasinResult& r, float TransientRow::*value) {
    return r.without_balls->bare.figures.figure(value).quantiles[0].value;
  };
  const std::string weight = "rotor.gravity=9.81 m/s2", unequal = "rotor.stiffness=['10 kN/m', '16 kN/m']";
  const double omega = 1150.0 * two_pi / 60.0;
  for (const auto& [overrides, stiffness] : std::vector<std::pair<std::vector<std::string>, std::array<double, 2>>>{
           {{}, {1e4, 1e4}}, {{weight}, {1e4, 1e4}}, {{unequal}, {1e4, 1.6e4}}, {{weight, unequal}, {1e4, 1.6e4}}}) {
    std::array<double, 2> velocity{}, force{};
    for (std::size_t d = 0; d < 2; ++d) {
      const std::complex<double> support(stiffness[d], 0.5 * std::sqrt(stiffness[d] * 4.0) * omega);
      const double amplitude = std::abs(4.0 * 6e-4 * omega * omega / (support - 4.0 * omega * omega));
      velocity[d] = omega * amplitude / std::sqrt(2.0);
      force[d] = std::abs(support) * amplitude / std::sqrt(2.0);
    }
    const BasinResult r = bare(overrides);
    const double one = std::max(velocity[0], velocity[1]), dynamic = std::hypot(force[0], force[1]);
    EXPECT_NEAR(figure(r, &TransientRow::rms_velocity_one_direction) * r.study.scales->velocity(), one, 1e-4 * one);
    EXPECT_NEAR(figure(r, &TransientRow::rms_velocity) * r.study.scales->velocity(),
                std::hypot(velocity[0], velocity[1]), 1e-4 * one);
    EXPECT_NEAR(figure(r, &TransientRow::rms_dynamic_force) * r.study.scales->force(), dynamic, 1e-4 * dynamic);
    const double held = r.study.parameters.gravity > 0.0 ? 4.0 * 9.81 : 0.0;
    EXPECT_NEAR(figure(r, &TransientRow::rms_force) * r.study.scales->force(), std::hypot(dynamic, held),
                1e-4 * (dynamic + held));
    const auto zone = standards::zone_of(standards::severity_classes[1], 1000.0 * one);
    EXPECT_EQ(standards_of(r)["severity"]["without_balls"], standards::zone_names[static_cast<std::size_t>(zone)]);
  }
}

// U_per = G M/omega.
TEST(StandardsOfStarts, PermissibleUnbalanceIsThatOfTheGrade) {
  const double omega = 1150.0 * two_pi / 60.0;
  const auto told = standards_of(run(machine, {"limits.grade=6.3 mm/s"}))["permissible_unbalance"];
  EXPECT_DOUBLE_EQ(told["grade"].get<double>(), 6.3);
  EXPECT_NEAR(told["unbalance"], 6.3e-3 * 4.0 / omega * 1e6, 1e-9);
  const BasinResult r = run(machine);
  const auto met = standards_of(r);
  EXPECT_GE(met["permissible_unbalance"]["unbalance"], met["permissible_unbalance"]["left"]);
  EXPECT_NEAR(met["permissible_unbalance"]["left"].get<double>() * omega / 4.0 * 1e-3,
              met["balance_quality"]["mean"].get<double>(), 1e-6);
  EXPECT_TRUE(holds(standards_text(r), "permits")) << standards_text(r);
}

// Limits of what standards measure count start by start what they say.
TEST(StandardsOfStarts, LimitsOfTheirFiguresAreCounted) {
  const std::vector<std::string> limits{"limits.hand_arm=3 m/s2", "limits.velocity_one_direction=9 mm/s",
                                        "limits.dynamic_force=60 N", "limits.settled=0.5 mm",
                                        "limits.settling_time=1 s"};
  const BasinResult r = run(machine, limits);
  const auto& columns = r.every_start->transients;
  const auto figure = [&](float TransientRow::*value, std::size_t i) { return columns[figure_place(value)][i]; };
  const model::Scales& s = *r.study.scales;
  std::map<std::string, std::uint64_t> counted;
  for (std::size_t i = 0; i < r.starts; ++i) {
    const double velocity = figure(&TransientRow::rms_velocity, i) * s.velocity();
    counted["hand_arm"] += standards::hand_arm_acceleration(1150.0 / 60.0, velocity) > 3.0;
    counted["velocity_one_direction"] += figure(&TransientRow::rms_velocity_one_direction, i) * s.velocity() > 9e-3;
    counted["dynamic_force"] += figure(&TransientRow::peak_dynamic_force, i) * s.force() > 60.0;
    counted["settling_time"] += figure(&TransientRow::settling_time, i) * s.time() > 1.0;
  }
  const auto exceeded = nlohmann::json::parse(json_text(r))["transients"]["groups"][0]["exceeded"];
  for (const auto& [name, count] : counted) {
    EXPECT_EQ(exceeded[name]["count"], count) << name;
    EXPECT_TRUE(0 < count && count < r.starts) << name << " " << count;
  }
  EXPECT_EQ(refused([] { parse_study(machine, "m", {"limits.settling_time=1 s"}); }).key(), "limits.settling_time");
  EXPECT_EQ(refused([] { parse_study(constant_speed + "[limits]\nhand_arm = 1.0\n", "m"); }).key(), "limits.hand_arm");
}

TEST(StandardsOfStarts, SlowRotorsHaveNoZone) {
  const BasinResult r = run(with(machine, "1150 rpm", "590 rpm"));
  EXPECT_TRUE(holds(standards_text(r), "no zone is given"));
  EXPECT_FALSE(standards_of(r).contains("severity"));
  EXPECT_FALSE(holds(standards_text(run(machine)), "no zone is given"));
}

// A rotor alone is judged as the same rotor next to its balls is.
TEST(StandardsOfStarts, JudgeARotorWithoutBallsToo) {
  const auto beside = standards_of(run(machine));
  const BasinResult r = run(machine, {"balancer.balls=0"});
  const auto alone = standards_of(r);
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
  EXPECT_TRUE(standards_of(drawn)["hand_arm"].contains("at_most_in_90_percent"));
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
