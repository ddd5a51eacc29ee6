// What long work records, and what it gets back: the same bits or nothing.
#include "equipoise/core/running/search_log.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "../support/studies.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/motions/motion_bytes.hpp"
#include "equipoise/results/io/journal.hpp"
#include "equipoise/results/io/store.hpp"
#include "equipoise/simulation/rule/pilot.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace search_log_test {

// As bytes read back and written again; empty if that is not whole.
template <class T>
std::vector<char> again(const std::vector<char>& bytes) {
  T value{};
  BytesIn in(bytes);
  in(value);
  return in.whole() ? bytes_of(value) : std::vector<char>{};
}

// Every note of a run, by page and number.
using Kept = std::map<std::pair<std::uint64_t, std::uint64_t>, std::vector<char>>;
SearchLog::Keep into(Kept& kept) {
  return [&kept](std::uint64_t page, std::uint64_t number, const std::vector<char>& answer) {
    kept[{page, number}] = answer;
  };
}

TEST(Bytes, GiveBackAMotion) {
  const Study study = parse_study(constant_speed, "notes.toml");
  Eigen::VectorXd state = Eigen::VectorXd::Zero(8);
  state << 0.0, 0.0, 0.0, 0.0, 0.1, 0.2, -1.6, -1.6;
  const auto motion = motion_from(study.system(), state);
  ASSERT_TRUE(motion && motion->kind == MotionKind::periodic);
  const std::vector<char> bytes = bytes_of(motion);
  EXPECT_EQ(again<std::optional<Motion>>(bytes), bytes);
  std::optional<Motion> back;
  BytesIn in(bytes);
  in(back);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->state, motion->state);
  EXPECT_EQ(back->orbit.nodes, motion->orbit.nodes);
  EXPECT_EQ(back->orbit.multipliers, motion->orbit.multipliers);
  EXPECT_EQ(back->exponents, motion->exponents);
  EXPECT_EQ(back->drift_group, motion->drift_group);
  EXPECT_EQ(motion_name(study.parameters, *back).name, motion_name(study.parameters, *motion).name);
}

TEST(Bytes, GiveBackARecordOfThePilot) {
  PilotRecord record;
  for (int k = 0; k < feature_count(2); ++k) record.features[k] = 0.1 * k, record.range.high[k] = 1.0 / (1 + k);
  record.range.trend = 3;
  record.finished_window = true;
  record.longest_run[5] = 7;
  record.least_value = 1e-7;
  const std::vector<char> bytes = bytes_of(record);
  EXPECT_LT(bytes.size(), sizeof record / 2);
  EXPECT_EQ(again<PilotRecord>(bytes), bytes);
  PilotRecord back;
  back.longest_run.fill(9);
  BytesIn in(bytes);
  in(back);
  EXPECT_EQ(back.features, record.features);
  EXPECT_EQ(back.longest_run, record.longest_run);
  EXPECT_EQ(back.range.trend, 3);
}

// Only the exact length is accepted.
TEST(Bytes, AreRefusedIfCutOffOrSpoilt) {
  const std::vector<std::vector<double>> lists{{1.0, 2.0}, {}, {3.0}};
  const std::vector<char> bytes = bytes_of(lists);
  ASSERT_EQ(again<std::vector<std::vector<double>>>(bytes), bytes);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_TRUE(
        again<std::vector<std::vector<double>>>({bytes.begin(), bytes.begin() + static_cast<long>(length)}).empty());
  std::vector<char> longer = bytes, huge = bytes;
  longer.push_back(0);
  EXPECT_TRUE(again<std::vector<std::vector<double>>>(longer).empty());
  huge[7] = 0x7f;  // more lists than any memory holds
  EXPECT_TRUE(again<std::vector<std::vector<double>>>(huge).empty());
}

// A note comes from a file, whose checksum does not say who wrote it.
TEST(Bytes, AreRefusedIfTheyHoldNoTruthOrNoneOfTheEnumerated) {
  std::vector<char> truth = bytes_of(true), outcome = bytes_of(Outcome{});
  EXPECT_EQ(again<bool>(truth), truth);
  EXPECT_EQ(again<Outcome>(outcome), outcome);
  truth[0] = 2;
  EXPECT_TRUE(again<bool>(truth).empty());
  for (const char kind : {-1, 5, 127}) {
    outcome[0] = kind;
    EXPECT_TRUE(again<Outcome>(outcome).empty()) << int{kind};
  }
}

TEST(Bytes, OfAMotionMustFitItsSystem) {
  const Study study = parse_study(constant_speed, "notes.toml");
  Eigen::VectorXd state = Eigen::VectorXd::Zero(8);
  state << 0.0, 0.0, 0.0, 0.0, 0.1, 0.2, -1.6, -1.6;
  const auto motion = motion_from(study.system(), state);
  ASSERT_TRUE(motion);
  const auto fits = [&](void (*change)(Motion&)) {
    Motion changed = *motion;
    change(changed);
    return fits_system(study.system(), changed);
  };
  EXPECT_TRUE(fits([](Motion&) {}));
  EXPECT_FALSE(fits([](Motion& m) { m.state.conservativeResize(7); }));
  EXPECT_FALSE(fits([](Motion& m) { m.orbit.nodes.back().resize(0); }));
  EXPECT_FALSE(fits([](Motion& m) { m.orbit.nodes.clear(); }));
  EXPECT_FALSE(fits([](Motion& m) { m.spectrum.setZero(1000); }));
  EXPECT_FALSE(fits([](Motion& m) { m.cluster[0] = 1000; }));
  EXPECT_FALSE(fits([](Motion& m) { m.drift_group[1] = -1; }));
  EXPECT_FALSE(fits([](Motion& m) { m.mode.order[0] = 16; }));
  EXPECT_FALSE(fits([](Motion& m) { m.events.push_back({1.0, BallEventKind::strike, 7, 1}); }));
  EXPECT_FALSE(fits([](Motion& m) { m.motor.emplace(); }));
}

