// How much an attractor search follows: what it can skip, and that it skips no more.
#include <cstdint>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "../support/parameters.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/attractor_search/pilot_run.hpp"

namespace equipoise {
namespace search_work_test {

// The search of a rotor, and the total count of each stage.
struct Search {
  Search(const model::Parameters& p, double speed, bool few_starts = false) {
    AttractorSearchSettings settings{.threads = 2};
    if (few_starts) settings.mode = SearchMode::few;
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

constexpr PilotRun::Size pilot;
constexpr std::uint64_t scouts = pilot.random_scouts + pilot.coincident_scouts;
constexpr std::uint64_t all = pilot.random_starts + pilot.coincident_scouts;

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

// The full search makes a trapping region around V1, and audits boxes.
TEST(SearchWork, FewStartsHaveFewScoutsAndRegionsOfBalanceAlone) {
  const Search few(base_rotor(2), 2.4, true), full(base_rotor(2), 2.4);
  EXPECT_EQ(few.totals.at("pilot trajectories"), few_scouts);
  EXPECT_EQ(full.totals.at("pilot trajectories"), scouts + all);
  EXPECT_FALSE(few.found.rule.balanced.empty());
  EXPECT_TRUE(few.found.rule.boxes.empty() && few.found.rule.cycles.empty());
  EXPECT_EQ(few.found.rule.windowed.regions, nullptr);
  EXPECT_FALSE(full.found.rule.cycles.empty());
  EXPECT_FALSE(full.found.rule.boxes.empty());
  EXPECT_FALSE(few.found.rule.known.empty());
  EXPECT_NE(search_key("", {.mode = SearchMode::few}), search_key("", {}));
}

}  // namespace search_work_test
}  // namespace equipoise
