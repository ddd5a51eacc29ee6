// Files of results under faults: cut off, damaged, a full disk, two writers; every prefix of a journal can be read.
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../support/refusals.hpp"
#include "../support/files.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/io/checksum.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/io/journal.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {
namespace store_test {

namespace fs = std::filesystem;

void overwrite(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

// In place: truncating a file and writing it again waits for the disk on some file systems.
void flip_bit(const std::string& path, std::size_t at) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(static_cast<std::streamoff>(at));
  const char byte = static_cast<char>(file.get() ^ (1 << (at % 8)));
  file.seekp(static_cast<std::streamoff>(at));
  file.put(byte);
}

class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "equipoise_store_" + std::to_string(getpid());
    fs::create_directories(folder_);
    path_ = folder_ + "/result.nc";
    part_ = path_ + ".part";
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string folder_, path_, part_;
};

// No file of this process may grow beyond `bytes`: writing then fails as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

BasinFileHeader header_of(const std::string& drag = "0.05") {
  BasinFileHeader header;
  header.study = "[balancer]\nballs = 2\ndrag = " + drag + "\n\n[sampling]\nseed = 1\n";
  header.cpu_target = "AVX2";
  header.arithmetic = "fused";
  header.variables = {"x", "y", "u", "v", "phi_1", "phi_2", "phi_dot_1", "phi_dot_2"};
  return header;
}

// A outcome unlike any other start's.
Outcome outcome_of(std::uint64_t i) {
  Outcome outcome;
  outcome.kind = i % 5 == 0 ? OutcomeKind::undecided : OutcomeKind::attracted;
  outcome.attractor = i % 5 == 0 ? 0 : static_cast<short>(1 + i % 3);
  outcome.by = i % 5 == 0 ? DecidedBy::nothing : DecidedBy::windows;
  outcome.time = 0.5 * static_cast<double>(i);
  return outcome;
}

void append(BasinFile& file, std::size_t count) {
  StartArrays starts;
  starts.starts = count;
  for (std::uint64_t i = file.stored(); i < file.stored() + count; ++i) {
    starts.phi.insert(starts.phi.end(), {static_cast<double>(i), -static_cast<double>(i)});
    starts.outcome.push_back(code_of(outcome_of(i)));
    starts.decision_time.push_back(outcome_of(i).time);
    starts.decided_by.push_back(static_cast<signed char>(outcome_of(i).by));
  }
  file.append(starts, {0.25, 0.5});
}

void expect_starts(const BasinFile& file, std::uint64_t count) {
  ASSERT_EQ(file.stored(), count);
  const StartArrays starts = file.read(0, count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Outcome expected = outcome_of(i), outcome = *outcome_of(starts, i);
    ASSERT_EQ(outcome.kind, expected.kind) << i;
    ASSERT_EQ(outcome.attractor, expected.attractor) << i;
    ASSERT_EQ(outcome.by, expected.by) << i;
    ASSERT_EQ(outcome.time, expected.time) << i;
    ASSERT_EQ(starts.phi[2 * i + 1], -static_cast<double>(i)) << i;
  }
}

std::vector<OutcomeShare> summary_of(std::uint64_t count) {
  return {{1, "balanced", "", wilson_share(count / 2, count)}, {0, "undecided", "", wilson_share(count / 5, count)}};
}

std::string refusal(const std::string& path, const BasinFileHeader& header) {
  return refusal_text([&] { BasinFile file(path, header); });
}

TEST(Checksum, SeesEveryChangeOfASingleByteWhateverThePieces) {
  std::string text(1000, '\0');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * 37);
  io::Checksum whole;
  whole.add(text.data(), text.size());
  for (const std::size_t piece : {1, 3, 8, 13, 64}) {
    io::Checksum sum;
    for (std::size_t at = 0; at < text.size(); at += piece)
      sum.add(text.data() + at, std::min(piece, text.size() - at));
    EXPECT_EQ(sum.value(), whole.value()) << piece;
  }
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string other = text;
    other[at] ^= static_cast<char>(1 << (at % 8));
    io::Checksum sum;
    sum.add(other.data(), other.size());
    EXPECT_NE(sum.value(), whole.value()) << at;
  }
  io::Checksum longer = whole;
  longer.add("", 1);  // one byte of 0
  EXPECT_NE(longer.value(), whole.value());
}

