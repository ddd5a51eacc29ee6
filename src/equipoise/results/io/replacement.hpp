// Files that appear whole or not at all.
// This room: whole-file replacement, journal, stores of results, checksums, NetCDF.
#pragma once

#include <string>

namespace equipoise::io {

/// Why no file can be written at `path` ("the folder a/b does not exist"); empty if one can. Leaves no traces.
std::string why_not_writable(const std::string& path);
/// The same for a file of results, which is not written from front to back: nothing but a regular file can take it.
std::string why_no_results_at(const std::string& path);

/// The final path of a file, with symbolic links followed, so that replacing it does not break them.
std::string resolved(const std::string& path);

/// The system's words for an error number.
std::string error_text(int error);

/// Brings a file, or a folder's list of files, to disk. Returns the system's error, 0 for none.
int to_disk(const std::string& path);

/// A new file next to `path` that atomically replaces it on disk once complete. Readers see the old or the new content,
/// even after a crash or on a full disk. A path that is not a regular file (a terminal, a pipe) is written directly.
class Replacement {
 public:
  /// Throws RunError if the file cannot be created.
  explicit Replacement(const std::string& path);
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// Where to write: an empty file.
  const std::string& file() const { return file_; }
  /// Puts it in place. Throws RunError, with the old content kept, if it cannot be brought to disk.
  void commit();

 private:
  std::string path_, file_;
  bool beside_ = true, done_ = false;
};

/// Writes `text` to `path` by a Replacement. Throws RunError, or Interrupted.
void write_whole(const std::string& path, const std::string& text);

/// Seals a file: it ends with its own checksum, so that damage is found before the content is used. Throws RunError,
/// naming `name`, if the file cannot take it.
void seal(const std::string& path, const std::string& name);

/// What is wrong with a sealed file, in words that follow its name; empty if nothing is.
std::string why_not_whole(const std::string& path);

}  // namespace equipoise::io
