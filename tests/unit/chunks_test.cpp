// Chunks of an ensemble arrive in order, with each start once, whichever thread decides them.
#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/analyses/sweeps/survey_run.hpp"

namespace equipoise {
namespace chunks_test {

constexpr std::uint64_t first = 17, limit = 20000;

// A start's only data is its number.
void number(Chunk& chunk) {
  chunk.outcomes.resize(chunk.count);
  for (std::size_t i = 0; i < chunk.count; ++i) chunk.outcomes[i].time = static_cast<double>(chunk.first + i);
}

bool number_slowly(Chunk& chunk) {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  number(chunk);
  return true;
}

// Receives numbers, and finds the first that is out of order.
struct Row {
  std::vector<double> numbers;

  void take(const Chunk& chunk) {
    for (const Outcome& outcome : chunk.outcomes) numbers.push_back(outcome.time);
  }
  std::optional<std::size_t> first_wrong(std::uint64_t end) const {
    for (std::size_t k = 0; k < end - first; ++k)
      if (k >= numbers.size() || numbers[k] != static_cast<double>(first + k)) return k;
    return std::nullopt;
  }
};

struct Outcome {
  Row row;
  bool lost = false;
};

Outcome compute(const ChunkWork& work) {
  Outcome outcome;
  outcome.lost = !take_chunks(work, first, limit, [&](Chunk& chunk) {
    outcome.row.take(chunk);
    return true;
  });
  return outcome;
}

TEST(Chunks, ComeInOrderFromAllThreads) {
  for (const int threads : {1, 3}) {
    const Outcome outcome = compute({number_slowly, threads});
    EXPECT_FALSE(outcome.lost);
    EXPECT_EQ(outcome.row.numbers.size(), limit - first);
    EXPECT_EQ(outcome.row.first_wrong(limit), std::nullopt);
  }
}

TEST(Chunks, AreSharedWithIdleThreads) {
  OpenEnsembles ensembles;
  EXPECT_FALSE(ensembles.help());  // nothing is at work
  std::atomic<bool> over{false};
  std::atomic<int> helped{0};
  std::thread helper([&] {
    while (!over) helped += ensembles.help();
  });
  std::vector<Outcome> outcomes(2);  // of two ensembles at once
  std::thread other([&] { outcomes[1] = compute({number_slowly, 1, nullptr, &ensembles}); });
  outcomes[0] = compute({number_slowly, 1, nullptr, &ensembles});
  other.join();
  over = true;
  helper.join();
  EXPECT_GT(helped, 0);
  for (const Outcome& outcome : outcomes) {
    EXPECT_FALSE(outcome.lost);
    EXPECT_EQ(outcome.row.first_wrong(limit), std::nullopt);
  }
  EXPECT_FALSE(ensembles.help());
}

TEST(Chunks, HelpersThatThrowLeave) {
  OpenEnsembles ensembles;
  std::atomic<bool> over{false};
  std::atomic<int> thrown{0};
  std::thread helper([&] {
    while (!over) try {
        ensembles.help();
      } catch (const std::runtime_error&) {
        ++thrown;
      }
  });
  const auto of_helper = [owner = std::this_thread::get_id(), &thrown](Chunk& chunk) {
    while (thrown == 0 && chunk.first == first) std::this_thread::yield();  // the owner waits for the helper
    if (chunk.first > first) throw std::runtime_error("no");
    return number_slowly(chunk);
  };
  EXPECT_TRUE(compute({of_helper, 1, nullptr, &ensembles}).lost);
  over = true;
  helper.join();
  EXPECT_EQ(thrown, 1);
}

TEST(Chunks, EndWhereTheyAreToldTo) {
  StopFlag stop{false};
  Outcome outcome = compute({[&](Chunk& chunk) {
                               stop = chunk.first > 4000;
                               return number_slowly(chunk);
                             },
                             2, &stop});
  EXPECT_TRUE(outcome.lost);
  EXPECT_LT(outcome.row.numbers.size(), limit - first);
  EXPECT_GT(outcome.row.numbers.size(), 3000u);
  EXPECT_EQ(outcome.row.first_wrong(first + outcome.row.numbers.size()), std::nullopt);
}

TEST(Chunks, WhatDecidingThrowsIsThrown) {
  const auto throwing = [](Chunk& chunk) {
    if (chunk.first > 4000) throw std::runtime_error("no");
    return number_slowly(chunk);
  };
  EXPECT_THROW(compute({throwing, 2}), std::runtime_error);
}

}  // namespace chunks_test
}  // namespace equipoise
