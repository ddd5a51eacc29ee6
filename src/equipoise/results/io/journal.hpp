// An append-only file of results next to the output; every prefix of it can be read.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "equipoise/results/io/disk_file.hpp"

namespace equipoise::io {

/// A header with the identity of the results, then records with checksums. One write appends a record. A record that
/// was cut off or damaged fails its checksum; reading goes on at the next sound one. An open Journal is locked.
class Journal {
 public:
  /// What a record holds. The values are those in the file.
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
    std::uint64_t first = 0, count = 0;       ///< places in the whole
    double seconds = 0.0, cpu_seconds = 0.0;  ///< time of all runs when it was written
    std::uint64_t payload = 0, bytes = 0;     ///< where in the file
    std::uint64_t end() const { return payload + bytes; }
  };

  /// Opens or creates `path` for results of `output`. `identity`: of the results in a new journal, and in one whose
  /// damaged header still shows that they are its results; that header is written again. Throws InputError if the file
  /// cannot be written, is used by another process, or is no journal.
  Journal(const std::string& path, const std::string& output, const std::string& identity);
  /// Only reads: the file stays as it is, whatever is in it, and another process may go on writing. Throws InputError
  /// if it cannot be read or is no journal.
  explicit Journal(const std::string& path);
  /// Keeps the file, unless there is nothing in it but its header or the process only reads.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Identity of the results.
  const std::string& identity() const { return identity_; }
  /// The undamaged records.
  const std::vector<Record>& records() const { return records_; }
  /// What is damaged, in words that follow the file's name; empty if nothing is.
  std::string loss() const;
  /// Reads part of a record's payload.
  void read(const Record& record, std::uint64_t offset, std::size_t bytes, void* data) const;

  /// Throws RunError unless all records are on disk as they were written: another program may have cut or changed the
  /// file.
  void require_sound() const;
  /// How much of it is there, in words, after an error.
  std::string kept() const;

  /// Appends a record, first cutting off any damage. The record survives a kill at once, and is on disk within about a
  /// second of work. Returns it with its place. Throws RunError if the disk is full, and keeps the earlier records.
  /// Thread-safe.
  Record append(Record record, const void* payload, std::size_t bytes);
  /// Removes the file, once all its content is elsewhere.
  void remove();
  /// Drops all records of other kinds; removes the file if none are left.
  void keep_only(Kind kind);

 private:
  void open_locked(const std::string& output);
  void read_header(const std::string& identity, std::uint64_t size);
  std::vector<char> header() const;
  std::size_t sound_records() const;
  void write_header();
  void read_records(std::uint64_t size);
  std::uint64_t next_mark(std::uint64_t from, std::uint64_t size) const;
  void write(const std::vector<char>& bytes);
  void sync();

  std::string path_, identity_;
  DiskFile file_;
  std::uint64_t end_ = 0;   ///< after the last whole record
  std::uint64_t lost_ = 0;  ///< bytes between the records and behind them
  bool mended_ = false;     ///< the header was damaged and is written again
  bool spoilt_ = false;     ///< invalid bytes follow
  bool only_reads_ = false;
  std::vector<Record> records_;
  mutable std::mutex appending_;
  std::chrono::steady_clock::time_point synced_;
  std::chrono::steady_clock::duration sync_took_{};
};

}  // namespace equipoise::io
