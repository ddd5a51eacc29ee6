// An interrupted attractor search, and the same search without interruption.
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/attractors/motions/motion_bytes.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/core/running/search_log.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace stopped_search_test {

// Everything that a search finds, as far as the lanes and the catalogue show it.
void expect_same(const AttractorSearch& a, const AttractorSearch& b) {
  EXPECT_EQ(a.warm_start_states, b.warm_start_states);
  EXPECT_EQ(a.warm_start_levels, b.warm_start_levels);
  ASSERT_EQ(a.catalogue.attractors().size(), b.catalogue.attractors().size());
  for (std::size_t k = 0; k < a.catalogue.attractors().size(); ++k)
    EXPECT_EQ(bytes_of(a.catalogue.attractors()[k].motion), bytes_of(b.catalogue.attractors()[k].motion));
  ASSERT_EQ(a.rule.known.size(), b.rule.known.size());
  for (std::size_t k = 0; k < a.rule.known.size(); ++k) EXPECT_EQ(a.rule.known[k].features, b.rule.known[k].features);
  ASSERT_EQ(a.rule.boxes.size(), b.rule.boxes.size());
  for (std::size_t k = 0; k < a.rule.boxes.size(); ++k) {
    EXPECT_EQ(a.rule.boxes[k].low, b.rule.boxes[k].low);
    EXPECT_EQ(a.rule.boxes[k].high, b.rule.boxes[k].high);
    EXPECT_EQ(a.rule.boxes[k].hits_needed, b.rule.boxes[k].hits_needed);
  }
  ASSERT_EQ(a.rule.balanced.size(), b.rule.balanced.size());
  for (std::size_t k = 0; k < a.rule.balanced.size(); ++k)
    EXPECT_EQ(a.rule.balanced[k].level, b.rule.balanced[k].level);
}

// A search stopped again and again, each time a little later, ends like one that is not stopped. By then its log holds
// everything it asks for.
TEST(SearchLog, BringAStoppedSearchToTheSameEnd) {
  Study study = with_horizon(parse_study(constant_speed, "notes.toml"));
  const AttractorSearch whole = search_attractors(study, {});
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::vector<char>> kept;  // by page and number
  int cut = 0;
  for (;; ++cut) {
    ASSERT_LT(cut, 2000);
    StopFlag stop{false};
    const std::size_t enough = kept.size() + 8;
    SearchLog notes([&](std::uint64_t page, std::uint64_t number, const std::vector<char>& answer) {
      kept[{page, number}] = answer;
      stop = kept.size() >= enough;
    });
    for (const auto& [where, answer] : kept) notes.know(where.first, where.second, answer);
    const AttractorSearch found = search_attractors(study, {.stop = &stop, .notes = &notes});
    if (found.stopped) continue;
    expect_same(found, whole);
    break;
  }
  EXPECT_GT(cut, 3);
  const std::size_t all = kept.size();
  SearchLog complete([&](std::uint64_t page, std::uint64_t number, const std::vector<char>& answer) {
    kept[{page, number}] = answer;
  });
  for (const auto& [where, answer] : kept) complete.know(where.first, where.second, answer);
  expect_same(search_attractors(study, {.notes = &complete}), whole);
  EXPECT_EQ(kept.size(), all);
}

}  // namespace stopped_search_test
}  // namespace equipoise