TEST_F(Files, AJournalCutAnywhereInItsLastRecordEndsBeforeItAndGoesOn) {
  std::uint64_t before = 0;
  {
    BasinFile file(path_, header_of());
    append(file, 7);
    append(file, 5);
    before = fs::file_size(part_);
    append(file, 3);
  }
  const std::string whole = content(part_);
  ASSERT_GT(whole.size(), before);
  for (std::size_t size = before; size <= whole.size(); ++size) {
    overwrite(part_, whole.substr(0, size));
    BasinFile file(path_, header_of());
    expect_starts(file, size == whole.size() ? 15 : 12);
    append(file, 4);
    expect_starts(file, size == whole.size() ? 19 : 16);
  }
  BasinFile file(path_, header_of());
  expect_starts(file, 19);
}

TEST_F(Files, AJournalCutAnywhereIsReadOrRefused) {
  {
    BasinFile file(path_, header_of());
    append(file, 6);
    file.append_attractor_search(std::vector<double>(8, 1.5));
    append(file, 6);
  }
  const std::string whole = content(part_);
  std::uint64_t most = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    overwrite(part_, whole.substr(0, size));
    BasinFile file(path_, header_of());  // resumes after a kill at any moment
    EXPECT_GE(file.stored(), most);
    most = file.stored();
    expect_starts(file, most);
  }
  EXPECT_EQ(most, 12u);
}

TEST_F(Files, AJournalWithAnyByteSpoiltGivesNothingButWhatWasWritten) {
  {
    BasinFile file(path_, header_of());
    append(file, 6);
    file.append_attractor_search(std::vector<double>(8, 1.5));
    append(file, 6);
  }
  const std::string whole = content(part_);
  const std::size_t header_size = 24 + io::identity_of(header_of()).size();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string spoilt = whole;
    spoilt[at] ^= static_cast<char>(1 << (at % 8));
    overwrite(part_, spoilt);
    {
      const BasinFile file(path_, header_of());
      const bool all = file.stored() == 12 && file.discoveries().size() == 1 && file.cpu_targets().size() == 1;
      EXPECT_EQ(all, at < header_size) << at;  // the results are recognised; every other byte matters
      EXPECT_NE(file.loss(), "") << at;
      expect_starts(file, file.stored());
    }
    if (at < header_size) {
      EXPECT_EQ(BasinFile(path_, header_of()).loss(), "") << at;  // written again
      overwrite(part_, spoilt);
      EXPECT_THROW(BasinFile(path_, header_of("0.06")), InputError) << at;  // of another study, nothing is changed
      EXPECT_EQ(content(part_), spoilt) << at;
    }
  }
}

TEST_F(Files, ResultsAreFinishedExtendedAndReadAgain) {
  {
    BasinFile file(path_, header_of());
    append(file, 100);
    file.append_attractor_search(std::vector<double>(8, 2.5));
    EXPECT_EQ(file.unfinished(), 100u);
    file.finish({"starts = 100", summary_of(100), true, {1.0, 2.0}});
  }
  EXPECT_FALSE(fs::exists(part_));
  {
    BasinFile file(path_, header_of());
    expect_starts(file, 100);
    EXPECT_TRUE(file.complete());
    EXPECT_EQ(file.unfinished(), 0u);
    EXPECT_EQ(file.discoveries().size(), 1u);
    EXPECT_EQ(file.cpu_targets(), std::vector<std::string>{"AVX2"});
    append(file, 50);
    EXPECT_FALSE(file.complete());
    expect_starts(file, 150);
  }
  BasinFileHeader elsewhere = header_of();
  elsewhere.cpu_target = "AVX-512";  // the same arithmetic
  BasinFile file(path_, elsewhere);
  expect_starts(file, 150);
  append(file, 1);
  file.finish({"starts = 151", summary_of(151), true, {1.0, 2.0}});
  BasinFile again(path_, header_of());
  expect_starts(again, 151);
  EXPECT_EQ(again.discoveries(), std::vector<std::vector<double>>{std::vector<double>(8, 2.5)});
  EXPECT_EQ(again.cpu_targets(), (std::vector<std::string>{"AVX2", "AVX-512"}));
  // This run's second, and the quarter second that the last record states for the unfinished earlier run.
  EXPECT_EQ(again.time().seconds, 1.0 + 0.25 + 1.0);
  const std::vector<OutcomeShare> summary = again.summary();
  ASSERT_EQ(summary.size(), 2u);
  EXPECT_EQ(summary[1].name, "undecided");
  EXPECT_EQ(summary[0].share.count, 75u);
  EXPECT_EQ(summary[0].share.total, 151u);
}

