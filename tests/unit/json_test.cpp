// JSON of results: members in the order in which they are named, null where there is nothing.
#include "equipoise/report/text/json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/statistics/quantile.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise::json_test {

TEST(JsonOfResults, KeepsTheOrderOfMembersAndWritesNullForWhatIsNotThere) {
  Json json = object("z", 1, "a", std::optional<double>(), "finite", std::optional(0.5), "endless", INFINITY);
  put(json, "word", "last");
  EXPECT_EQ(json.dump(), R"({"z":1,"a":null,"finite":0.5,"endless":null,"word":"last"})");
  put_known(json, "not_there", std::optional<int>(), "there", std::optional(3));
  EXPECT_FALSE(json.contains("not_there"));
  EXPECT_EQ(json["there"], 3);
}

TEST(JsonOfResults, TellsSharesAndEstimatesByTheirMembers) {
  const Share share = open_share(1, 3, 10);
  EXPECT_EQ(Json(share).size(), 4u);
  EXPECT_EQ(sure(share)["most"], share.most);
  EXPECT_GT(share.most, share.high);
  EXPECT_EQ(Json(QuantileEstimate{2.0, 1.0, 3.0}).dump(), R"({"value":2.0,"low":1.0,"high":3.0})");
  EXPECT_EQ(Json(std::optional<Estimate>()).dump(), "null");
  EXPECT_EQ(outcome_with({3, "apart", "V2"}, share)["name"], "apart");
  EXPECT_EQ(outcome_with({3, "apart", "V2"}, share)["count"], 1);
}

TEST(JsonOfResults, WritesTablesRowByRow) {
  const std::vector<double> values{1.0, 2.5, NAN, 4.0};
  std::string text;
  append_rows(text, 2, 2,
              [&](std::size_t k) { return std::isnan(values[k]) ? std::nullopt : std::optional(values[k]); });
  EXPECT_EQ(text, "[[1,2.5],[null,4]]");
}

TEST(JsonOfResults, TellsAxesByTheCentresOfTheirPixels) {
  EXPECT_EQ(Json(SliceAxis{"initial.phi_1", 0.0, 1.0, 2}).dump(), R"({"key":"initial.phi_1","values":[0.25,0.75]})");
}

}  // namespace equipoise::json_test
