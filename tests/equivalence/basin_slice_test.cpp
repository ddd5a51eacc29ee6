// Basin slices: bit-identical for any threads; pixels against single long trajectories; limits of balance, errors, file
// and picture.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/analyses/basin_slices/line_motions.hpp"
#include "equipoise/analyses/basin_slices/start_pixels.hpp"
#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/result_files/slice_file.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "../support/refusals.hpp"
#include "../support/files.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace basin_slice_test {

Study rotor() {
  return parse_study(constant_speed + R"([initial]
phi = [-1.5707963267948966, 1.5707963267948966]
)",
                     "rotor");
}

// Eccentricity and one angle, the other ball opposite: pixels of a column share their rotor.
BasinSliceSettings angle_plane(int columns, int rows) {
  BasinSliceSettings s;
  s.x = {"rotor.eccentricity", 0.0, 0.12, columns};
  s.y = {"initial.phi_1", 0.0, two_pi, rows};
  s.links = {{2, 1, pi}};
  return s;
}

// Long enough to tell one another what their pixels come to, of which the mesh lists a part.
BasinSliceSettings captured_lines() {
  BasinSliceSettings s = angle_plane(2, 32);
  s.x.low = 0.0462;
  s.x.high = 0.0470;
  return s;
}

// Eccentricity and mass: every pixel has its own rotor.
BasinSliceSettings mass_plane(int columns, int rows) {
  BasinSliceSettings s;
  s.x = {"rotor.eccentricity", 0.0, 0.1, columns};
  s.y = {"balancer.mass", 0.0, 0.1, rows};
  return s;
}

// Two rotors so alike that the motions of few others have to be found.
BasinSliceSettings two_rotors() {
  BasinSliceSettings s = mass_plane(2, 1);
  s.x.low = 0.010;
  s.x.high = 0.012;
  s.y.low = 0.050;
  s.y.high = 0.052;
  return s;
}

// Every pixel is a start of one rotor: these share lanes.
BasinSliceSettings both_angles(int columns, int rows) {
  BasinSliceSettings s;
  s.x = {"initial.phi_1", 0.0, two_pi, columns};
  s.y = {"initial.phi_2", 0.0, two_pi, rows};
  return s;
}

Study pixel(const BasinSlice& map, int column, int row) {
  Study study = study_with(map.study, map.x.key, map.x.centre(column));
  study = study_with(study, map.y.key, map.y.centre(row));
  for (const AngleLink& link : map.links)
    study.initial.phi[link.ball - 1] = study.initial.phi[link.of - 1] + link.offset;
  return study;
}

std::string name_of(const BasinSlice& map, std::size_t at) {
  for (const OutcomeShare& c : map.codes)
    if (c.id == map.code[at]) return c.name;
  return "";
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
  });
}

TEST(BasinSlice, SameBitsForAnyNumberOfThreads) {
  for (BasinSliceSettings settings : {captured_lines(), two_rotors(), both_angles(40, 30)}) {
    settings.threads = 1;
    const BasinSlice one = basin_slice(rotor(), settings);
    settings.threads = 3;
    const BasinSlice three = basin_slice(rotor(), settings);
    EXPECT_EQ(one.code, three.code);
    EXPECT_TRUE(same_bits(one.time, three.time));
    EXPECT_TRUE(same_bits(one.r_max, three.r_max));
    EXPECT_TRUE(same_bits(one.balance_growth, three.balance_growth));
    EXPECT_TRUE(one.complete);
  }
}