// Killed after the results were put in place and before the journal was removed.
TEST_F(Files, AJournalThatIsNoLongerNeededAddsNothing) {
  std::string journal;
  {
    BasinFile file(path_, header_of());
    append(file, 10);
    file.append_attractor_search(std::vector<double>(8, 2.5));
    append(file, 10);
    journal = content(part_);
    file.finish({"", summary_of(20), true, {}});
  }
  overwrite(part_, journal);
  BasinFile file(path_, header_of());
  expect_starts(file, 20);
  EXPECT_EQ(file.unfinished(), 0u);
  EXPECT_EQ(file.discoveries().size(), 1u);
}

// One flipped bit costs one record.
TEST_F(Files, StartsBehindDamageAreUsedOnceTheGapIsFilled) {
  std::vector<std::uint64_t> ends;
  {
    BasinFile file(path_, header_of());
    for (int k = 0; k < 4; ++k) append(file, 6), ends.push_back(fs::file_size(part_));
  }
  flip_bit(part_, ends[0] + 100);
  for (const bool filled : {false, true}) {
    BasinFile file(path_, header_of());
    EXPECT_NE(file.loss().find(filled ? "damaged" : "6 starts are missing, from number 6 on"), std::string::npos)
        << file.loss();
    expect_starts(file, filled ? 24 : 6);
    EXPECT_EQ(file.stored_next(), filled ? std::numeric_limits<std::uint64_t>::max() : 12u);
    if (filled) break;
    append(file, 4);
    expect_starts(file, 10);
    append(file, 2);
    expect_starts(file, 24);
  }
  {
    BasinFile file(path_, header_of());
    file.finish({"", summary_of(24), true, {}});
    EXPECT_FALSE(fs::exists(part_));
  }
  expect_starts(BasinFile(path_, header_of()), 24);
}

// Results of the starts before a gap leave what is behind it in the journal.
TEST_F(Files, StartsBehindAGapThatIsNotFilledStay) {
  std::uint64_t first_end = 0;
  {
    BasinFile file(path_, header_of());
    append(file, 6);
    first_end = fs::file_size(part_);
    append(file, 6);
    append(file, 6);
  }
  flip_bit(part_, first_end + 100);
  {
    BasinFile file(path_, header_of());
    file.finish({"", summary_of(6), true, {}});
  }
  BasinFile file(path_, header_of());
  expect_starts(file, 6);
  append(file, 6);
  expect_starts(file, 18);
}

// A file that is all marks is not summed up again from each of them.
TEST_F(Files, AJournalOfMarksAloneIsReadInTime) {
  { io::Journal(part_, path_, "mine").append({.kind = io::Journal::Kind::cell, .first = 0, .count = 1}, "abc", 3); }
  const std::string record = content(part_).substr(fs::file_size(part_) - 3 - 64, 64);
  std::string marks = content(part_);
  constexpr std::size_t count = 40000;
  for (std::size_t k = 0; k < count; ++k) {
    std::string one = record;
    const std::uint64_t claimed = (count - k - 1) * one.size();
    std::memcpy(one.data() + 48, &claimed, sizeof claimed);
    marks += one;
  }
  overwrite(part_, marks);
  EXPECT_EQ(io::Journal(part_).records().size(), 1u);
}

TEST_F(Files, AJournalThatGoesOnElsewhereIsUsedOnceTheStartsBeforeItAreThere) {
  {
    BasinFile file(path_, header_of());
    append(file, 10);
    file.finish({"", summary_of(10), true, {}});
  }
  const std::string ten = content(path_);
  {
    BasinFile file(path_, header_of());
    append(file, 10);
  }
  fs::remove(path_);
  {
    BasinFile file(path_, header_of());
    expect_starts(file, 0);
    EXPECT_EQ(file.stored_next(), 10u);
  }
  overwrite(path_, ten);
  expect_starts(BasinFile(path_, header_of()), 20);
}

