// Results as they come: an append-only file beside the output, of which every prefix can be read.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace equipoise::store {

/// A header that says whose results these are, then records, each with the checksum of all it holds. A record is
/// written in one piece behind the last; what a kill or a full disk cut off, or a disk spoilt, fails its checksum, and
/// the journal ends before it. While a Journal is open no other process can open the same.
class Journal {
 public:
  /// What kind of thing a record holds; values are those in the file.
  enum class Kind : std::uint64_t {
    starts = 1,
    discovery = 2,
    cpu_target = 3,
    cell = 4,
    pixels = 5,
    outcome_name = 6,
    trial = 7,
    ensemble = 8,
    note = 9
  };
  struct Record {
    Kind kind = Kind::starts;
    std::uint64_t first = 0, count = 0;       ///< things of that kind: their places in the whole
    double seconds = 0.0, cpu_seconds = 0.0;  ///< time of all runs when it was written
    std::uint64_t payload = 0, bytes = 0;     ///< where in the file
    std::uint64_t end() const { return payload + bytes; }
  };

  /// Opens or creates `path` for results of `output`. `identity`: whose results a new journal is to hold.
  /// Throws InputError if it cannot be written, is in use by another process, or is no journal.
  Journal(const std::string& path, const std::string& output, const std::string& identity);
  /// Leaves the file where it is, but for one without records.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Whose results it holds.
  const std::string& identity() const { return identity_; }
  /// Those that are whole.
  const std::vector<Record>& records() const { return records_; }
  /// So many bytes of the file are whole; 0: not even its header.
  std::uint64_t whole_bytes() const { return end_; }
  /// Part of a record's payload.
  void read(const Record& record, std::uint64_t offset, std::size_t bytes, void* data) const;

  /// Behind the whole records; what was spoilt behind them is cut off. It is in the system's hands at once, where a
  /// killed process cannot lose it, and on disk within about a second of work. Throws RunError, with the records before
  /// it as they were, if the disk is full. Thread-safe.
  void append(Record record, const void* payload, std::size_t bytes);
  /// Removes the file: all that it holds is elsewhere.
  void remove();
  /// Leaves it with the records of this kind, for all others are elsewhere; removes it if there is none.
  void keep_only(Kind kind);

 private:
  void open_locked(const std::string& output);
  void read_header(const std::string& identity, std::uint64_t size);
  void write_header();
  void read_records(std::uint64_t size);
  void write(const std::vector<char>& bytes);
  void sync();

  std::string path_, identity_;
  int file_ = -1;
  std::uint64_t end_ = 0;  ///< behind the last whole record
  bool spoilt_ = false;    ///< something is behind it that counts for nothing
  std::vector<Record> records_;
  std::mutex appending_;
  std::chrono::steady_clock::time_point synced_;
  std::chrono::steady_clock::duration sync_took_{};
};

}  // namespace equipoise::store