TEST(BasinSlice, PixelsComeToWhatTheirTrajectoriesComeToAlone) {
  for (const BasinSliceSettings& settings : {angle_plane(2, 5), mass_plane(4, 3), both_angles(6, 6)}) {
    const BasinSlice map = basin_slice(rotor(), settings);
    for (int row = 0; row < map.y.pixels; ++row)
      for (int column = 0; column < map.x.pixels; ++column) {
        const Study study = pixel(map, column, row);
        const auto alone =
            motion_from({study.parameters, 2.4}, model::centred_state(study.parameters, study.initial.phi.data()),
                        *study.numerics.horizon);
        const std::size_t at = map.at(column, row);
        // A motion not recognised alone by the horizon may be chaos, which windows can tell.
        if (alone || name_of(map, at).find("chaotic") == std::string::npos) {
          const std::string name = alone ? motion_name(study.parameters, *alone).name : "undecided";
          EXPECT_EQ(name_of(map, at), name) << column << ", " << row;
        }
        // Orbits are refined to 1e-11; tori and chaos are measured. For rotors that differ the last window decides: it
        // is trusted once windows agree to 2 % (ClassificationRule::sameness), while a remainder may still be dying
        // out. Next to a period doubling 1.2 % was measured.
        if (alone && alone->kind <= MotionKind::periodic) {
          const double tolerance = maps_starts(map) ? 1e-8 : 0.02 * alone->r_max + 1e-8;
          EXPECT_NEAR(map.r_max[at], alone->r_max, tolerance) << column << ", " << row;
        }
      }
  }
}

// Some motors reach their speed, some hang below it.
BasinSlice motors() {
  const Study study = parse_study(
      "[rotor]\neccentricity = 0.05\ndamping = 0.1\ninertia = 0.5\n"
      "[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n"
      "[speed]\nprofile = \"torque\"\ntorque = { stall = 0.1, no_load_speed = 3.0 }\n"
      "[initial]\nphi = [1.0, 4.0]\n",
      "motor");
  BasinSliceSettings s;
  s.x = {"rotor.eccentricity", 0.01, 0.07, 3};
  s.y = {"speed.torque.stall", 0.002, 0.05, 3};
  return basin_slice(study, s);
}

// The last tenth of a trajectory three times as long as the slice's horizon, at a thousandth of its tolerance.
double r_max_after_long(Study study) {
  study.numerics.tolerance = 1e-12;
  std::vector<double> times;
  for (double t = 8100.0; t < 9000.0; t += 0.1) times.push_back(t);
  const Trajectory trajectory = simulate(study, times);
  return *std::max_element(trajectory.radial.begin(), trajectory.radial.end());
}

// Compares the pixels whose largest r is a number; returns how many. `slack`: what has not died out by then.
int compare_with_long(const BasinSlice& map, double slack) {
  // Samples 0.1 apart miss a peak of angular frequency 3 by 1 - cos(0.15) = 1.1 % at most.
  constexpr double tolerance = 0.012;
  int compared = 0;
  for (int row = 0; row < map.y.pixels; ++row)
    for (int column = 0; column < map.x.pixels; ++column) {
      const std::size_t at = map.at(column, row);
      if (map.code[at] <= 0 || name_of(map, at).find("chaotic") != std::string::npos) continue;
      const double expected = map.r_max[at];
      const auto agrees = [&](double r) { return std::fabs(r - expected) < tolerance * expected + slack; };
      Study study = pixel(map, column, row);
      const double r = r_max_after_long(study);
      ++compared;
      if (agrees(r)) continue;
      // Next to a boundary of basins the last digits decide; neighbours show what the outcome may be.
      bool beside = false, one_agrees = false;
      for (const double aside : {-1e-6, 1e-6, -1e-5, 1e-5}) {
        study.initial.phi[0] += aside;
        const double neighbour = r_max_after_long(study);
        study.initial.phi[0] -= aside;
        beside = beside || std::fabs(neighbour - r) > tolerance * r + slack;
        one_agrees = one_agrees || agrees(neighbour);
      }
      EXPECT_TRUE(beside && one_agrees) << name_of(map, at) << " at " << column << ", " << row << ": " << expected
                                        << " in place of " << r;
    }
  return compared;
}