TEST_F(Files, DamagedResultsAreRefusedWhateverIsDamaged) {
  {
    BasinFile file(path_, header_of());
    append(file, 40);
    file.finish({"", summary_of(40), true, {}});
  }
  const std::string whole = content(path_);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    flip_bit(path_, at);
    ASSERT_NE(refusal(path_, header_of()), "") << at;
    flip_bit(path_, at);
  }
  EXPECT_EQ(content(path_), whole);
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    overwrite(path_, whole.substr(0, size));
    ASSERT_NE(refusal(path_, header_of()), "") << size;
  }
  overwrite(path_, whole + "x");
  EXPECT_NE(refusal(path_, header_of()), "");
  overwrite(path_, whole);
  EXPECT_EQ(refusal(path_, header_of()), "");
}

TEST_F(Files, ARefusalSaysWhatDiffers) {
  {
    BasinFile file(path_, header_of());
    append(file, 10);
    file.finish({"", summary_of(10), true, {}});
  }
  EXPECT_NE(refusal(path_, header_of("0.06")).find("balancer.drag is 0.05 there and 0.06 here"), std::string::npos);
  BasinFileHeader other = header_of();
  other.arithmetic = "plain";
  EXPECT_NE(refusal(path_, other).find("arithmetic is fused there and plain here"), std::string::npos);
  other = header_of();
  other.angles = false;
  EXPECT_NE(refusal(path_, other).find("angles"), std::string::npos);
  other = header_of();
  other.transients = TransientSettings{};
  EXPECT_NE(refusal(path_, other).find("transients is none there"), std::string::npos);
  EXPECT_EQ(fs::exists(part_), false) << "a refusal leaves nothing behind";
}

TEST_F(Files, ASecondWriterIsRefusedAndTheFirstLosesNothing) {
  BasinFile first(path_, header_of());
  append(first, 10);
  EXPECT_NE(refusal(path_, header_of()).find("another process"), std::string::npos);
  append(first, 10);
  first.finish({"", summary_of(20), true, {}});
  BasinFile second(path_, header_of());
  expect_starts(second, 20);
}

TEST_F(Files, AFullDiskKeepsWhatIsThere) {
  {
    BasinFile file(path_, header_of());
    append(file, 1000);
    file.finish({"", summary_of(1000), true, {}});
  }
  const std::string finished = content(path_);
  std::uint64_t kept = 0;
  {
    const SmallDisk disk(20000);
    BasinFile file(path_, header_of());
    EXPECT_THROW(for (;;) append(file, 100), RunError);
    kept = file.stored();
    EXPECT_GT(kept, 1000u);
    EXPECT_THROW(file.finish({"", summary_of(kept), true, {}}), RunError);
    EXPECT_THROW(append(file, 100), RunError);  // and still works
  }
  EXPECT_EQ(content(path_), finished);
  EXPECT_FALSE(fs::exists(path_ + ".new"));
  BasinFile file(path_, header_of());
  expect_starts(file, kept);
  append(file, 100);
  file.finish({"", summary_of(kept + 100), true, {}});
  expect_starts(BasinFile(path_, header_of()), kept + 100);
}

TEST_F(Files, AFileIsReplacedWholeOrNotAtAll) {
  const std::string text(5000, 'a');
  io::write_whole(path_, "before");
  {
    const SmallDisk disk(1000);
    EXPECT_THROW(io::write_whole(path_, text), RunError);
  }
  EXPECT_EQ(content(path_), "before");
  io::write_whole(path_, text);
  EXPECT_EQ(content(path_), text);
  const std::string link = folder_ + "/link.nc";
  fs::create_symlink(path_, link);
  io::write_whole(link, "through the link");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(content(path_), "through the link");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2) << "nothing is left beside them";
}

TEST_F(Files, ANetcdfFileThatCannotBeWrittenLeavesTheOldOne) {
  const auto write = [&](double value, std::size_t count) {
    Dataset data("values");
    data.add("v", "1", "values", {data.dimension("n", count)}, [=](std::size_t) { return value; });
    io::write_netcdf_file(path_, data);
  };
  write(1.0, 10);
  const std::string before = content(path_);
  {
    const SmallDisk disk(4000);
    EXPECT_THROW(write(2.0, 10000), RunError);
  }
  EXPECT_EQ(content(path_), before);
  write(2.0, 10000);
  EXPECT_GT(fs::file_size(path_), 80000u);
}

