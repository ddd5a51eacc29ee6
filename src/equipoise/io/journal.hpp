// Results as they come: an append-only file beside the output, of which every prefix can be read.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace equipoise::io {

/// A header that says whose results these are, then records with checksums. A record is appended in one write; one that
/// was cut off or damaged fails its checksum, and the journal ends before it. An open Journal is locked.
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
  /// Length of the undamaged part; 0: not even the header.
  std::uint64_t whole_bytes() const { return end_; }
  /// Part of a record's payload.
  void read(const Record& record, std::uint64_t offset, std::size_t bytes, void* data) const;

  /// Cuts off what is damaged behind the whole records. The record survives a kill at once, and is on disk within about
  /// a second of work. Throws RunError, keeping the records before it, if the disk is full. Thread-safe.
  void append(Record record, const void* payload, std::size_t bytes);
  /// Removes the file: all that it holds is elsewhere.
  void remove();
  /// Drops all records but those of this kind; removes the file if there is none.
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

}  // namespace equipoise::io
