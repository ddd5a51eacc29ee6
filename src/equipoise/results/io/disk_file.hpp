// An open file, and what only the operating system can say of files: POSIX, and what macOS does otherwise. The
// library's other rooms call no system for files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace equipoise::io {

class Checksum;

/// A file by its number. Calls that end with a number return the system's error, 0 for none.
class DiskFile {
 public:
  enum class Open {
    read,    ///< a file, or a folder to bring its list of files to disk
    write,   ///< what is there
    update,  ///< to read and write; created if absent
    create   ///< fails if it is there
  };

  DiskFile() = default;
  ~DiskFile();
  DiskFile(const DiskFile&) = delete;
  DiskFile& operator=(const DiskFile&) = delete;

  int open(const std::string& path, Open how);
  bool is_open() const { return file_ >= 0; }
  int close();

  /// False if another process has locked the file. The lock ends with the process. True where a file system has no
  /// locks.
  bool lock() const;
  /// Its length; nothing if the system does not say.
  std::optional<std::uint64_t> size() const;
  /// Whether `path` is this file's name still.
  bool is_named(const std::string& path) const;
  /// False at the end of the file, or on an error.
  bool read_at(std::uint64_t offset, void* data, std::size_t size) const;
  /// Adds `size` bytes to a checksum; false as above.
  bool add_to(Checksum& sum, std::uint64_t offset, std::uint64_t size) const;
  int write_at(std::uint64_t offset, const void* data, std::size_t size) const;
  /// Writes at the current position, also to pipes and terminals. A pipe may have no reader, so a signal ends it.
  int write(const std::string& text) const;
  int cut(std::uint64_t size) const;
  /// Until it returns, a power failure may lose what was written. `all`: also times, permissions and other metadata.
  int to_disk(bool all) const;
  int set_permissions(unsigned bits) const;

 private:
  int file_ = -1;
};

/// What a path names.
struct Existing {
  bool there = false, regular = false;
  unsigned permissions = 0;
  /// A folder, a pipe, a terminal: what is never removed or replaced.
  bool special() const { return there && !regular; }
};
Existing existing(const std::string& path);
int remove_file(const std::string& path);
/// Whether this process may write to what is there.
int may_write(const std::string& path);
/// Of this process.
long process_number();

}  // namespace equipoise::io
