// How much an attractor search follows: what it can skip, and that it skips no more.
#include <cstdint>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "../support/parameters.hpp"
#include "equipoise/attractor_search/attractor_search.hpp"
#include "equipoise/attractor_search/pilot_run.hpp"

namespace equipoise {
namespace {

// The search of a rotor, and the total count of each stage.
struct Search {
  Search(const model::Parameters& p, double speed) {
    AttractorSearchSettings settings{.threads = 2};
    settings.progress = [this](const Progress& at) {
      const std::string stage = at.what.substr(at.what.find(": ") + 2);
      if (stage != last_) totals[last_] += now_;
      last_ = stage;
      now_ = at.total;
    };
    found = search_attractors(study_of(p, speed), settings);
    totals[last_] += now_;
  }
  AttractorSearch found;
  std::map<std::string, std::uint64_t> totals;

 private:
  std::string last_;
  std::uint64_t now_ = 0;
};

constexpr std::uint64_t scouts = PilotRun::random_scouts + PilotRun::coincident_scouts;
constexpr std::uint64_t all = PilotRun::random_starts + PilotRun::coincident_scouts;

// Balls with so much drag that all of 20 000 starts balance: every scout does, and there is no box to audit.
TEST(SearchWork, ScoutsSufficeWhereAllBalanceAndTheRestIsDear) {
  model::Parameters p = base_rotor(2);
  p.drag.fill(0.1);
  for (const double gravity : {0.001, 0.0}) {
    p.gravity = gravity;
    const Search search(p, 4.0);
    EXPECT_EQ(search.found.catalogue.attractors().size(), 1u);
    EXPECT_TRUE(search.found.rule.boxes.empty());
    EXPECT_EQ(search.totals.at("pilot trajectories"), gravity > 0.0 ? scouts : scouts + all);
  }
}

TEST(SearchWork, AllOfThePilotIsFollowedWhereBoxesAreAudited) {
  model::Parameters p = base_rotor(2);
  p.gravity = 0.01;
  const Search search(p, 2.4);
  EXPECT_GT(search.found.catalogue.attractors().size(), 1u);
  EXPECT_EQ(search.totals.at("pilot trajectories"), scouts + all);
}

// On V2 some scouts repeat their windows and others do not. One of the former is followed to the torus, and features
// identify both kinds.
TEST(SearchWork, OneTorusIsFollowedOnce) {
  const Search search(base_rotor(2), 2.4);
  EXPECT_EQ(search.totals.at("motions followed until they are steady"), 2u);  // V1, V2
  int tori = 0, looks = 0;
  for (const Attractor& a : search.found.catalogue.attractors()) {
    if (a.motion.kind != MotionKind::quasi_periodic) continue;
    ++tori;
    for (const KnownFeatures& known : search.found.rule.known) looks += known.attractor == a.id;
  }
  EXPECT_EQ(tori, 1);
  EXPECT_EQ(looks, 2);
}

}  // namespace
}  // namespace equipoise