// What some pixels of a line come to names the others. That saves work and must not change what is found. Here a motion
// that the mesh does not list takes a third of every column.
TEST(BasinSlice, WhatPixelsOfALineTellOneAnotherIsWhatTheyComeToAlone) {
  BasinSliceSettings settings = angle_plane(2, 64);
  settings.x.low = 0.0462;
  settings.x.high = 0.0470;
  const BasinSlice together = basin_slice(rotor(), settings);
  for (int column = 0; column < 2; ++column) {
    BasinSliceSettings line = both_angles(1, 64);  // starts of one rotor: its own search lists its motions
    line.x = {"initial.phi_dot_1", -0.001, 0.001, 1};
    line.y = settings.y;
    line.links = settings.links;
    const BasinSlice alone = basin_slice(study_with(rotor(), settings.x.key, settings.x.centre(column)), line);
    for (int row = 0; row < 64; ++row)
      EXPECT_EQ(name_of(together, together.at(column, row)), name_of(alone, alone.at(0, row))) << column << ", " << row;
  }
}

// Two columns of 64 pixels, eccentricity and one angle, and a runner for them.
struct Lines {
  Lines(double low, double high)
      : map(plane(low, high)), family(range(low, high)), runner(map.study, family, {128.0, 2.0}, {}) {}

  static BasinSlice plane(double low, double high) {
    BasinSlice map;
    map.study = with_horizon(rotor());
    map.x = {"rotor.eccentricity", low, high, 2};
    map.y = {"initial.phi_1", 0.0, two_pi, 64};
    map.threads = 2;
    return map;
  }
  StudyFamily range(double low, double high) const {
    return {{{[=](double f) { return (1.0 - f) * low + f * high; }}},
            [study = map.study](std::span<const double> v) { return study_with(study, "rotor.eccentricity", v[0]); }};
  }
  FamilyStart start(std::uint32_t position) const {
    const double value = map.x.centre(static_cast<int>(position % 2)), angle = two_pi * (position / 2u) / map.y.pixels;
    FamilyStart s;
    s.own.study = family.at(std::vector{value});
    s.own.study.initial.phi = {angle, angle + pi};
    s.own.start = s.own.study.initial;
    s.fractions = {(value - map.x.low) / (map.x.high - map.x.low)};
    return s;
  }
  bool look_along(LineMotions& lines, const RunOptions& options = {}) const {
    return lines.look_along(
        {0, 1}, [&](std::uint32_t position) { return start(position); }, options);
  }

  const BasinSlice map;
  const StudyFamily family;
  const Session runner;
};

// The mesh for these starts misses balls captured in different ways.
TEST(BasinSlice, LooksAlongLinesThatAreLongEnoughToPay) {
  EXPECT_FALSE(LineMotions::pays(31));
  EXPECT_TRUE(LineMotions::pays(32));
  const Lines captured(0.0462, 0.0470);
  LineMotions lines(captured.map, true, captured.runner, nullptr);
  EXPECT_TRUE(captured.look_along(lines));
  for (const std::uint32_t position : {0u, 1u}) {
    ASSERT_FALSE(lines.at(position).motions.empty());
    for (const Motion& motion : lines.at(position).motions)
      EXPECT_EQ(motion_name(captured.start(position).own.study.parameters, motion).name, "both captured");
  }
  StopFlag stop{true};
  RunOptions stopped;
  stopped.stop = &stop;
  LineMotions none(captured.map, true, captured.runner, nullptr);
  EXPECT_FALSE(captured.look_along(none, stopped));
}

// At small eccentricity balance comes slowly but surely; at 0.0705 most starts are chaotic long after the horizon.
TEST(BasinSlice, FollowsOnBeyondTheHorizonWhereALineComesToSomething) {
  for (const auto& [eccentricity, comes] : {std::pair{0.0010, true}, {0.0705, false}}) {
    const Lines line(eccentricity, eccentricity + 1e-6);
    LineMotions lines(line.map, true, line.runner, nullptr);
    EXPECT_TRUE(line.look_along(lines));
    EXPECT_EQ(lines.at(0).follows_open, comes) << eccentricity;
    EXPECT_EQ(lines.at(1).follows_open, comes) << eccentricity;
  }
}

TEST(BasinSlice, LongAccurateTrajectoriesShakeAsTheMapSays) {
  int compared = 0;
  for (const BasinSliceSettings& settings : {angle_plane(4, 3), mass_plane(4, 3), both_angles(3, 3)})
    // Balance within 1 % of losing its stability is still 1e-6 away by then.
    compared += compare_with_long(basin_slice(rotor(), settings), 1e-5);
  EXPECT_GE(compared, 16);
}

