// Files written and read by several threads at once: the NetCDF library has no lock of its own.
#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <netcdf.h>
#include <unistd.h>

#include "equipoise/results/io/dataset_file.hpp"

namespace equipoise::io {
namespace netcdf_threads_test {

// A file with `number` a hundred times, and its text.
void write(const std::string& path, double number) {
  Dataset data("numbers");
  data.add("value", "1", "a value", {data.dimension("place", 100)}, [=](std::size_t) { return number; });
  data.say("number", std::to_string(number));
  write_netcdf_file(path, data);
}

bool reads_back(const std::string& path, double number) {
  std::vector<double> values(100, -1.0);
  const NetcdfFile file(path, NetcdfFile::Mode::read);
  file.read(file.variable("value", NC_DOUBLE, {values.size()}), {0}, {values.size()}, values.data());
  return values == std::vector<double>(100, number) && file.attribute("number") == std::to_string(number);
}

// Without the lock threads get each other's file numbers: within the first hundred files some are closed twice or
// written into others, or the process ends.
TEST(NetcdfFile, IsWrittenAndReadBySeveralThreads) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("netcdf_threads_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  constexpr int threads = 4, files = 400;
  std::atomic<int> good{0};
  {
    std::vector<std::jthread> workers;
    for (int thread = 0; thread < threads; ++thread)
      workers.emplace_back([&, thread] {
        const std::string path = (folder / (std::to_string(thread) + ".nc")).string();
        for (int k = 0; k < files; ++k) try {
            write(path, 1000.0 * thread + k);
            good += reads_back(path, 1000.0 * thread + k);
          } catch (const std::exception& e) {
            ADD_FAILURE() << e.what();
            return;
          }
      });
  }
  EXPECT_EQ(good, threads * files);
  std::filesystem::remove_all(folder);
}

}  // namespace netcdf_threads_test
}  // namespace equipoise::io