TEST(SearchLog, AreComputedIfWhatIsKnownDoesNotFit) {
  SearchLog known;
  Kept kept;
  SearchLog notes(into(kept));
  const auto ask = [](SearchLog& log, std::size_t size) {
    return NotePage(&log, "this")
        .answer(
            "many", nullptr, [&] { return std::vector<double>(size, 1.0); },
            [&](const std::vector<double>& list) { return list.size() == size; });
  };
  EXPECT_EQ(ask(notes, 2).size(), 2u);
  for (const auto& [where, answer] : kept) known.know(where.first, where.second, answer);
  EXPECT_EQ(ask(known, 3).size(), 3u);
}

TEST(SearchLog, AreAnswersToTheSameQuestionsInTheSameOrder) {
  Kept kept;
  int worked = 0;
  const auto ask = [&](SearchLog& notes, const std::string& subject, const char* second) {
    NotePage page(&notes, subject);
    const double one = page.answer("one", nullptr, [&] { return ++worked, 1.5; });
    const auto many = page.answer(second, nullptr, [&] { return ++worked, std::vector<double>{2.0, 3.0}; });
    return std::pair{one, many};
  };
  SearchLog first(into(kept));
  const auto answers = ask(first, "this", "many");
  EXPECT_EQ(worked, 2);
  EXPECT_EQ(kept.size(), 2u);
  const auto known = [&] {
    auto notes = std::make_unique<SearchLog>();
    for (const auto& [where, answer] : kept) notes->know(where.first, where.second, answer);
    return notes;
  };
  EXPECT_EQ(ask(*known(), "this", "many"), answers);
  EXPECT_EQ(worked, 2);
  EXPECT_EQ(ask(*known(), "this", "others"), answers);  // another question is computed
  EXPECT_EQ(worked, 3);
  EXPECT_EQ(ask(*known(), "that", "many"), answers);
  EXPECT_EQ(worked, 5);
}

TEST(SearchLog, AreNotTakenOfWorkThatWasStopped) {
  Kept kept;
  SearchLog notes(into(kept));
  NotePage page(&notes, "stopped");
  StopFlag stop{false};
  const auto cut_short = [&] {
    stop = true;
    return 1;
  };
  EXPECT_EQ(page.answer("whole", &stop, [] { return 2; }), 2);
  EXPECT_EQ(page.answer("cut short", &stop, cut_short), 1);
  EXPECT_EQ(kept.size(), 1u);
}

// Short work is recorded only if it is abandoned.
TEST(SearchLog, AreKeptOnceTheyAreWorthIt) {
  constexpr double for_ever = 1e9;
  const auto ask_twice = [](NotePage& page) {
    page.answer("one", nullptr, [] { return 1; });
    page.answer("two", nullptr, [] { return 2; });
  };
  Kept kept;
  SearchLog notes(into(kept), for_ever);
  {
    NotePage page(&notes, "done");
    ask_twice(page);
    page.finish();
  }
  EXPECT_TRUE(kept.empty());
  {
    NotePage page(&notes, "given up");
    ask_twice(page);
    EXPECT_TRUE(kept.empty());
  }
  EXPECT_EQ(kept.size(), 2u);
  SearchLog soon(into(kept), 0.0);
  NotePage page(&soon, "at once");
  ask_twice(page);
  EXPECT_EQ(kept.size(), 4u);
}

// A store of records of one kind.
struct RecordStore : io::Store {
  explicit RecordStore(const std::string& path) : Store(path, "mine", {"results", "must be others"}) {}
  void append() {
    const std::vector<double> result{1.0, 2.0};
    Store::append({.kind = io::Journal::Kind::starts, .first = 0, .count = 2}, result.data(), 16);
  }
};

TEST(SearchLog, AreKeptAmongUnfinishedResults) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("equipoise_notes_" + std::to_string(getpid()))).string();
  const auto ask = [](SearchLog& notes, double value) {
    return NotePage(&notes, "kept").answer("value", nullptr, [&] { return value; });
  };
  const auto records = [&] { return io::Journal(path + ".part").records().size(); };
  const auto nothing = [](const std::string&) {};
  {
    RecordStore kept(path);
    kept.append();
    EXPECT_EQ(ask(kept.notes(), 3.0), 3.0);
    kept.append();
  }
  EXPECT_EQ(records(), 3u);
  {
    RecordStore kept(path);
    EXPECT_EQ(ask(kept.notes(), 4.0), 3.0);  // as recorded
    kept.finish(nothing, io::Store::Rest::notes);
  }
  EXPECT_EQ(records(), 1u);
  {
    RecordStore kept(path);
    EXPECT_EQ(ask(kept.notes(), 4.0), 3.0);
    kept.finish(nothing, io::Store::Rest::nothing);
  }
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

}  // namespace search_log_test
}  // namespace equipoise
