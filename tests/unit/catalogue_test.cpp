// The list of attractors: which attractor it finds, and what is new in it.
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "../support/studies.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace catalogue_test {

Attractor attractor(int id) { return {id, "", "", {}, {}}; }

std::vector<int> numbers(const std::vector<Attractor>& attractors) {
  std::vector<int> result;
  for (const Attractor& a : attractors) result.push_back(a.id);
  return result;
}

// The attractor search makes one trapping region for each new attractor.
TEST(Catalogue, TellsWhatIsNewWhereverItStands) {
  Catalogue list;
  for (const int id : {1, 9, 4}) list.add(attractor(id));
  const Catalogue earlier = list;
  EXPECT_EQ(numbers(list.listed_since(earlier)), std::vector<int>());
  EXPECT_EQ(numbers(list.listed_since({})), (std::vector<int>{1, 4, 9}));
  list.add(attractor(2));
  list.add(attractor(10));
  EXPECT_EQ(numbers(list.attractors()), (std::vector<int>{1, 2, 4, 9, 10}));
  EXPECT_EQ(numbers(list.listed_since(earlier)), (std::vector<int>{2, 10}));
}

// A table by alias would lose one of two motions that share it.
TEST(Catalogue, GivesThePapersNameToOneMotion) {
  Motion captured;
  captured.kind = MotionKind::periodic;
  captured.speed = 2.4;
  captured.drift_group = {0, 1};
  captured.cluster = {0, 1};
  captured.winding = {0, 1};
  Catalogue list;
  list.add({4, "one captured", "V3", {}, {}});
  const Attractor* second = list.find(list.add(parse_study(constant_speed, "rotor").parameters, captured));
  EXPECT_EQ(second->name, "one captured (2)");
  EXPECT_EQ(second->alias, "");
}

}  // namespace catalogue_test
}  // namespace equipoise