// Two names of a file that is not there yet are one file: one lock, one result, and the link stays.
TEST_F(Files, ALinkToAFileThatIsNotThereYetLeadsToIt) {
  const std::string link = folder_ + "/link.nc", chain = folder_ + "/chain.nc";
  fs::create_symlink("result.nc", link);
  fs::create_symlink(link, chain);
  EXPECT_EQ(io::resolved(chain), io::resolved(path_));
  io::write_whole(chain, "through both");
  EXPECT_TRUE(fs::is_symlink(link) && fs::is_symlink(chain));
  EXPECT_EQ(content(path_), "through both");
  const std::string nowhere = folder_ + "/nowhere.nc", loop = folder_ + "/loop.nc";
  fs::create_symlink(folder_ + "/none/result.nc", nowhere);
  EXPECT_NE(io::why_not_writable(nowhere), "");
  fs::create_symlink(loop, loop);
  EXPECT_NE(io::why_not_writable(loop), "");
}

TEST_F(Files, WhereNothingCanBeWrittenIsSaid) {
  EXPECT_EQ(io::why_not_writable(path_), "");
  EXPECT_EQ(io::why_not_writable(folder_), "is a folder");
  EXPECT_EQ(io::why_not_writable(folder_ + "/a/b/c.nc"), "the folder " + folder_ + "/a/b does not exist");
  overwrite(path_, "a file");
  EXPECT_EQ(io::why_not_writable(path_ + "/c.nc"), path_ + " is not a folder");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

// What only reads a journal leaves it as it is, even if nothing in it can be used.
TEST_F(Files, ReadingAJournalKeepsIt) {
  {
    io::Journal journal(part_, path_, "mine");
    journal.append({.kind = io::Journal::Kind::cell, .first = 0, .count = 1}, "abcdefgh", 8);
  }
  flip_bit(part_, fs::file_size(part_) - 3);
  const std::string before = content(part_);
  { EXPECT_TRUE(io::Journal(part_).records().empty()); }
  EXPECT_EQ(content(part_), before);
  { EXPECT_TRUE(io::Journal(part_, path_, "mine").records().empty()); }  // nor what might have gone on from it
  EXPECT_EQ(content(part_), before);
  EXPECT_THROW(io::Journal(folder_ + "/none"), InputError);
  EXPECT_FALSE(fs::exists(folder_ + "/none"));
}

// Zeros once filled the place of what another program had cut off.
TEST_F(Files, AJournalCutByAnotherProgramIsNotedBeforeItIsUsed) {
  io::Journal journal(part_, path_, "mine");
  const std::string payload(1000, 'x');
  journal.append({.kind = io::Journal::Kind::cell, .first = 0, .count = 1}, payload.data(), payload.size());
  EXPECT_NO_THROW(journal.require_sound());
  fs::resize_file(part_, 100);
  EXPECT_THROW(journal.append({.kind = io::Journal::Kind::cell, .first = 1, .count = 1}, "a", 1), RunError);
  EXPECT_EQ(journal.kept(), "0 of its 1 records are kept");
  EXPECT_THROW(journal.require_sound(), RunError);
  fs::resize_file(part_, 5000);  // with zeros
  EXPECT_THROW(journal.require_sound(), RunError);
}

TEST_F(Files, AJournalWithAnImpossibleOutcomeIsRefusedByItsName) {
  {
    BasinFile file(path_, header_of());
    append(file, 6);
    StartArrays wrong;
    wrong.starts = 1;
    wrong.phi = {0.0, 1.0};
    wrong.outcome = {-77};
    wrong.decision_time = {1.0};
    wrong.decided_by = {0};
    file.append(wrong, {});
  }
  EXPECT_NE(refusal(path_, header_of()).find("result.nc.part: is damaged: start 6 has no valid outcome"),
            std::string::npos)
      << refusal(path_, header_of());
}

TEST_F(Files, APipeIsNotRemoved) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(part_.c_str(), 0600), 0);
  EXPECT_THROW(io::write_netcdf_file(path_, Dataset("nothing")), RunError);
  EXPECT_THROW(io::Journal(part_, path_, "mine"), InputError);
  EXPECT_THROW(io::Journal{part_}, InputError);
  EXPECT_NE(io::why_not_whole(path_), "");
  EXPECT_TRUE(fs::is_fifo(path_) && fs::is_fifo(part_));
}

TEST_F(Files, PlacesInTheNetworkAreNoFiles) {
  for (const char* place :
       {"http://127.0.0.1:9/result.nc", "https://127.0.0.1:9/result.nc#mode=bytes", "s3://bucket/result.nc"})
    EXPECT_THROW(io::NetcdfFile(place, io::NetcdfFile::Mode::read), RunError) << place;
}

}  // namespace store_test
}  // namespace equipoise