// Two cycles share a name here, and balls that are captured slowly are caught on their way. A polynomial fitted to the
// largest r of one of them told of both, down to -0.01.
TEST(BasinSlice, ShakesAsItsOwnPixelsDoWhereTwoMotionsShareAName) {
  const Study study = parse_study(
      "[rotor]\neccentricity = 0.05\ndamping = 0.3\n[balancer]\nballs = 2\nmass = 0.03\ndrag = 0.04\n"
      "[speed]\nprofile = \"constant\"\nspeed = 2.4\n[initial]\nphi = [0.5, 2.0]\n",
      "captured");
  BasinSliceSettings settings;
  settings.x = {"rotor.eccentricity", 0.045, 0.055, 6};
  settings.y = {"initial.phi_1", 0.0, two_pi, 6};
  const BasinSlice map = basin_slice(study, settings);
  EXPECT_GE(compare_with_long(map, 1e-5), 30);
  std::set<bool> small;
  for (std::size_t k = 0; k < map.code.size(); ++k)
    if (map.code[k] > balanced_id) {
      EXPECT_GT(map.r_max[k], 0.0f) << k;  // and none is missing
      small.insert(map.r_max[k] < 0.02f);
    }
  EXPECT_EQ(small.size(), 2u);
}

TEST(BasinSlice, OfMotorsShakesAsLongAccurateTrajectories) {
  const BasinSlice map = motors();
  // Under a weak motor a slow approach is still 1e-4 away at 9000.
  EXPECT_GE(compare_with_long(map, 1e-4), 6);
  std::set<std::string> names;
  for (int row = 0; row < map.y.pixels; ++row)
    for (int column = 0; column < map.x.pixels; ++column) names.insert(name_of(map, map.at(column, row)));
  EXPECT_TRUE(names.contains("balanced"));
  EXPECT_GE(names.size(), 2u);  // and captured at resonance
}

void counts_every_pixel_once(const BasinSlice& map) {
  std::uint64_t sum = 0;
  std::set<short> codes;
  for (const OutcomeShare& c : map.codes) {
    sum += c.share.count;
    EXPECT_TRUE(codes.insert(c.id).second);
    if (c.id > 0) {
      EXPECT_GT(c.share.count, 0u);
    }
  }
  EXPECT_EQ(sum, map.code.size());
  for (std::size_t k = 0; k < map.code.size(); ++k) EXPECT_TRUE(map.code[k] > 0 || std::isnan(map.r_max[k]));
}

void holds_in_its_file_what_it_holds(const BasinSlice& map) {
  const std::string path = testing::TempDir() + "basin_slice_test.nc";
  write_map_file(path, map);
  const io::NetcdfFile file(path, io::NetcdfFile::Mode::read);
  EXPECT_EQ(file.length("x"), 4u);
  EXPECT_EQ(file.length("y"), 3u);
  EXPECT_EQ(file.length("outcome_kind"), map.codes.size());
  std::vector<short> codes(12);
  file.read(file.variable("outcome"), {0, 0}, {3, 4}, codes.data());
  EXPECT_EQ(codes, map.code);
  std::vector<float> r_max(12);
  std::vector<double> x(4);
  file.read(file.variable("r_max"), {0, 0}, {3, 4}, r_max.data());
  EXPECT_TRUE(same_bits(r_max, map.r_max));
  file.read(file.variable("x"), {0}, {4}, x.data());
  EXPECT_EQ(x[3], map.x.centre(3));
  EXPECT_EQ(file.lines("study"), to_toml(map.study));
  std::filesystem::remove(path);
}

void names_in_its_picture_what_it_shows(const BasinSlice& map) {
  const std::string picture = result_svg(map, "Where the rotor ends");
  for (const OutcomeShare& c : map.codes)
    EXPECT_EQ(picture.find(">" + (c.alias.empty() ? "" : c.alias + ": ") + c.name + ",") != picture.npos,
              c.share.count > 0);
  for (const char* words : {"balance ceases to exist", "eccentricity λ", "μ"})
    EXPECT_NE(picture.find(words), picture.npos) << words;
}

