// Work on other threads, callbacks on the caller's: order, stops, exceptions on either side.
#include "equipoise/core/running/reporting.hpp"

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/running/stage_progress.hpp"

namespace equipoise {
namespace reporting_test {

bool stopped(const RunOptions& options) { return options.stop && options.stop->load(); }

TEST(Reported, WithoutCallbacksWorkRunsWhereItIs) {
  const auto here = std::this_thread::get_id();
  RunOptions options;
  EXPECT_EQ(reported(options, [](const RunOptions&) { return std::this_thread::get_id(); }), here);
  options.progress = [](const Progress&) {};
  EXPECT_NE(reported(options, [](const RunOptions&) { return std::this_thread::get_id(); }), here);
}

// Many threads report at once: this thread hears each report, one after the other, and its sender waits.
TEST(Reported, EveryReportIsHeardHere) {
  RunOptions options;
  std::uint64_t heard = 0;
  bool elsewhere = false, two_at_once = false, inside = false;
  options.progress = [&, here = std::this_thread::get_id()](const Progress& p) {
    two_at_once = two_at_once || std::exchange(inside, true);
    elsewhere = elsewhere || std::this_thread::get_id() != here;
    heard += p.done;
    inside = false;
  };
  const int told = reported(options, [](const RunOptions& o) {
    std::vector<std::thread> tellers;
    for (int t = 0; t < 4; ++t)
      tellers.emplace_back([&] {
        for (int k = 0; k < 250; ++k) o.progress({1, 1000, "reports", {}});
      });
    for (std::thread& teller : tellers) teller.join();
    return 1000;
  });
  EXPECT_EQ(told, 1000);
  EXPECT_EQ(heard, 1000u);
  EXPECT_FALSE(elsewhere);
  EXPECT_FALSE(two_at_once);
}

TEST(Reported, AFlagSetInACallbackIsSeenBeforeTheWorkGoesOn) {
  StopFlag stop{false};
  RunOptions options;
  options.stop = &stop;
  options.progress = [&](const Progress& p) { stop = p.done == 3; };
  const int reports = reported(options, [](const RunOptions& o) {
    int k = 0;
    while (!stopped(o)) o.progress({static_cast<std::uint64_t>(++k), 0, "", {}});
    return k;
  });
  EXPECT_EQ(reports, 3);
}

TEST(Reported, WorkThatNeverReportsIsStoppedTooByFlagAndByQuestion) {
  const auto until_stopped = [](const RunOptions& o) {
    while (!stopped(o)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return true;
  };
  RunOptions options;
  int asked = 0;
  options.stop_asked = [&] { return ++asked == 3; };
  EXPECT_TRUE(reported(options, until_stopped));
  EXPECT_EQ(asked, 3);
  StopFlag stop{false};
  options.stop = &stop;
  options.stop_asked = [] { return false; };
  std::thread setter([&] { stop = true; });
  EXPECT_TRUE(reported(options, until_stopped));
  setter.join();
}

TEST(Reported, WhatACallbackThrowsStopsTheWorkAndComesOut) {
  RunOptions options;
  int heard = 0;
  options.progress = [&](const Progress&) {
    ++heard;
    throw std::runtime_error("enough");
  };
  bool went_on = false;
  try {
    reported(options, [&](const RunOptions& o) {
      o.progress({});
      went_on = !stopped(o);
      o.progress({});  // not heard
      return 0;
    });
    ADD_FAILURE() << "nothing came";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "enough");
  }
  EXPECT_EQ(heard, 1);
  EXPECT_FALSE(went_on);
}

TEST(Reported, WhatTheWorkThrowsComesOut) {
  RunOptions options;
  options.progress = [](const Progress&) {};
  EXPECT_THROW(reported(options, [](const RunOptions&) -> int { throw std::out_of_range("work"); }), std::out_of_range);
}

TEST(Reported, CallsMayStandInsideEachOther) {
  RunOptions options;
  std::vector<std::string> heard;
  options.progress = [&](const Progress& p) { heard.push_back(p.what); };
  reported(options, [](const RunOptions& outer) {
    RunOptions inner = outer;
    inner.progress = [&](const Progress& p) { outer.progress({p.done, p.total, "inner " + p.what, {}}); };
    return reported(inner, [](const RunOptions& o) {
      o.progress({0, 0, "work", {}});
      return 0;
    });
  });
  EXPECT_EQ(heard, std::vector<std::string>{"inner work"});
}

// Four threads: counts never fall during a stage, and no two threads report at once.
TEST(Stages, AreToldInOrderByWhicheverThreadWorks) {
  std::vector<Progress> heard;
  bool telling = false, overlapping = false;
  StageProgress stages("a search", [&](const Progress& p) {
    overlapping = overlapping || std::exchange(telling, true);
    heard.push_back(p);
    telling = false;
  });
  stages.begin("trajectories", 400);
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&] {
      for (int i = 0; i < 100; ++i) stages.add(1);
    });
  for (std::thread& t : threads) t.join();
  ASSERT_EQ(heard.size(), 401u);
  for (std::size_t k = 0; k < heard.size(); ++k) {
    EXPECT_EQ(heard[k].done, k);
    EXPECT_EQ(heard[k].total, 400u);
    EXPECT_EQ(heard[k].what, "a search: trajectories");
    EXPECT_TRUE(heard[k].preparing);
  }
  EXPECT_FALSE(overlapping);
}

TEST(Stages, OfOneNameGoOnCountingAndOthersBegin) {
  Progress last;
  StageProgress stages("a search", [&](const Progress& p) { last = p; });
  stages.begin("states");
  stages.add(128);
  stages.begin("states");
  stages.add(64);
  EXPECT_EQ(last.done, 192u);
  EXPECT_EQ(last.total, 0u);
  stages.begin("motions", 3);
  EXPECT_EQ(last.done, 0u);
  EXPECT_EQ(last.total, 3u);
}

// The first batch of slow starts may take long; until then it would seem that the search goes on.
TEST(BasinProgress, CountsNoStartsAsSoonAsTheSearchIsOver) {
  std::vector<Progress> starts;
  BasinOptions options;
  options.progress = [&](const Progress& p) {
    if (!p.preparing) starts.push_back(p);
  };
  basin(parse_study(constant_speed + "[sampling]\nstarts = 20\n", "s"), options);
  ASSERT_EQ(starts.size(), 2u);
  EXPECT_EQ(starts[0].done, 0u);
  EXPECT_FALSE(starts[0].balanced);
  EXPECT_EQ(starts[1].done, 20u);
}

}  // namespace reporting_test
}  // namespace equipoise
