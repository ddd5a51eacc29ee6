// Chunks of an ensemble arrive in order, with each start once, whichever process decides them.
#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/analyses/sweeps/cell_desk.hpp"

namespace equipoise {
namespace chunks_test {

constexpr std::uint64_t first = 17, limit = 20000;

// A start's only data is its number.
void number(Chunk& chunk) {
  chunk.fates.resize(chunk.count);
  for (std::size_t i = 0; i < chunk.count; ++i) chunk.fates[i].time = static_cast<double>(chunk.first + i);
}

bool number_slowly(Chunk& chunk) {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!chunk.from_elsewhere) number(chunk);
  return true;
}

// Receives numbers, and finds the first that is out of order.
struct Row {
  std::vector<double> numbers;
  std::size_t from_elsewhere = 0;

  void take(const Chunk& chunk) {
    for (const Fate& fate : chunk.fates) numbers.push_back(fate.time);
    from_elsewhere += chunk.from_elsewhere;
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
  const std::atomic<bool> finished{false};
  std::atomic<bool> lost{false};
  compute_chunks(work, first, limit, finished, lost,
                 [&](const std::shared_ptr<Chunk>& chunk) { outcome.row.take(*chunk); });
  outcome.lost = lost;
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
  CellDesk desk;
  EXPECT_FALSE(desk.help());  // nothing is at work
  std::atomic<bool> over{false};
  std::atomic<int> helped{0};
  std::thread helper([&] {
    while (!over) helped += desk.help();
  });
  CellDesk::Place place(desk, {});
  const Outcome outcome = compute({number_slowly, 1, nullptr, &place});
  over = true;
  helper.join();
  EXPECT_GT(helped, 0);
  EXPECT_FALSE(outcome.lost);
  EXPECT_EQ(outcome.row.first_wrong(limit), std::nullopt);
  EXPECT_FALSE(desk.help());
}

// Some are lent and come back decided, some come back undecided, one comes back when all is over.
TEST(Chunks, AreLentAndTakenBack) {
  CellDesk desk;
  const CellAtWork cell{.cell = 3,
                        .start = {.warm_start_states = {{1.0}}, .warm_start = true, .warm_start_levels = {}},
                        .method = SamplingMethod::random};
  std::atomic<bool> over{false};
  std::thread other([&] {
    for (std::size_t k = 0; !over; ++k) {
      const auto task = desk.newest();
      const auto loan = task ? desk.lend(task->number) : std::nullopt;
      if (!loan) {
        std::this_thread::yield();
        continue;
      }
      EXPECT_EQ(task->at, cell);
      Chunk made;
      made.first = loan->first;
      made.count = loan->count;
      if (k % 3 != 0) number(made);
      desk.give_back(loan->number, std::move(made));
    }
  });
  auto place = std::make_unique<CellDesk::Place>(desk, cell);
  const Outcome outcome = compute({number_slowly, 2, nullptr, place.get()});
  over = true;
  other.join();
  EXPECT_GT(outcome.row.from_elsewhere, 0u);
  EXPECT_FALSE(outcome.lost);
  EXPECT_EQ(outcome.row.first_wrong(limit), std::nullopt);
  desk.give_back(1, {});  // too late: nothing happens
  place.reset();
  EXPECT_FALSE(desk.newest());
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