// One map of rotors that all differ: each has a search of its own, so what holds of a map is asked of one.
TEST(BasinSlice, MarksWhereBalanceExistsAndIsStableCountsEveryPixelOnceIsStoredAndDrawn) {
  const BasinSlice map = basin_slice(rotor(), mass_plane(4, 3));
  for (int row = 0; row < map.y.pixels; ++row)
    for (int column = 0; column < map.x.pixels; ++column) {
      const std::size_t at = map.at(column, row);
      const double lambda = map.x.centre(column), mu = map.y.centre(row);
      EXPECT_EQ(map.balance_margin[at] >= 0.0, lambda <= 2.0 * mu);
      EXPECT_EQ(std::isfinite(map.balance_growth[at]), lambda <= 2.0 * mu);
      if (map.code[at] == balanced_id) {
        EXPECT_LT(map.balance_growth[at], 0.0);
      }
    }
  counts_every_pixel_once(map);
  holds_in_its_file_what_it_holds(map);
  names_in_its_picture_what_it_shows(map);
}

TEST(BasinSlice, KnowsHowFastBalanceIsApproached) {
  BasinSliceSettings one = angle_plane(1, 1);
  one.x = {"rotor.eccentricity", 0.00999, 0.01001, 1};  // one pixel at 0.01
  // The slowest eigenvalue of the balanced state.
  EXPECT_NEAR(basin_slice(rotor(), one).balance_growth[0], -0.02406, 1e-5);
}

// A grid of pixels is also a sample of starts: where its boundary is fractal, a random one.
TEST(BasinSlice, OverBothAnglesHasTheSharesOfBasin) {
  const BasinSlice map = basin_slice(rotor(), both_angles(128, 128));
  ASSERT_EQ(map.codes.front().id, balanced_id);
  // 60.40 %, known to 0.1 %; 16 384 random pixels have an error of 0.4 %.
  EXPECT_NEAR(map.codes.front().share.share, 0.604, 0.012);
  // Of two balls in one place all end co-drifting; random starts have 3.91 %.
  EXPECT_EQ(map.pixels_left_out, 128u);
  EXPECT_EQ(map.codes[1].name, "co-drifting");
  EXPECT_NEAR(map.codes[1].share.share, 0.0391, 0.004);
}

// Planes of initial values use lanes, others do not: the same starts must end the same way.
TEST(BasinSlice, LanesAndSingleTrajectoriesAgree) {
  BasinSliceSettings moved = both_angles(5, 5), turning = moved;
  moved.x = {"initial.x", -0.2, 0.2, 5};
  turning.x = {"initial.phi_dot_1", -1.0, 1.0, 5};
  for (const BasinSliceSettings& settings : {both_angles(5, 5), moved, turning}) {
    const BasinSlice lanes = basin_slice(rotor(), settings);
    for (int column : {0, 2, 3}) {
      BasinSliceSettings line = settings;
      line.x = {"rotor.eccentricity", 0.00999, 0.01001, 1};
      const BasinSlice single = basin_slice(study_with(rotor(), settings.x.key, settings.x.centre(column)), line);
      for (int row = 0; row < 5; ++row)
        EXPECT_EQ(name_of(lanes, lanes.at(column, row)), name_of(single, single.at(0, row)))
            << settings.x.key << " " << column << ", " << row;
    }
  }
}

// A study that says nothing of its balls, with rotors that hardly differ between pixels.
BasinSliceSettings one_rotor(int columns, int rows) {
  BasinSliceSettings s;
  s.x = {"rotor.eccentricity", 0.00999, 0.01001, columns};
  s.y = {"balancer.drag", 0.0499, 0.0501, rows};
  return s;
}

