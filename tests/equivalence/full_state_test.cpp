// Ensembles of starts drawn from a box of the full state: shares, file, replay.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace full_state_test {

Study boxed(std::uint64_t starts) {
  Study study = parse_study(constant_speed + R"([sampling.box]
x = [-0.2, 0.2]
y = [-0.2, 0.2]
x_dot = [-0.5, 0.5]
y_dot = [-0.5, 0.5]
phi_dot = [-2.4, 2.4]
)",
                            "boxed");
  study.sampling.starts = starts;
  return study;
}

std::vector<std::uint64_t> counts(const BasinResult& r) {
  std::vector<std::uint64_t> result;
  for (const OutcomeShare& a : r.attractors) result.push_back(a.share.count);
  result.push_back(r.undecided.count);
  return result;
}

TEST(FullState, ABoxWithoutExtentIsNoBox) {
  Study point = boxed(1), plain = boxed(1);
  plain.sampling.box = {};
  point.sampling.box = {};
  point.sampling.box.x = point.sampling.box.y_dot = point.sampling.box.phi_dot = {0.0, 0.0};
  SpunUp starts, same;
  ASSERT_TRUE(StartSource(point, nullptr).make(1, 0, 100, starts));
  ASSERT_TRUE(StartSource(plain, nullptr).make(1, 0, 100, same));
  EXPECT_EQ(starts.phi, same.phi);
  EXPECT_EQ(starts.states, same.states);
}

TEST(FullState, StartsComeToWhatTheirTrajectoriesComeToAlone) {
  const Study study = boxed(1);
  const Session runner(study, {.threads = 2});
  constexpr std::size_t count = 40;
  Decided decided;
  ASSERT_TRUE(runner.decide(0, count, decided));
  ASSERT_TRUE(decided.unlisted.empty());
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::VectorXd state(model::dimension(2));
    initial_state(start_of(study, study.sampling.seed, i), 2, 2.4, state.data());
    const auto motion = motion_from({study.parameters, 2.4}, state);
    const Attractor* attractor = runner.catalogue().find(decided.outcomes[i].attractor);
    ASSERT_TRUE(motion && attractor) << i;
    EXPECT_EQ(attractor->name, motion_name(study.parameters, *motion).name) << i;
  }
}

void expect_whole_starts(const std::string& path, const Study& study) {
  const std::size_t count = study.sampling.starts;
  const io::NetcdfFile file(path, io::NetcdfFile::Mode::read);
  std::vector<double> rotor(4 * count), rates(2 * count), phi(2 * count);
  file.read(file.variable("rotor_state"), {0, 0}, {count, 4}, rotor.data());
  file.read(file.variable("phi_dot"), {0, 0}, {count, 2}, rates.data());
  file.read(file.variable("phi"), {0, 0}, {count, 2}, phi.data());
  for (std::size_t i = 0; i < count; ++i) {
    const InitialState s = start_of(study, study.sampling.seed, i);
    ASSERT_EQ((std::vector<double>{s.x, s.y, s.x_dot, s.y_dot}),
              (std::vector<double>(&rotor[4 * i], &rotor[4 * i] + 4)));
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(rates[2 * i + k], s.phi_dot[k]);
      ASSERT_EQ(phi[2 * i + k], s.phi[k]);
    }
  }
}

TEST(FullState, FileHoldsWholeStartsResumesAndEarlyDecisionsAgreeWithThoseAtTheHorizon) {
  const std::string path = testing::TempDir() + "equipoise_" + std::to_string(getpid()) + "full.nc";
  BasinOptions options;
  options.output = path;
  basin(boxed(300), options);
  Study study = boxed(1500);
  const BasinResult early = basin(study, options);
  EXPECT_EQ(early.resumed_from, 300u);
  expect_whole_starts(path, study);
  std::filesystem::remove(path);
  study.numerics.decide = ClassificationMode::horizon;
  study.numerics.horizon = 3000.0;
  EXPECT_EQ(counts(early), counts(basin(study)));
  EXPECT_EQ(early.diverged.count + early.failed.count, 0u);
}

}  // namespace full_state_test
}  // namespace equipoise
