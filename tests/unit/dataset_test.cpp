// A Dataset as NetCDF: types, fill values and texts are read back as they were given.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <netcdf.h>
#include <unistd.h>

#include "equipoise/results/io/dataset_file.hpp"

namespace equipoise {
namespace dataset_test {

using Type = DataColumn::Type;

class DatasetFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  io::NetcdfFile written(const Dataset& data) {
    io::write_netcdf_file(path_, data);
    return io::NetcdfFile(path_, io::NetcdfFile::Mode::read);
  }
  template <class T>
  std::vector<T> read(const io::NetcdfFile& file, const char* name, int type, const std::vector<std::size_t>& shape) {
    std::size_t count = 1;
    for (const std::size_t length : shape) count *= length;
    std::vector<T> values(count);
    file.read(file.variable(name, type, shape), std::vector<std::size_t>(shape.size(), 0), shape, values.data());
    return values;
  }

  std::string path_ = testing::TempDir() + "equipoise_dataset_" + std::to_string(getpid()) + ".nc";
};

// More rows than are written at a time, of several values each.
TEST_F(DatasetFile, HasEveryPlaceOfEveryType) {
  constexpr std::size_t rows = 70001, width = 3;
  Dataset data("numbers");
  const std::size_t row = data.dimension("row", rows), each = data.dimension("each", width);
  data.add("real", "1", "a number", {row, each}, [](std::size_t k) { return 0.1 * static_cast<double>(k); });
  const auto small = [](std::size_t k) { return static_cast<double>(k % 100) - 50.0; };
  data.add("single", "1", "the same", {row}, small, Type::single);
  data.add("integer", "1", "the same", {row}, small, Type::integer);
  data.add("small", "1", "the same", {row}, small, Type::small);
  data.add("byte", "1", "the same", {row}, small, Type::byte);
  data.add("one", "1", "a single number", {}, [](std::size_t) { return 7.0; });
  const io::NetcdfFile file = written(data);
  const auto real = read<double>(file, "real", NC_DOUBLE, {rows, width});
  const auto single = read<float>(file, "single", NC_FLOAT, {rows});
  const auto integer = read<int>(file, "integer", NC_INT, {rows});
  const auto shorts = read<short>(file, "small", NC_SHORT, {rows});
  const auto bytes = read<signed char>(file, "byte", NC_BYTE, {rows});
  for (std::size_t k = 0; k < rows * width; ++k) ASSERT_EQ(real[k], 0.1 * static_cast<double>(k));
  for (std::size_t k = 0; k < rows; ++k) {
    ASSERT_EQ(single[k], small(k));
    ASSERT_EQ(integer[k], small(k));
    ASSERT_EQ(shorts[k], small(k));
    ASSERT_EQ(bytes[k], small(k));
  }
  EXPECT_EQ(read<double>(file, "one", NC_DOUBLE, {}), std::vector<double>{7.0});
}

TEST_F(DatasetFile, HasTextsOfUnequalLengthAndAttributes) {
  const std::vector<std::string> names{"balanced", "", "V2 (2)", "ö"};
  Dataset data("texts");
  data.add_texts("name", data.dimension("outcome", names.size()), names, "name of the outcome");
  data.say("complete", "no");
  const io::NetcdfFile file = written(data);
  EXPECT_EQ(file.length("name_characters"), 8u);
  for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(file.read_text("name", k), names[k]);
  EXPECT_EQ(file.attribute("title"), "texts");
  EXPECT_EQ(file.attribute("complete"), "no");
}

TEST_F(DatasetFile, IsFilledWhereNothingIsKnown) {
  Dataset data("nothing");
  const std::size_t row = data.dimension("row", 5);
  data.add("number", "1", "not known", {row}, {}).fill = NAN;
  data.add("byte", "1", "not known", {row}, {}, Type::byte).fill = -1;
  const io::NetcdfFile file = written(data);
  for (const double number : read<double>(file, "number", NC_DOUBLE, {5})) EXPECT_TRUE(std::isnan(number));
  for (const signed char byte : read<signed char>(file, "byte", NC_BYTE, {5})) EXPECT_EQ(byte, -1);
}

}  // namespace dataset_test
}  // namespace equipoise
