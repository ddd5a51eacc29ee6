// Parts of a table of transients, taken by place and put back.
#include "equipoise/results/types/transient_table.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace equipoise {
namespace transient_table_test {

TransientTable table(bool own) {
  TransientTable all;
  all.settings.displacement = 0.5;
  all.ends.resize(3);
  for (int i = 0; i < 4; ++i) {
    all.rows.emplace_back().end = i;
    if (own) all.own.emplace_back().displacement = 10.0 + i;
  }
  return all;
}

TEST(TransientTable, PartsKeepRowsAndSettingsByPlace) {
  const std::vector<std::size_t> places{3, 1};
  const TransientTable shared = table(false).part(places), own = table(true).part(places);
  ASSERT_EQ(shared.rows.size(), 2u);
  EXPECT_EQ(shared.rows[0].end, 3.0);
  EXPECT_EQ(shared.rows[1].end, 1.0);
  EXPECT_EQ(shared.ends.size(), 3u);
  EXPECT_EQ(shared.settings_of(1).displacement, 0.5);
  EXPECT_EQ(own.settings_of(0).displacement, 13.0);
  EXPECT_EQ(own.settings_of(1).displacement, 11.0);
}

TEST(TransientTable, PutsPartsBackWhereTheyWere) {
  const std::vector<std::size_t> places{3, 1};
  TransientTable all = table(false), part = all.part(places);
  part.rows[0].end = 30.0;
  part.rows[1].end = 10.0;
  all.put_back(places, part);
  const std::vector<double> ends{all.rows[0].end, all.rows[1].end, all.rows[2].end, all.rows[3].end};
  EXPECT_EQ(ends, (std::vector<double>{0.0, 10.0, 2.0, 30.0}));
}

}  // namespace transient_table_test
}  // namespace equipoise
