// Spin-ups that take long obey the stop flag.
#include <ctime>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../base_study.hpp"
#include "equipoise/fates/transient_tally.hpp"
#include "equipoise/spin_up/start_source.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {
namespace {

Study ramp(const std::string& duration) {
  return parse_study(rotor_and_balancer + "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = " + duration + "\n",
                     "ramp.toml");
}

double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Ten million steps and more of integration, seconds of them; none is begun.
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
  std::vector<double> phi, states;
  std::vector<Fate> fates;
  EXPECT_TRUE(source.make(1, 0, 10, phi, states, fates));
  stop = true;
  EXPECT_FALSE(source.make(1, 0, 10, phi, states, fates));
}

// The grid of times at which transients are watched: 64 points a turn, a hundred thousand turns' worth of sums.
TEST(StoppedSpinUp, IsNotWatched) {
  const StopFlag stop{true};
  const Study study = ramp("3e5");
  StartSource source(study, &stop);
  const double begin = cpu_now();
  source.watch(transient_settings(study));
  EXPECT_LT(cpu_now() - begin, 1.0);  // the times themselves are listed
}

}  // namespace
}  // namespace equipoise
