// Stores of rows: finished lines and records of the journal are read as one; records of other results are refused.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "../support/refusals.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/io/row_store.hpp"

namespace equipoise {
namespace row_store_test {

namespace fs = std::filesystem;

// Three lines of four rows, each a code and two numbers.
struct Plane : io::RowStore {
  explicit Plane(const std::string& path, std::size_t of_line = 4)
      : RowStore(path, "mine", {"this plane", "must be another file"},
                 {.rows = io::Journal::Kind::pixels,
                  .text = io::Journal::Kind::outcome_name,
                  .most = 12,
                  .lines = "y",
                  .of_line = of_line,
                  .columns = {{{"code", ""}, DataColumn::Type::small, 1, "x"},
                              {{"pair", ""}, DataColumn::Type::single, 2, "x"}},
                  .components = 3}) {}

  using RowStore::append_text;
  using RowStore::texts;

  // Codes from `code` on; each number is ten times its row's code, and half more.
  void append(std::uint64_t first, std::uint64_t count, int code) {
    append_rows({.first = first, .count = count}, [code](std::size_t column, std::size_t place) {
      const double of_row = code + static_cast<double>(column == 0 ? place : place / 2);
      return column == 0 ? of_row : 10.0 * of_row + 0.5 * static_cast<double>(place % 2);
    });
  }
  std::vector<double> values(std::size_t column, std::uint64_t first, std::size_t count) const {
    std::vector<double> all(count * (column + 1), -1.0);
    read(column, first, count, all.data());
    return all;
  }
  void write(Rest rest) {
    finish(
        [this](const std::string& place) {
          Dataset data("plane");
          const std::vector<std::size_t> plane{data.dimension("y", 3), data.dimension("x", 4)};
          const std::vector<std::size_t> pairs{plane.front(), data.dimension("x_pair", 8)};
          data.add(
              "code", "1", "", plane,
              [this](std::size_t first, std::size_t count, double* to) {
                std::fill_n(to, count, -1.0);
                read(0, first, count, to);
              },
              DataColumn::Type::small);
          data.add(
              "pair", "1", "", pairs,
              [this](std::size_t first, std::size_t count, double* to) {
                std::fill_n(to, count, -1.0);
                read(1, first / 2, count / 2, to);
              },
              DataColumn::Type::single);
          data.say("identity", "mine");
          io::write_netcdf_file(place, data);
        },
        rest);
  }
};

class RowStore : public testing::Test {
 protected:
  void TearDown() override {
    fs::remove(path_);
    fs::remove(path_ + ".part");
  }
  const std::string path_ = testing::TempDir() + "equipoise_rows_" + std::to_string(getpid()) + ".nc";
};

TEST_F(RowStore, ReadsRecordsInPartsAndLeavesWhatIsNotThere) {
  for (const bool again : {false, true}) {
    Plane plane(path_);
    if (!again) {
      plane.append(1, 3, 5);
      plane.append(6, 2, 9);
    }
    EXPECT_EQ(plane.values(0, 0, 8), (std::vector<double>{-1, 5, 6, 7, -1, -1, 9, 10}));
    EXPECT_EQ(plane.values(1, 2, 2), (std::vector<double>{60, 60.5, 70, 70.5}));
  }
}

TEST_F(RowStore, ReadsTheLastOfWhatWasAppendedTwice) {
  Plane plane(path_);
  plane.append(0, 4, 1);
  plane.append(2, 1, 30);
  EXPECT_EQ(plane.values(0, 0, 4), (std::vector<double>{1, 2, 30, 4}));
}

TEST_F(RowStore, ReadsNewRowsOverFinishedLines) {
  {
    Plane plane(path_);
    plane.append(0, 4, 1);
    plane.write(io::Store::Rest::nothing);
  }
  EXPECT_FALSE(fs::exists(path_ + ".part"));
  Plane plane(path_);
  plane.append(3, 2, 20);
  EXPECT_EQ(plane.values(0, 0, 8), (std::vector<double>{1, 2, 3, 20, 21, -1, -1, -1}));
  EXPECT_EQ(plane.values(1, 0, 4), (std::vector<double>{10, 10.5, 20, 20.5, 30, 30.5, 200, 200.5}));
}

TEST_F(RowStore, KeepsEachStateOnceAndTexts) {
  {
    Plane plane(path_);
    for (int k = 0; k < 2; ++k) plane.append_attractor_search({1.0, 2.0, 3.0});
    plane.append_text(7, "seven");
  }
  const Plane plane(path_);
  EXPECT_EQ(plane.discoveries(), (std::vector<std::vector<double>>{{1.0, 2.0, 3.0}}));
  ASSERT_EQ(plane.texts().size(), 1u);
  EXPECT_EQ(plane.texts().front().first, 7u);
  EXPECT_EQ(plane.texts().front().second, "seven");
}

TEST_F(RowStore, RefusesRowsThatItHasNoPlaceFor) {
  {
    Plane plane(path_);
    plane.append(10, 2, 1);
  }
  { EXPECT_NO_THROW(Plane{path_}); }
  {
    Plane plane(path_);
    plane.append(11, 2, 1);
  }
  const std::string refused = refusal_text([&] { Plane{path_}; });
  EXPECT_NE(refused.find(".part"), std::string::npos) << refused;
  EXPECT_NE(refused.find("holds something else"), std::string::npos) << refused;
}

TEST_F(RowStore, RefusesFinishedLinesOfAnotherLength) {
  {
    Plane plane(path_);
    plane.append(0, 12, 1);
    plane.write(io::Store::Rest::nothing);
  }
  { EXPECT_NO_THROW(Plane{path_}); }
  const std::string refused = refusal_text([&] { Plane(path_, 3); });
  EXPECT_NE(refused.find("is damaged"), std::string::npos) << refused;
  EXPECT_NE(refused.find("must be another file"), std::string::npos) << refused;
}

}  // namespace row_store_test
}  // namespace equipoise