// Balls that all pixels start in one place never part there, and represent no other starts.
TEST(BasinSlice, OverParametersDrawsAStartAtEveryPixel) {
  const BasinSlice map = basin_slice(parse_study(constant_speed, "rotor"), one_rotor(24, 20));
  EXPECT_TRUE(draws_starts(map));
  // Shares of the rotor between: 60.4 % balanced, 3.9 % co-drifting; four standard errors of 480 random starts.
  for (const OutcomeShare& c : map.codes) {
    if (c.name == "balanced") {
      EXPECT_NEAR(c.share.share, 0.604, 4.0 * 0.0223);
    } else if (c.name == "co-drifting") {
      EXPECT_NEAR(c.share.share, 0.039, 4.0 * 0.0088);
    }
  }
  EXPECT_FALSE(map.figures.basin_entropy || map.figures.box_dimension);  // they would only show chance
}

TEST(BasinSlice, DrawsStartsBySeedAndPixel) {
  const Study study = parse_study(constant_speed, "rotor", {"sampling.seed=7"});
  const BasinSlice map = basin_slice(study, one_rotor(4, 3));
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      Study here = pixel(map, column, row);
      here.initial = start_of(study, 7, static_cast<std::uint64_t>(4 * row + column));
      const auto alone =
          motion_from({here.parameters, 2.4}, model::centred_state(here.parameters, here.initial.phi.data()), 3000.0);
      ASSERT_TRUE(alone);
      EXPECT_EQ(name_of(map, map.at(column, row)), motion_name(here.parameters, *alone).name);
    }
  EXPECT_NE(basin_slice(parse_study(constant_speed, "rotor"), one_rotor(4, 3)).code, map.code);
}

TEST(BasinSlice, TakesOneStartWhereItIsStatedOrVaried) {
  BasinSlice map;
  map.x.key = "rotor.eccentricity";
  map.y.key = "balancer.drag";
  map.study = parse_study(constant_speed, "rotor", {"initial.phi=[1.0, 1.0]"});
  EXPECT_FALSE(draws_starts(map));
  // Stated, even if it is the default.
  map.study = parse_study(constant_speed, "rotor", {"initial.phi=[0.0, 3.14159265358979323846]"});
  EXPECT_FALSE(draws_starts(map));
  map.study = parse_study(constant_speed, "rotor");
  EXPECT_TRUE(draws_starts(map));
  map.study.initial.phi[0] = 1.0;  // set by code
  EXPECT_FALSE(draws_starts(map));
  map.study = parse_study(constant_speed, "rotor");
  map.y.key = "initial.phi_1";
  EXPECT_FALSE(draws_starts(map));
}

// Its balls are free because it says nothing of them.
TEST(BasinSlice, VariesTheReleaseOfAMachine) {
  const Study machine =
      parse_study(machine_rotor + "[speed]\nprofile=\"ramp\"\nfinal=\"2000 rpm\"\nduration=\"5 s\"\n", "machine");
  EXPECT_EQ(machine.release_time(), 0.0);
  EXPECT_EQ(study_with(machine, "release.speed", 1.0).release.speed, 1.0);
  const Study again = study_with(study_with(machine, "release.speed", 1.0), "release.time", 7.0);
  EXPECT_EQ(again.release_time(), 7.0);
}

TEST(BasinSlice, RefusesGroundsOfDecisionThatItHasNot) {
  const Study study = parse_study(constant_speed, "rotor", {"numerics.decide=horizon", "numerics.horizon=50"});
  EXPECT_THROW(basin_slice(study, one_rotor(2, 2)), InputError);
  EXPECT_NO_THROW(basin_slice(study, both_angles(2, 2)));
}

TEST(BasinSlice, StopsWhenAsked) {
  StopFlag stop{true};
  BasinSliceSettings settings = mass_plane(4, 4);
  settings.stop = &stop;
  const BasinSlice map = basin_slice(rotor(), settings);
  EXPECT_FALSE(map.complete);
  EXPECT_EQ(std::count(map.code.begin(), map.code.end(), not_computed_code), 16);
}

