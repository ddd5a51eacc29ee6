// Plane maps: the same bits whatever the threads, pixels against trajectories followed alone and long, borders of
// balance, errors, file and picture.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/branches/parameter_line.hpp"
#include "equipoise/drawing/map_plot.hpp"
#include "equipoise/files/netcdf.hpp"
#include "equipoise/maps/plane_map.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/motions/motion.hpp"
#include "equipoise/store/basin_file.hpp"
#include "equipoise/store/map_file.hpp"
#include "equipoise/trajectory/simulate.hpp"
#include "../base_study.hpp"

namespace equipoise {
namespace {

Study rotor() {
  return parse_study(constant_speed + R"([initial]
phi = [-1.5707963267948966, 1.5707963267948966]
)",
                     "rotor");
}

// Eccentricity and one angle, the other ball opposite: pixels of a column share their rotor.
PlaneMapSettings angle_plane(int columns, int rows) {
  PlaneMapSettings s;
  s.x = {"rotor.eccentricity", 0.0, 0.12, columns};
  s.y = {"initial.phi_1", 0.0, two_pi, rows};
  s.links = {{2, 1, pi}};
  return s;
}

// Eccentricity and mass: every pixel has a rotor of its own.
PlaneMapSettings mass_plane(int columns, int rows) {
  PlaneMapSettings s;
  s.x = {"rotor.eccentricity", 0.0, 0.1, columns};
  s.y = {"balancer.mass", 0.0, 0.1, rows};
  return s;
}

// Every pixel a start of one rotor: these go together on lanes.
PlaneMapSettings both_angles(int columns, int rows) {
  PlaneMapSettings s;
  s.x = {"initial.phi_1", 0.0, two_pi, columns};
  s.y = {"initial.phi_2", 0.0, two_pi, rows};
  return s;
}

Study pixel(const PlaneMap& map, int column, int row) {
  Study study = study_with(map.study, map.x.key, map.x.centre(column));
  study = study_with(study, map.y.key, map.y.centre(row));
  for (const AngleLink& link : map.links)
    study.initial.phi[link.ball - 1] = study.initial.phi[link.of - 1] + link.offset;
  return study;
}

std::string name_of(const PlaneMap& map, std::size_t at) {
  for (const MapCode& c : map.codes)
    if (c.code == map.code[at]) return c.name;
  return "";
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

TEST(PlaneMap, SameBitsForAnyNumberOfThreads) {
  for (PlaneMapSettings settings : {angle_plane(3, 6), mass_plane(4, 4), both_angles(40, 30)}) {
    settings.threads = 1;
    const PlaneMap one = plane_map(rotor(), settings);
    settings.threads = 3;
    const PlaneMap three = plane_map(rotor(), settings);
    EXPECT_EQ(one.code, three.code);
    EXPECT_TRUE(same_bits(one.time, three.time));
    EXPECT_TRUE(same_bits(one.r_max, three.r_max));
    EXPECT_TRUE(same_bits(one.balance_growth, three.balance_growth));
    EXPECT_TRUE(one.complete);
  }
}

// What the pixels of a line tell one another saves work and must not change what is found.
TEST(PlaneMap, PixelsComeToWhatTheirTrajectoriesComeToAlone) {
  for (const PlaneMapSettings& settings : {angle_plane(4, 5), mass_plane(4, 4), both_angles(6, 6)}) {
    const PlaneMap map = plane_map(rotor(), settings);
    for (int row = 0; row < map.y.pixels; ++row)
      for (int column = 0; column < map.x.pixels; ++column) {
        const Study study = pixel(map, column, row);
        const auto alone =
            motion_from({study.parameters, 2.4}, model::centred_state(study.parameters, study.initial.phi.data()),
                        *study.numerics.horizon);
        const std::size_t at = map.at(column, row);
        const std::string name = alone ? motion_name(study.parameters, *alone).name : "undecided";
        EXPECT_EQ(name_of(map, at), name) << column << ", " << row;
        // Orbits are refined to 1e-11; tori and chaos are measured.
        if (alone && alone->kind <= MotionKind::periodic) {
          EXPECT_NEAR(map.r_max[at], alone->r_max, 1e-8) << column << ", " << row;
        }
      }
  }
}

// Some motors come to their speed, some hang below it.
PlaneMap motors() {
  const Study study = parse_study(
      "[rotor]\neccentricity = 0.05\ndamping = 0.1\ninertia = 0.5\n"
      "[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n"
      "[speed]\nprofile = \"torque\"\ntorque = { stall = 0.1, no_load_speed = 3.0 }\n"
      "[initial]\nphi = [1.0, 4.0]\n",
      "motor");
  PlaneMapSettings s;
  s.x = {"rotor.eccentricity", 0.01, 0.07, 3};
  s.y = {"speed.torque.stall", 0.002, 0.05, 3};
  return plane_map(study, s);
}

// The last tenth of a trajectory three times as long as the map's horizon, at a thousandth of its tolerance.
double r_max_after_long(Study study) {
  study.numerics.tolerance = 1e-12;
  std::vector<double> times;
  for (double t = 8100.0; t < 9000.0; t += 0.1) times.push_back(t);
  const Trajectory trajectory = simulate(study, times);
  return *std::max_element(trajectory.radial.begin(), trajectory.radial.end());
}

TEST(PlaneMap, LongAccurateTrajectoriesShakeAsTheMapSays) {
  int compared = 0;
  for (const PlaneMapSettings& settings : {angle_plane(4, 3), mass_plane(4, 3), both_angles(3, 3)}) {
    const PlaneMap map = plane_map(rotor(), settings);
    for (int row = 0; row < map.y.pixels; ++row)
      for (int column = 0; column < map.x.pixels; ++column) {
        const std::string name = name_of(map, map.at(column, row));
        if (name == "undecided" || name.find("chaotic") != name.npos) continue;  // no number to compare
        // Balance within 1 % of losing its stability is still 1e-6 away by then. Samples 0.1 apart miss a peak of
        // angular frequency 3 by 1 - cos(0.15) = 1.1 % at most.
        const double expected = map.r_max[map.at(column, row)];
        EXPECT_NEAR(r_max_after_long(pixel(map, column, row)), expected, 0.012 * expected + 1e-5)
            << name << " at " << column << ", " << row;
        ++compared;
      }
  }
  EXPECT_GE(compared, 16);
}

TEST(PlaneMap, OfMotorsShakesAsLongAccurateTrajectories) {
  const PlaneMap map = motors();
  std::set<std::string> names;
  for (int row = 0; row < map.y.pixels; ++row)
    for (int column = 0; column < map.x.pixels; ++column) {
      const std::size_t at = map.at(column, row);
      const std::string name = name_of(map, at);
      names.insert(name);
      if (name == "undecided" || name.find("chaotic") != name.npos) continue;  // no number to compare
      // As above; what a weak motor lets approach slowly is at 9000 still 1e-4 away.
      EXPECT_NEAR(r_max_after_long(pixel(map, column, row)), map.r_max[at], 0.012 * map.r_max[at] + 1e-4)
          << name << " at " << column << ", " << row;
    }
  EXPECT_TRUE(names.contains("balanced"));
  EXPECT_GE(names.size(), 2u);  // and captured at resonance
}

TEST(PlaneMap, MarksWhereBalanceExistsAndIsStable) {
  const PlaneMap map = plane_map(rotor(), mass_plane(5, 4));
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
  PlaneMapSettings one = angle_plane(1, 1);
  one.x = {"rotor.eccentricity", 0.005, 0.015, 1};  // one pixel at 0.01
  // Published eigenvalues of the balanced state, here to the digits that docs/numerics.md gives.
  EXPECT_NEAR(plane_map(rotor(), one).balance_growth[0], -0.02406, 1e-5);
}

TEST(PlaneMap, CountsEveryPixelOnce) {
  const PlaneMap map = plane_map(rotor(), angle_plane(3, 3));
  std::uint64_t sum = 0;
  std::set<short> codes;
  for (const MapCode& c : map.codes) {
    sum += c.share.count;
    EXPECT_TRUE(codes.insert(c.code).second);
    if (c.code > 0) {
      EXPECT_GT(c.share.count, 0u);
    }
  }
  EXPECT_EQ(sum, 9u);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(map.code[k] > 0, std::isfinite(map.r_max[k]));
}

// A grid of pixels is a sample of starts too: where its boundary is fractal, of chance.
TEST(PlaneMap, OverBothAnglesHasTheSharesOfBasin) {
  const PlaneMap map = plane_map(rotor(), both_angles(128, 128));
  ASSERT_EQ(map.codes.front().code, balanced_id);
  // 60.40 %, known to 0.1 %; 16 384 random pixels have an error of 0.4 %.
  EXPECT_NEAR(map.codes.front().share.share, 0.604, 0.012);
}

// Planes of initial values ride on lanes, others do not: the same starts, the same ends.
TEST(PlaneMap, LanesAndSingleTrajectoriesAgree) {
  PlaneMapSettings moved = both_angles(5, 5), turning = moved;
  moved.x = {"initial.x", -0.2, 0.2, 5};
  turning.x = {"initial.phi_dot_1", -1.0, 1.0, 5};
  for (const PlaneMapSettings& settings : {both_angles(5, 5), moved, turning}) {
    const PlaneMap lanes = plane_map(rotor(), settings);
    for (int column = 0; column < 5; ++column) {
      PlaneMapSettings line = settings;
      line.x = {"rotor.eccentricity", 0.005, 0.015, 1};
      const PlaneMap single = plane_map(study_with(rotor(), settings.x.key, settings.x.centre(column)), line);
      for (int row = 0; row < 5; ++row)
        EXPECT_EQ(name_of(lanes, lanes.at(column, row)), name_of(single, single.at(0, row)))
            << settings.x.key << " " << column << ", " << row;
    }
  }
}

TEST(PlaneMap, StopsWhenAsked) {
  StopFlag stop{true};
  PlaneMapSettings settings = mass_plane(4, 4);
  settings.stop = &stop;
  const PlaneMap map = plane_map(rotor(), settings);
  EXPECT_FALSE(map.complete);
  EXPECT_EQ(std::count(map.code.begin(), map.code.end(), not_computed_code), 16);
}

TEST(PlaneMap, ErrorsNameTheKey) {
  const auto key_of_error = [](const PlaneMapSettings& settings) -> std::string {
    try {
      plane_map(rotor(), settings);
    } catch (const InputError& e) {
      return e.key();
    }
    return "accepted";
  };
  PlaneMapSettings s = mass_plane(2, 2);
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
}

TEST(PlaneMap, FileHoldsWhatTheMapHolds) {
  const PlaneMap map = plane_map(rotor(), mass_plane(4, 3));
  const std::string path = testing::TempDir() + "plane_map_test.nc";
  write_map_file(path, map);
  const store::NetcdfFile file(path, store::NetcdfFile::Mode::read);
  EXPECT_EQ(file.length("x"), 4u);
  EXPECT_EQ(file.length("y"), 3u);
  EXPECT_EQ(file.length("outcome_kind"), map.codes.size());
  std::vector<short> codes(12);
  file.read(file.variable("outcome"), {0, 0}, {3, 4}, codes.data());
  EXPECT_EQ(codes, map.code);
  std::vector<double> r_max(12), x(4);
  file.read(file.variable("r_max"), {0, 0}, {3, 4}, r_max.data());
  EXPECT_TRUE(same_bits(r_max, map.r_max));
  file.read(file.variable("x"), {0}, {4}, x.data());
  EXPECT_EQ(x[3], map.x.centre(3));
  EXPECT_EQ(file.attribute("study"), to_toml(map.study));
  std::filesystem::remove(path);
}

TEST(PlaneMap, PictureNamesWhatItShows) {
  const PlaneMap map = plane_map(rotor(), mass_plane(4, 4));
  const std::string script = map_plot_script(map, "Where the rotor ends", "map.png");
  for (const MapCode& c : map.codes)
    EXPECT_EQ(script.find("'" + (c.alias.empty() ? "" : c.alias + ": ") + c.name) != script.npos, c.share.count > 0);
  EXPECT_NE(script.find("balance ends to exist"), script.npos);
  EXPECT_NE(script.find("eccentricity λ"), script.npos);
  EXPECT_NE(script.find("μ"), script.npos);
}

}  // namespace
}  // namespace equipoise
