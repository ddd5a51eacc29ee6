// Long spin-ups obey the stop flag.
#include <ctime>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace stopped_spin_up_test {

Study ramp(const std::string& duration) {
  return parse_study(rotor_and_balancer + "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = " + duration + "\n",
                     "ramp.toml");
}

double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// More than ten million integration steps, seconds of work; none is begun.
TEST(StoppedSpinUp, DoesNotIntegrate) {
  const StopFlag stop{true};
  const double begin = cpu_now();
  const StartSource source(ramp("1e7"), &stop);
  EXPECT_LT(cpu_now() - begin, 0.3);
}

TEST(StoppedSpinUp, MakesNoStarts) {
  StopFlag stop{false};
  const Study study = ramp("1e3");
  StartSource source(study, &stop);
  SpunUp starts;
  EXPECT_TRUE(source.make(1, 0, 10, starts));
  stop = true;
  EXPECT_FALSE(source.make(1, 0, 10, starts));
}

// The grid of times for transients: 64 points per turn, over a hundred thousand turns.
TEST(StoppedSpinUp, IsNotWatched) {
  const StopFlag stop{true};
  const Study study = ramp("3e5");
  StartSource source(study, &stop);
  const double begin = cpu_now();
  source.watch(transient_settings(study));
  EXPECT_LT(cpu_now() - begin, 1.0);  // the times themselves are listed
}

// Seventy million times of 104 bytes are refused before any work, wherever balls are held so long and nowhere else.
TEST(LongSpinUp, IsNotWatchedBeyondMemory) {
  const auto refused = [](const std::vector<std::string>& overrides) -> std::string {
    const Study study = parse_study(rotor_and_balancer + "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = 3e6\n",
                                    "ramp.toml", overrides);
    const double begin = cpu_now();
    try {
      check_runnable(study, true);
    } catch (const InputError& e) {
      EXPECT_LT(cpu_now() - begin, 0.3);
      EXPECT_NO_THROW(check_runnable(study, false));
      EXPECT_NE(e.problem().find("transients"), std::string::npos);
      return e.key() + " = " + e.value();
    }
    return "";
  };
  EXPECT_EQ(refused({}), "speed.duration = 3000000");
  EXPECT_EQ(refused({"release.speed=1.2"}), "release.speed = 1.2");
  EXPECT_EQ(refused({"release.time=2.9e6"}), "release.time = 2900000");
  EXPECT_EQ(refused({"speed={profile='points', times=[0.0, 3e6], speeds=[0.0, 2.4]}"}), "speed.times = 3000000");
  EXPECT_EQ(refused({"speed={profile='trapezoid', peak=3.0, final=2.4, rise_until=2e6, hold_until=2.1e6, "
                     "fall_until=2.2e6}"}),
            "speed.rise_until = 2000000");
  EXPECT_EQ(refused({"speed.duration=2e5", "speed.final=1.3"}), "");  // 1.3 * 64 / (2 pi) per unit of time: 2.6 million
  EXPECT_EQ(refused({"release.time=0.0"}), "");                       // free from the start
}

}  // namespace stopped_spin_up_test
}  // namespace equipoise