TEST(BasinSlice, ErrorsNameTheKey) {
  const auto key_of_error = [](const BasinSliceSettings& settings) {
    return refused_key([&] { basin_slice(rotor(), settings); });
  };
  BasinSliceSettings s = mass_plane(2, 2);
  s.y.key = "balancer.mas";
  EXPECT_EQ(key_of_error(s), "balancer.mas");
  s = mass_plane(2, 2);
  s.y.key = s.x.key;
  EXPECT_EQ(key_of_error(s), "rotor.eccentricity");
  s = mass_plane(2, 2);
  s.y.low = -1.0;
  EXPECT_EQ(key_of_error(s), "balancer.mass");
  s = mass_plane(0, 2);
  EXPECT_EQ(key_of_error(s), "rotor.eccentricity");
  s = angle_plane(2, 2);
  s.links = {{3, 1, 0.0}};
  EXPECT_EQ(key_of_error(s), "links");
  s.links = {{1, 2, 0.0}};  // the axis would have no effect
  EXPECT_EQ(key_of_error(s), "links");
  s.links = {{2, 1, 0.0}, {2, 1, 1.0}};
  EXPECT_EQ(key_of_error(s), "links");
}

// Ctrl-C after a few pixels, again and again: the kept parts lead to the same file as an undisturbed run.
TEST(BasinSlice, StoppedAndResumedItLeavesTheSameFile) {
  for (BasinSliceSettings settings : {both_angles(40, 35), two_rotors(), captured_lines()}) {
    settings.output = scratch_file("undisturbed.nc");
    const BasinSlice whole = basin_slice(rotor(), settings);
    EXPECT_TRUE(whole.complete);
    const std::string expected = content(settings.output);
    settings.output = scratch_file("resumed.nc");
    BasinSlice map;
    std::uint64_t kept = 0;
    for (int run = 0; run < 40 && (run == 0 || !map.complete); ++run) {
      StopFlag stop{false};
      settings.stop = &stop;
      settings.progress = [&](const Progress& p) {
        if (!p.preparing && p.done > kept + whole.pixels / 3) stop = true;
      };
      map = basin_slice(rotor(), settings);
      EXPECT_EQ(map.pixels_kept, kept);
      kept = map.pixels_computed;
    }
    EXPECT_TRUE(map.complete);
    EXPECT_EQ(kept, whole.pixels_computed);
    EXPECT_EQ(content(settings.output), expected) << settings.x.key;
    EXPECT_FALSE(std::filesystem::exists(settings.output + ".part"));
    EXPECT_EQ(map.code, whole.code);
  }
}

TEST(BasinSlice, AFinishedOneIsReadAndAnotherIsRefused) {
  BasinSliceSettings settings = both_angles(30, 20);
  settings.output = scratch_file("finished.nc");
  const BasinSlice map = basin_slice(rotor(), settings), again = basin_slice(rotor(), settings);
  EXPECT_TRUE(again.read_whole);
  EXPECT_EQ(again.code, map.code);
  EXPECT_TRUE(same_bits(again.time, map.time));
  EXPECT_TRUE(same_bits(again.r_max, map.r_max));
  EXPECT_EQ(again.pixels_computed, map.pixels_computed);
  EXPECT_EQ(again.figures.basin_entropy.has_value(), map.figures.basin_entropy.has_value());
  const auto refusal = [](const Study& study, const BasinSliceSettings& s) {
    return refusal_text([&] { basin_slice(study, s); });
  };
  const std::string before = content(settings.output);
  BasinSliceSettings other = settings;
  other.x.pixels = 31;
  EXPECT_NE(refusal(rotor(), other).find("x_range is 0 to"), std::string::npos) << refusal(rotor(), other);
  EXPECT_NE(refusal(study_with(rotor(), "balancer.drag", 0.06), settings).find("drag"), std::string::npos);
  EXPECT_EQ(content(settings.output), before);
  std::ofstream(settings.output, std::ios::binary) << before.substr(0, before.size() - 5);
  EXPECT_NE(refusal(rotor(), settings).find("finished.nc"), std::string::npos);
}

TEST(BasinSlice, LargeOnesNeedAFile) { EXPECT_THROW(basin_slice(rotor(), both_angles(8192, 8192)), InputError); }

}  // namespace basin_slice_test
}  // namespace equipoise
