// The journal's file: header, records, damage passed over.
#include "equipoise/results/io/journal.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/results/io/checksum.hpp"
#include "equipoise/results/io/replacement.hpp"

namespace equipoise::io {

namespace {

constexpr char changed_by_another[] = "{}: another program has changed this file; nothing more is kept in it";

// Numbers are in the machine's byte order; on a machine of the other order the marks do not match.
constexpr std::uint64_t file_mark = 0x314C4E524A505145, record_mark = 0x3144524F43455245;

struct FileHeader {
  std::uint64_t mark = file_mark, bytes = 0, checksum = 0;
};

struct RecordHeader {
  std::uint64_t mark = record_mark, kind = 0, first = 0, count = 0;
  double seconds = 0.0, cpu_seconds = 0.0;
  std::uint64_t bytes = 0, checksum = 0;  // over everything before it, and the payload
};
constexpr std::size_t summed = sizeof(RecordHeader) - sizeof(std::uint64_t);

// Time between two syncs: little work is lost. Syncs take a hundredth of the time at most.
constexpr std::chrono::seconds sync_every{1};
constexpr int sync_rest = 100;

// The header at `begin`, of a record that fits into the first `end` bytes of the file.
std::optional<RecordHeader> fitting_header(const DiskFile& file, std::uint64_t begin, std::uint64_t end) {
  RecordHeader header;
  if (end < begin || end - begin < sizeof header || !file.read_at(begin, &header, sizeof header)) return {};
  if (header.mark != record_mark || header.bytes > end - begin - sizeof header) return {};
  return header;
}

std::uint64_t sum_of(const std::string& text) {
  Checksum sum;
  sum.add(text.data(), text.size());
  return sum.value();
}

bool is_sound(const DiskFile& file, std::uint64_t begin, const RecordHeader& header) {
  Checksum sum;
  sum.add(&header, summed);
  return file.add_to(sum, begin + sizeof header, header.bytes) && sum.value() == header.checksum;
}

}  // namespace

Journal::Journal(const std::string& path, const std::string& output, const std::string& identity)
    : path_(path), synced_(std::chrono::steady_clock::now()) {
  open_locked(output);
  const auto there = file_.size();
  if (!there) throw RunError(path_ + ": cannot be read");
  const std::uint64_t size = *there;
  try {
    read_header(identity, size);
    if (end_ > 0) read_records(size);
  } catch (...) {
    if (size == 0) (void)remove_file(path_);
    throw;
  }
  spoilt_ = size > end_;
  if (mended_) (void)file_.write_at(0, header().data(), header().size());
}

Journal::Journal(const std::string& path) : path_(path), only_reads_(true) {
  if (existing(path).special()) throw InputError(path, "", "", "cannot be read: not a regular file");
  const int error = file_.open(path, DiskFile::Open::read);
  const auto there = file_.size();
  if (error != 0 || !there) throw InputError(path, "", "", fmt::format("cannot be read: {}", error_text(error)));
  read_header("", *there);
  if (end_ > 0) read_records(*there);
}

Journal::~Journal() {
  const bool damaged = end_ > 0 && spoilt_;
  if (!only_reads_ && file_.is_open() && records_.empty() && !damaged) (void)remove_file(path_);
}

// The lock ends with the process. If the file's last owner removed it before it was locked here, it is opened again.
void Journal::open_locked(const std::string& output) {
  if (existing(path_).special()) throw InputError(path_, "", "", "is not a regular file; must be one, or absent");
  for (;;) {
    if (const int error = file_.open(path_, DiskFile::Open::update))
      throw InputError("output", "", "",
                       fmt::format("{}: {} (must be a file that can be written)", path_, error_text(error)));
    if (!file_.lock())
      throw InputError(output, "", "",
                       "is being written by another process; must be a file that no other run writes to");
    if (file_.is_named(path_)) return;
  }
}

void Journal::read_header(const std::string& identity, std::uint64_t size) {
  FileHeader header;
  const std::size_t there = std::min<std::uint64_t>(size, sizeof header);
  if (!file_.read_at(0, &header, there)) throw RunError(path_ + ": cannot be read");
  const auto text = [&](std::uint64_t bytes) {
    std::string read(std::min(bytes, size - there), '\0');
    return file_.read_at(there, read.data(), read.size()) ? read : "";
  };
  const bool marked = std::memcmp(&header, &file_mark, std::min(there, sizeof file_mark)) == 0;
  identity_ = text(header.bytes);
  const bool sound =
      marked && there == sizeof header && header.bytes == identity_.size() && header.checksum == sum_of(identity_);
  if (!sound) {
    const bool cut = header.bytes == identity.size() && size - there < header.bytes;
    const bool begun = marked && (there < sizeof header || cut);
    identity_ = identity;
    if (begun) {  // new, or its writer was killed at once
      lost_ = size;
      return;
    }
    // Damage in one place leaves either the identity's text or its checksum.
    const bool summed_up = header.bytes == identity.size() && header.checksum == sum_of(identity);
    mended_ = !identity.empty() && there == sizeof header && (summed_up || text(identity.size()) == identity);
  }
  end_ = sizeof header + identity_.size();
  if (sound || mended_) return;
  if (!marked)
    throw InputError(path_, "", "", "is not a file of results (.nc, .nc.part), or is damaged; must be another file");
  end_ = sizeof header;
  read_records(size);
  throw InputError(
      path_, "", "",
      fmt::format("is damaged in the part that names its results, with {} sound record{} behind it; must be "
                  "given to the command that wrote it, or renamed",
                  records_.size(), plural(records_.size())));
}

std::vector<char> Journal::header() const {
  const FileHeader header{file_mark, identity_.size(), sum_of(identity_)};
  std::vector<char> bytes(sizeof header + identity_.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, identity_.data(), identity_.size());
  return bytes;
}

// Brings the file and its name to disk before any result relies on them.
void Journal::write_header() {
  write(header());
  sync();
  (void)to_disk(std::filesystem::path(path_).parent_path().string());
}

// Where the mark of a record is next, at `from` or behind it; `size` if nowhere.
std::uint64_t Journal::next_mark(std::uint64_t from, std::uint64_t size) const {
  std::string mark(sizeof record_mark, '\0');
  std::memcpy(mark.data(), &record_mark, mark.size());
  std::string block(mark.size(), '\0');  // mostly it is there
  while (from <= size && size - from >= mark.size()) {
    block.resize(std::min<std::uint64_t>(block.size(), size - from));
    if (!file_.read_at(from, block.data(), block.size())) break;
    if (const std::size_t at = block.find(mark); at != std::string::npos) return from + at;
    from += block.size() - (mark.size() - 1);
    block.resize(1 << 20);
  }
  return size;
}

void Journal::read_records(std::uint64_t size) {
  // A file made of marks must not be summed up again from each.
  constexpr std::uint64_t most_readings = 16;
  std::uint64_t in_vain = 0;
  for (std::uint64_t at = end_; (at = next_mark(at, size)) < size && in_vain <= most_readings * size;) {
    const auto header = fitting_header(file_, at, size);
    if (!header || !is_sound(file_, at, *header)) {
      in_vain += header ? header->bytes : 0;
      ++at;
      continue;
    }
    lost_ += at - end_;
    const std::uint64_t payload = at + sizeof *header;
    records_.push_back({static_cast<Kind>(header->kind), header->first, header->count, header->seconds,
                        header->cpu_seconds, payload, header->bytes});
    at = end_ = payload + header->bytes;
  }
  lost_ += size - end_;
}

std::string Journal::loss() const {
  std::string text = mended_ ? "the part that names its results was damaged, and is written again" : "";
  if (lost_ > 0)
    text += fmt::format("{}{} bytes are damaged or cut off; what they held is lost, and all other records are used",
                        text.empty() ? "" : "; ", lost_);
  return text;
}

void Journal::read(const Record& record, std::uint64_t offset, std::size_t bytes, void* data) const {
  if (offset > record.bytes || bytes > record.bytes - offset || !file_.read_at(record.payload + offset, data, bytes))
    throw RunError(path_ + ": cannot be read");
}

// None behind a header that is no longer the same.
std::size_t Journal::sound_records() const {
  std::vector<char> begin = header();
  if (!file_.read_at(0, begin.data(), begin.size()) || begin != header()) return 0;
  return static_cast<std::size_t>(std::count_if(records_.begin(), records_.end(), [this](const Record& record) {
    const std::uint64_t at = record.payload - sizeof(RecordHeader);
    const auto there = fitting_header(file_, at, record.end());
    return there && there->bytes == record.bytes && is_sound(file_, at, *there);
  }));
}

std::string Journal::kept() const {
  const std::lock_guard lock(appending_);
  if (records_.empty()) return "nothing is kept yet";
  if (const std::size_t sound = sound_records(); sound < records_.size())
    return fmt::format("{} of its {} records are kept", sound, records_.size());
  return fmt::format("what was computed is kept in {}, and the same command resumes from it", path_);
}

void Journal::require_sound() const {
  if (sound_records() < records_.size()) throw RunError(fmt::format(changed_by_another, path_));
}

Journal::Record Journal::append(Record record, const void* payload, std::size_t bytes) {
  const std::lock_guard lock(appending_);
  RecordHeader header;
  header.kind = static_cast<std::uint64_t>(record.kind);
  header.first = record.first;
  header.count = record.count;
  header.seconds = record.seconds;
  header.cpu_seconds = record.cpu_seconds;
  header.bytes = bytes;
  Checksum sum;
  sum.add(&header, summed);
  sum.add(payload, bytes);
  header.checksum = sum.value();
  std::vector<char> text(sizeof header + bytes);
  std::memcpy(text.data(), &header, sizeof header);
  if (bytes > 0) std::memcpy(text.data() + sizeof header, payload, bytes);
  if (end_ == 0) write_header();
  record.payload = end_ + sizeof header;
  record.bytes = bytes;
  write(text);
  records_.push_back(record);
  const auto rest = std::max<std::chrono::steady_clock::duration>(sync_every, sync_rest * sync_took_);
  if (std::chrono::steady_clock::now() - synced_ >= rest) sync();
  return record;
}

// A partial write is undone.
void Journal::write(const std::vector<char>& bytes) {
  if (file_.size().value_or(end_) < end_) throw RunError(fmt::format(changed_by_another, path_));
  int error = spoilt_ ? file_.cut(end_) : 0;
  if (error == 0) error = file_.write_at(end_, bytes.data(), bytes.size());
  spoilt_ = false;
  if (error == 0) {
    end_ += bytes.size();
    return;
  }
  (void)file_.cut(end_);
  throw RunError(fmt::format("{}: cannot be written: {}", path_, error_text(error)));
}

void Journal::sync() {
  const auto begin = std::chrono::steady_clock::now();
  if (const int error = file_.to_disk(false))
    throw RunError(fmt::format("{}: cannot be written: {}", path_, error_text(error)));
  synced_ = std::chrono::steady_clock::now();
  sync_took_ = synced_ - begin;
}

void Journal::remove() {
  (void)remove_file(path_);
  (void)file_.close();
}

void Journal::keep_only(Kind kind) {
  std::vector<std::pair<Record, std::vector<char>>> kept;
  for (const Record& record : records_) {
    if (record.kind != kind) continue;
    auto& [copy, payload] = kept.emplace_back(record, std::vector<char>(record.bytes));
    read(copy, 0, payload.size(), payload.data());
  }
  if (kept.empty()) return remove();
  records_.clear();
  end_ = sizeof(FileHeader) + identity_.size();
  lost_ = 0;
  spoilt_ = true;  // the first record overwrites everything after the header
  try {
    for (const auto& [record, payload] : kept) append(record, payload.data(), payload.size());
    sync();
  } catch (const RunError&) {  // a full disk: no one had requested what is lost
    remove();
  }
}

}  // namespace equipoise::io
