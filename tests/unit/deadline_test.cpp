// Times as written, and a flag set by a clock.
#include "equipoise/core/running/deadline.hpp"

#include <chrono>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "../support/refusals.hpp"
#include "equipoise/core/base/error.hpp"

namespace equipoise {
namespace deadline_test {

TEST(TimeLimit, IsReadWithItsUnit) {
  EXPECT_EQ(read_time_limit("--within", "90"), 90.0);
  EXPECT_EQ(read_time_limit("--within", "60s"), 60.0);
  EXPECT_EQ(read_time_limit("--within", "10 min"), 600.0);
  EXPECT_EQ(read_time_limit("--within", "1.5h"), 5400.0);
}

TEST(TimeLimit, AnythingElseIsRefusedWithWhatIsAllowed) {
  for (const char* text : {"", "s", "5x", "-1", "0", "nan", "inf", "1e6h", "10 m", "5 s s"}) {
    const InputError error = refused([&] { read_time_limit("--within", text); });
    EXPECT_EQ(error.where(), "--within");
    EXPECT_EQ(error.value(), text);
    EXPECT_NE(error.problem().find("at most 10000 h"), std::string::npos);
  }
}

TEST(Deadline, SetsItsFlagWhenItIsOver) {
  StopFlag stop{false};
  const auto begin = std::chrono::steady_clock::now();
  const Deadline deadline(stop, 0.05);
  EXPECT_FALSE(deadline.over());
  while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(50));
  EXPECT_TRUE(deadline.over());
  EXPECT_TRUE(deadline.half_over());
}

TEST(Deadline, EndsWithoutSettingIt) {
  StopFlag stop{false};
  { const Deadline deadline(stop, 3600.0); }
  EXPECT_FALSE(stop);
}

// Ctrl-C came just before: the time was not over.
TEST(Deadline, IsNotOverWhereTheFlagWasSetBefore) {
  StopFlag stop{true};
  const Deadline deadline(stop, 0.01);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(deadline.over());
}

}  // namespace deadline_test
}  // namespace equipoise
